// page_test.mjs: the page in headless Chromium: page_test.mjs PAGE MODULES PAGE_HASH SHOTS: hands, files, hashes.
import fs from 'fs';
import path from 'path';
import { execFileSync } from 'child_process';
import { browser, counter, serve } from './browser.mjs';

const [folder, modules, hashProgram, shots] = process.argv.slice(2);
const count = counter(), check = count.check;
fs.mkdirSync(shots, { recursive: true });

const chromium = await browser(modules);
const isolated = await serve([folder], true), plain = await serve([folder], false);

async function open(query, options = {}, server = isolated) {
    const context = await chromium.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(180000);
    page.on('pageerror', (e) => check('no script fails', false, e.message));
    await page.goto(`${server.url}?${query}`);
    await page.waitForFunction(() => document.body.dataset.ready);
    return page;
}
const shot = (page, name) => page.screenshot({ path: path.join(shots, `${name}.png`) });
const state = (page) => page.evaluate(() => JSON.parse(JSON.stringify(lambent.state)));
const frame = (page) => page.waitForFunction(() => document.body.dataset.frame);
async function nextFrame(page, act) {
    const before = await page.evaluate(() => document.body.dataset.frame);
    await act();
    await page.waitForFunction((b) => document.body.dataset.frame !== b, before);
}
// Colours that the canvas has, of a grid of its pixels: a picture has many.
const colours = (page) => page.evaluate(() => {
    const c = document.getElementById('view'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    const all = new Set();
    for (let i = 0; i < d.length; i += 4 * 37) all.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]);
    return all.size;
});
const middle = async (page) => {
    const b = await page.locator('#over').boundingBox();
    return { x: b.x + b.width / 2, y: b.y + b.height / 2, width: b.width, height: b.height, left: b.x, top: b.y };
};

// --- the same bytes as the library draws here, by scalar and simd128, one and two threads --------------------------

const render = (file, ...more) => ['render', file, '-o', 'x.ppm', '--size', '160x120', '--samples', '1', '--exposure', '0',
                                   ...more];
const frames = [
    { show: 0, light: null, words: render('demo', '--quality', 'draft') },
    { show: 2, light: [0.5, 2.6, 0.5], words: render('demo', '--quality', 'draft') },
    { show: 0, light: [0.5, 2.6, 0.5], words: render('demo', '--transfer', 'demo.lmt') },
    { show: 0, light: null, words: render('small_room/scene.gltf', '--transfer', 'small_room.lmt') },
    { show: 1, light: null, words: render('small_room/scene.gltf') },
];
const native = frames.map((f) => execFileSync(path.resolve(hashProgram),
    [f.show, f.light ? f.light.map((x) => Math.fround(x)).join(',') : '-', ...f.words], { cwd: folder }).toString().trim());
check('the frames differ', new Set(native).size === native.length, native);
for (const kernels of ['scalar', 'simd']) {
    for (const threads of [1, 2]) {
        const page = await open(`still&nochecks&noservice&threads=${threads}&kernels=${kernels}`);
        const runs = (await state(page)).runs;
        check(`${threads} threads of ${kernels} run`, runs.threads === threads && runs.kernels === kernels, JSON.stringify(runs));
        for (const name of ['demo.lmt', 'small_room.lmt', 'small_room/scene.gltf', 'small_room/scene.bin']) {
            await page.evaluate(async (name) => {
                const data = await (await fetch(name)).arrayBuffer();
                await lambent.call('put', { files: [{ name, data }] });
            }, name);
        }
        for (let i = 0; i < frames.length; ++i) {
            const hash = await page.evaluate(async (f) => {
                const told = await lambent.call('open', { words: f.words, show: f.show, still: true });
                const l = told.lights[0];
                const lightPath = f.light ? [[0, ...f.light, l[4], l[5], l[6]]] : undefined;
                return (await lambent.call('once', { show: f.show, times: 1, lightPath })).hash;
            }, frames[i]);
            check(`frame ${i} by ${kernels}, ${threads}`, hash === native[i], `${hash}, natively ${native[i]}`);
        }
        await page.context().close();
    }
}

// --- hands ---------------------------------------------------------------------------------------------------------

let page = await open('threads=2&noservice');
await frame(page);
await shot(page, 'first');
check('a picture is there', await colours(page) > 200, await colours(page));
check('it is baked', await page.textContent('#level') === 'baked');
const at = await middle(page);
let before = await state(page);
await nextFrame(page, async () => {
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 60, at.y + 20, { steps: 4 });
    await page.mouse.up();
});
let after = await state(page);
check('a drag turns the camera', before.camera.target[0] !== after.camera.target[0]);
check('and moves no light', JSON.stringify(before.lights) === JSON.stringify(after.lights));
for (const key of ['ArrowLeft', 'ArrowUp', '+']) {
    before = after;
    await nextFrame(page, () => page.keyboard.press(key));
    after = await state(page);
    check(`${key} moves the camera`, JSON.stringify(before.camera) !== JSON.stringify(after.camera));
}
before = after;
await nextFrame(page, async () => {
    await page.keyboard.press('l');
    await page.keyboard.press('ArrowLeft');
});
after = await state(page);
check('L, and arrows move the light', before.lights[0].position[0] !== after.lights[0].position[0]);
before = after;
await nextFrame(page, async () => {
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x - 90, at.y + 60, { steps: 4 });
    await page.mouse.up();
});
after = await state(page);
check('a drag moves the light', before.lights[0].position[1] !== after.lights[0].position[1]);
check('and turns no camera', JSON.stringify(before.camera) === JSON.stringify(after.camera));
await shot(page, 'light_moved');
await page.click('#drag-camera');
await page.waitForFunction(() => /^\d+\.\d %$/.test(document.getElementById('error').textContent));
check('the error against best is told', true);
await shot(page, 'error');

