// page_times.mjs: frames a second of the page in Chromium: page_times.mjs PAGE MODULES SCENE=FOLDER[:LMT] ...
//
// 640x480 baked, and 320x240 live, by two threads: the least and the median of 30 frames whose light circles.
import fs from 'fs';
import os from 'os';
import path from 'path';
import { browser, serve } from './browser.mjs';

const [folder, modules, ...scenes] = process.argv.slice(2);
const threads = +(process.env.THREADS || 2), frames = +(process.env.FRAMES || 30);
const server = await serve([folder], true), chromium = await browser(modules);
const page = await chromium.newPage();
page.setDefaultTimeout(600000);
await page.goto(`${server.url}?threads=${threads}&still&nochecks&noservice${process.env.KERNELS ? `&kernels=${process.env.KERNELS}` : ''}`);
await page.waitForFunction(() => document.body.dataset.ready);

async function put(name, file) {
    const data = fs.readFileSync(file).toString('base64');
    await page.evaluate(async ({ name, data }) => {
        const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
        await lambent.call('put', { files: [{ name, data: bytes.buffer }] });
    }, { name, data });
}
async function times(label, words, size) {
    const ms = await page.evaluate(async ({ words, frames }) => {
        const told = await lambent.call('open', { words, show: 0, still: true, exposure: 0 });
        const l = told.lights[0], lightPath = [];
        for (let i = 0; i < frames; ++i) {
            const a = 6.2832 * i / frames;
            lightPath.push(l[0] === 2 ? [0, l[1], l[2], l[3], l[4], l[5], l[6]]
                                      : [0, l[1] + 0.1 * Math.cos(a), l[2], l[3] + 0.1 * Math.sin(a), l[4], l[5], l[6]]);
        }
        return (await lambent.call('once', { show: 0, times: frames, lightPath })).ms;
    }, { words, frames });
    const sorted = ms.slice(1).sort((a, b) => a - b), middle = sorted[sorted.length >> 1];
    console.log(`${label.padEnd(24)} ${size}  least ${sorted[0].toFixed(1)} ms = ${(1000 / sorted[0]).toFixed(1)} a second` +
                `   median ${middle.toFixed(1)} ms   load ${os.loadavg()[0].toFixed(1)}`);
}
const render = (file, size, ...more) => ['render', file, '-o', 'x.ppm', '--size', size, '--samples', '1', ...more];
for (const s of scenes) {
    const [name, where] = s.split('='), [from, lmt] = where.split(':');
    const file = name === 'demo' ? 'demo' : `${name}/scene.gltf`;
    if (file !== 'demo') {
        for (const f of fs.readdirSync(from).filter((f) => /^scene\.(gltf|bin)$|\.(png|jpg)$/.test(f))) {
            await put(`${name}/${f}`, path.join(from, f));
        }
    }
    if (lmt) {
        await put(`${name}.lmt`, lmt);
        await times(`${name} baked`, render(file, '640x480', '--transfer', `${name}.lmt`), '640x480');
    }
    await times(`${name} direct`, render(file, '640x480', '--show', 'direct'), '640x480');
    await times(`${name} live`, render(file, '320x240', '--quality', 'draft', '--gather', 'live'), '320x240');
}
await chromium.close();
server.close();
