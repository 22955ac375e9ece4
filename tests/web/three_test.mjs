// three_test.mjs: baked light drawn by three.js beside our own picture: three_test.mjs FOLDER MODULES SHOTS VIEW FILE...
//
// FOLDER has the files and ours.pfm, the bounced light of the same view. VIEW: JSON of eye, target, fov, width, height.
import fs from 'fs';
import path from 'path';
import { browser, counter, serve } from './browser.mjs';

const [folder, modules, shots, asked, ...files] = process.argv.slice(2);
const view = JSON.parse(asked), count = counter(), check = count.check;
fs.mkdirSync(shots, { recursive: true });

// A little-endian PFM, rows from the top.
function readPfm(name) {
    const bytes = fs.readFileSync(name), size = 4 * 3 * view.width * view.height, data = bytes.subarray(bytes.length - size);
    const floats = new Float32Array(data.buffer.slice(data.byteOffset, data.byteOffset + size)), out = [];
    for (let y = view.height - 1; y >= 0; --y)
        out.push(...floats.subarray(3 * view.width * y, 3 * view.width * (y + 1)));
    return out;
}

// Of the mean of ours: the mean difference of all but the worst 1 % of pixels, whose edges two rasterizers may put
// elsewhere; and how much more light there is in all.
function compare(theirs, ours) {
    const off = [];
    let mean = 0, sum = 0;
    for (let i = 0; i < ours.length; i += 3) {
        off.push((Math.abs(theirs[i] - ours[i]) + Math.abs(theirs[i + 1] - ours[i + 1]) + Math.abs(theirs[i + 2] - ours[i + 2])) / 3);
        mean += (ours[i] + ours[i + 1] + ours[i + 2]) / 3;
        sum += (theirs[i] + theirs[i + 1] + theirs[i + 2]) / 3;
    }
    off.sort((a, b) => a - b);
    const kept = off.slice(0, Math.floor(0.99 * off.length));
    return { off: kept.reduce((a, b) => a + b, 0) / kept.length / (mean / off.length), more: sum / mean - 1 };
}

const chromium = await browser(modules, ['--enable-unsafe-swiftshader', '--use-angle=swiftshader']);
const server = await serve([folder, path.join(modules, 'node_modules/three'), path.dirname(new URL(import.meta.url).pathname)], false);
const page = await chromium.newPage(), said = [];
page.on('console', (m) => m.type() === 'error' && said.push(m.text()));
page.on('pageerror', (e) => said.push(e.message));
await page.goto(server.url + 'three_page.html');
await page.waitForFunction('window.isReady');
if (!await page.evaluate(() => !!document.createElement('canvas').getContext('webgl2'))) {
    console.log('three-check: this Chromium draws no WebGL\n0 passed, 0 failed, 1 skipped');
    process.exit(0);
}
const ours = readPfm(path.join(folder, 'ours.pfm'));
check('our picture is lit', ours.some((v) => v > 0));
const draw = (file, isKept) => page.evaluate(([f, v, k]) => window.drawFile(f, v, k), [file, view, isKept])
    .catch((e) => said.push(e.message) && []);
for (const file of files) {
    const theirs = await draw(file, false), { off, more } = compare(theirs, ours);
    const kept = compare(await draw(file, true), ours);
    console.log(`${file}: three.js is off by ${(100 * off).toFixed(2)} % of the mean light, ${(100 * more).toFixed(2)} % in all; ` +
                `by the materials that glTF asks for ${(100 * kept.more).toFixed(2)} %`);
    check(`${file}: three.js draws our light within 1 %`, off < 0.01, `off by ${off}`);
    check(`${file}: three.js draws as much light within 0.5 %`, Math.abs(more) < 0.005, `${more} more`);
    check(`${file}: materials with a lobe send less, by 4 % at most`, kept.more > -0.04 && kept.more < 0.005, `${kept.more} more`);
    if (theirs.length !== ours.length) continue;
    const brightest = [...ours].sort((a, b) => a - b)[Math.floor(0.99 * ours.length)];
    await page.evaluate(([p, v, t]) => window.showPictures(p, v, t), [[ours, theirs], view, 0.8 / brightest]);
    await page.locator('#both').screenshot({ path: path.join(shots, `${path.parse(file).name}.png`) });
}
check('three.js says no error', !said.length, said.slice(0, 3).join(' | '));
await chromium.close();
server.close();
console.log(`${count.passed} passed, ${count.failed} failed, 0 skipped`);
process.exit(count.failed ? 1 : 0);