// --- what is shown ------------------------------------------------------------------------------------------------

await page.selectOption('#size', '320x240');
for (const show of ['indirect', 'light-distance', 'points', 'groups', 'occlusion', 'albedo', 'normal']) {
    if (show === 'indirect') await nextFrame(page, () => page.selectOption('#show', show));
    else {
        await page.selectOption('#show', show);
        await page.waitForFunction((s) => document.body.dataset.shown === s, show);
    }
    check(`${show} shows something`, await colours(page) > 12, await colours(page));
    await shot(page, `show_${show}`);
}
await nextFrame(page, () => page.selectOption('#show', 'cut'));
const here = await middle(page);
await page.mouse.move(here.x, here.y + here.height / 4);
await page.waitForFunction(() => +document.body.dataset.cut > 0);
await shot(page, 'show_cut');
check('a cut has some nodes', await page.evaluate(() => +document.body.dataset.cut) > 8);
await nextFrame(page, () => page.selectOption('#show', 'full'));
for (const [value, name] of [[1, 'draft'], [2, 'default']]) {
    await nextFrame(page, () => page.locator('#quality').fill(String(value)));
    check(`quality ${name}`, await page.textContent('#level') === name);
}

// --- files -------------------------------------------------------------------------------------------------------

const drop = (files) => page.evaluate((files) => {
    const data = new DataTransfer();
    for (const [name, text] of files) data.items.add(new File([text], name));
    document.getElementById('picture').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true }));
}, files);
await nextFrame(page, () => drop([['steps.obj', 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv 1 1 -1\n' +
                                   'f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\n']]));
check('a dropped scene opens', await page.textContent('#triangles') !== '' && await page.inputValue('#scene') === '3');
await shot(page, 'dropped');
await drop([['broken.glb', 'glTF and nothing more']]);
await page.waitForFunction(() => document.getElementById('say').className === 'bad');
const why = await page.textContent('#say');
check('a broken one is refused in words', /^dropped\/broken\.glb: /.test(why), why);
await drop([['notes.txt', 'no scene']]);
await page.waitForFunction(() => document.getElementById('say').textContent.startsWith('notes.txt'));
await nextFrame(page, () => page.selectOption('#scene', '1'));
check('and the page goes on', await colours(page) > 100);

// --- tabs --------------------------------------------------------------------------------------------------------

for (const tab of ['relight', 'relief', 'mix']) {
    await page.click(`#tab-${tab}`);
    await page.waitForFunction((t) => document.body.dataset.other === t, tab);
    check(`${tab} shows a picture`, await colours(page) > 200, await colours(page));
    await shot(page, `tab_${tab}`);
}
const mixed = () => page.evaluate(() => document.getElementById('view').toDataURL());
const moved = async (what, hands) => {
    const was = await mixed();
    await hands();
    await page.waitForFunction((w) => document.getElementById('view').toDataURL() !== w, was);
    await page.waitForFunction(() => document.getElementById('bar').style.width === '0px');
    check(what, await mixed() !== was);
};
await moved('a drag moves the light on the vase', async () => {
    const at = await middle(page);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 120, at.y, { steps: 3 });
    await page.mouse.up();
});
await shot(page, 'mix_dragged');
await moved('and so does an arrow key', () => page.press('#picture', 'ArrowLeft'));
await moved('mix shows what changed', () => page.selectOption('#mix-show', 'delta'));
await shot(page, 'mix_delta');
await page.context().close();

// --- a phone -----------------------------------------------------------------------------------------------------

page = await open('threads=2&noservice&nochecks&size=320x240', { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
await frame(page);
await shot(page, 'phone');
const touch = await page.context().newCDPSession(page), m = await middle(page);
before = await state(page);
await nextFrame(page, async () => {
    for (const [type, x] of [['touchStart', 0], ['touchMove', 30], ['touchMove', 60], ['touchEnd', null]]) {
        await touch.send('Input.dispatchTouchEvent', { type, touchPoints: x === null ? [] : [{ x: m.x + x, y: m.y }] });
    }
});
after = await state(page);
check('a finger turns the camera', before.camera.target[0] !== after.camera.target[0]);
for (const tab of ['relight', 'relief', 'mix', 'bounce']) {
    await page.click(`#tab-${tab}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check(`${tab} fits 360 px`, wide <= 360, wide);
}
await page.context().close();

// --- a plain server: one thread, then, by the service worker, more; and no network -----------------------------------

page = await open('threads=2&nochecks', {}, plain);
await frame(page);
check('without isolation one thread draws', (await state(page)).runs.threads === 1);
await page.evaluate(() => navigator.serviceWorker.ready);
await page.waitForTimeout(1500);
await page.reload();
await frame(page);
check('the second time two do', (await state(page)).runs.threads === 2);
await page.context().setOffline(true);
plain.close();
await page.reload();
await frame(page);
check('it opens without a network', await colours(page) > 200);
await chromium.close();
isolated.close();
console.log(`${count.passed} passed, ${count.failed} failed, 0 skipped`);
process.exit(count.failed ? 1 : 0);
