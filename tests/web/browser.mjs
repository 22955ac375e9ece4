// browser.mjs: a static server on loopback, headless Chromium, and counted checks, for the tests of pages.
import fs from 'fs';
import http from 'http';
import path from 'path';
import { createRequire } from 'module';

const kinds = { html: 'text/html', js: 'text/javascript', json: 'application/json', png: 'image/png', svg: 'image/svg+xml',
                css: 'text/css' };

// Serves the folders, the first that has a file; isolated: with the headers that let a page use threads.
export function serve(folders, isIsolated) {
    const server = http.createServer((asked, answer) => {
        let name = path.normalize(decodeURIComponent(asked.url.split('?')[0]));
        if (name.endsWith('/')) name += 'index.html';
        const file = folders.map((f) => path.join(f, name)).find((f) => fs.existsSync(f));
        if (!file) {
            answer.writeHead(404).end();
            return;
        }
        const headers = { 'content-type': kinds[name.split('.').pop()] || 'application/octet-stream' };
        if (isIsolated) {
            headers['cross-origin-opener-policy'] = 'same-origin';
            headers['cross-origin-embedder-policy'] = 'require-corp';
        }
        answer.writeHead(200, headers);
        fs.createReadStream(file).pipe(answer);
    });
    return new Promise((done) => server.listen(0, '127.0.0.1', () =>
        done({ url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() })));
}

// modules: the folder that has node_modules/playwright-core. more: arguments of Chromium's.
export function browser(modules, more = []) {
    const { chromium } = createRequire(path.resolve(modules, 'x.js'))('playwright-core');
    return chromium.launch({
        executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
        args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
               '--disable-component-update', '--disable-sync', ...(more.length ? more : ['--disable-gpu'])] });
}

// Counts checks and says those that fail.
export function counter() {
    const count = { passed: 0, failed: 0 };
    count.check = (what, ok, found = '') => {
        if (ok) ++count.passed;
        else {
            ++count.failed;
            console.log(`FAILED ${what} ${found}`);
        }
    };
    return count;
}
