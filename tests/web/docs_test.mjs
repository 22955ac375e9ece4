// docs_test.mjs: the reference in headless Chromium: docs_test.mjs FOLDER MODULES SHOTS: links, widths, search.
import fs from 'fs';
import path from 'path';
import { browser, counter, serve } from './browser.mjs';

const [folder, modules, shots] = process.argv.slice(2);
const count = counter(), check = count.check;
fs.mkdirSync(shots, { recursive: true });

const chromium = await browser(modules), server = await serve([folder], false);
const pages = fs.readdirSync(folder).filter((f) => f.endsWith('.html'));

// Widths and pictures. Structs have one layout, and so have indexes, folders and the pages of plain files: a tenth of
// them stands for all.
const page = await chromium.newPage();
const looked = pages.filter((name, i) => !/^(struct|union|functions|globals|dir_)|_8md\.html$/.test(name) || i % 10 === 0);
for (const name of looked) {
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.goto(server.url + name);
    for (const width of [1280, 360]) {
        await page.setViewportSize({ width, height: 800 });
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        check(`${name} at ${width} px is not too wide`, wide <= 0, `by ${wide} px`);
        const squeezed = await page.evaluate(() => [...document.querySelectorAll('div.memproto')].filter(
            (e) => e.clientWidth < 0.9 * e.parentElement.clientWidth).length);
        check(`${name} at ${width} px has whole prototypes`, !squeezed, `${squeezed} are squeezed`);
        if (['index.html', 'bounce_page.html', 'render_8h.html'].includes(name))
            await page.screenshot({ path: `${shots}/${name.replace('.html', '')}_${width}.png` });
    }
    const broken = await page.evaluate(() => [...document.images].filter((e) => e.src && e.complete && !e.naturalWidth).map((e) => e.src));
    check(`${name}'s pictures`, !broken.length, broken.join(' '));
}

const anchors = {}, links = {};
for (const name of pages) {
    const text = fs.readFileSync(path.join(folder, name), 'utf8');
    anchors[name] = new Set([...text.matchAll(/ (?:id|name)="([^"]*)"/g)].map((m) => m[1]));
    links[name] = [...text.matchAll(/ (?:href|src|data)="([^"]*)"/g)].map((m) => m[1].replaceAll('&amp;', '&'));
}

// The menu names what is there, and long pages begin with their contents.
await page.goto(server.url);
const menu = await page.innerText('#main-menu');
check('the menu', ['Guides', 'All calls', 'Structs', 'Headers'].every((word) => menu.includes(word)), menu);
for (const name of ['index.html', 'calls.html', 'md_tests_results_README.html']) {
    await page.goto(server.url + name);
    check(`${name} has its contents`, await page.evaluate(() => document.querySelectorAll('div.toc a').length) > 5, '');
}

// Every link of every page leads to a file and, behind #, to a place in it. Links to other sites are not followed.
for (const name of pages) {
    const dead = links[name].filter((link) => {
        if (/^(https?|mailto|javascript):/.test(link) || link === '#') return false;
        const [file, anchor] = link.split('#');
        const target = file ? path.normalize(decodeURIComponent(file)) : name;
        if (!fs.existsSync(path.join(folder, target))) return true;
        return anchor && anchors[target] && !anchors[target].has(decodeURIComponent(anchor));
    });
    check(`${name}'s links`, !dead.length, [...new Set(dead)].slice(0, 4).join(' '));
}

await page.setViewportSize({ width: 1280, height: 800 });
await page.goto(server.url);
await page.click('#MSearchField');
await page.keyboard.type('lmb_draw', { delay: 50 });
await page.waitForTimeout(1500);
const frame = page.frames().find((f) => f.name() === 'MSearchResults');
const said = frame ? await frame.evaluate(() => document.body.innerText) : await page.innerText('#MSearchResultsWindow');
check('the search finds a call', /lmb_draw/.test(said), said.slice(0, 80));

await chromium.close();
server.close();
console.log(`${count.passed} passed, ${count.failed} failed, 0 skipped`);
process.exit(count.failed ? 1 : 0);
