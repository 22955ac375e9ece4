// lambent.js: the first part of every script of the page: the unpacker, by which the page and the workers load page.js,
// and the service worker, which caches the page for use without a network.
'use strict';

const FILES = ['./', 'index.html', 'lambent.js', 'page.js.lzma', 'body.html.lzma', 'lambent.wasm.lzma', 'kernels_scalar.wasm.lzma', 'kernels_simd.wasm.lzma',
               'demo.wasm.lzma', 'scenes.json'];

// --- unpacking -----------------------------------------------------------------------------------------------------

// Decodes a file of `xz --format=lzma`: bits of a range coder, with adaptive probabilities.
function unlzma(src) {
    const lc = src[0] % 9, lp = (src[0] / 9 | 0) % 5, pb = src[0] / 45 | 0;
    const MATCH = 0, REP = 192, REP0 = 204, REP1 = 216, REP2 = 228, REP0_LONG = 240, SLOT = 432, SPECIAL = 688,
          ALIGN = 816, LENGTH = 832, REP_LENGTH = 1346, LITERAL = 1860;
    const p = new Uint16Array(LITERAL + (0x300 << (lc + lp))).fill(1024);
    let out = new Uint8Array(1 << 20), n = 0, at = 18, range = 0xffffffff;
    let code = (src[14] << 24 | src[15] << 16 | src[16] << 8 | src[17]) >>> 0;
    let state = 0, rep0 = 0, rep1 = 0, rep2 = 0, rep3 = 0;
    const feed = () => {
        if (range < 0x1000000) {
            range = range * 256;
            code = (code << 8 | src[at++]) >>> 0;
        }
    };
    const bit = (i) => {
        feed();
        const bound = (range >>> 11) * p[i];
        if (code < bound) {
            range = bound;
            p[i] += (2048 - p[i]) >> 5;
            return 0;
        }
        range -= bound;
        code -= bound;
        p[i] -= p[i] >> 5;
        return 1;
    };
    const tree = (from, bits) => {
        let m = 1;
        for (let i = 0; i < bits; ++i) m = m << 1 | bit(from + m);
        return m - (1 << bits);
    };
    const reverse = (from, bits) => {
        let m = 1, sum = 0;
        for (let i = 0; i < bits; ++i) {
            const b = bit(from + m);
            m = m << 1 | b;
            sum |= b << i;
        }
        return sum;
    };
    const length = (from, place) => !bit(from) ? tree(from + 2 + (place << 3), 3)
        : !bit(from + 1) ? 8 + tree(from + 130 + (place << 3), 3) : 16 + tree(from + 258, 8);
    for (;;) {
        if (at > src.length + 8) throw new Error('a module ends too soon');
        if (n + 300 > out.length) {
            const wider = new Uint8Array(2 * out.length);
            wider.set(out);
            out = wider;
        }
        const place = n & (1 << pb) - 1;
        if (!bit(MATCH + (state << 4) + place)) {
            const from = LITERAL + 0x300 * (((n & (1 << lp) - 1) << lc) + ((n ? out[n - 1] : 0) >> 8 - lc));
            let sign = 1;
            if (state >= 7) {
                let like = out[n - rep0 - 1];
                for (let same = true; same && sign < 256; like <<= 1) {
                    const b = bit(from + (1 + (like >> 7 & 1) << 8) + sign);
                    same = b === (like >> 7 & 1);
                    sign = sign << 1 | b;
                }
            }
            while (sign < 256) sign = sign << 1 | bit(from + sign);
            out[n++] = sign & 255;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        let count;
        if (bit(REP + state)) {
            if (!bit(REP0 + state)) {
                if (!bit(REP0_LONG + (state << 4) + place)) {
                    state = state < 7 ? 9 : 11;
                    out[n] = out[n - rep0 - 1];
                    ++n;
                    continue;
                }
            } else {
                let to = rep1;
                if (bit(REP1 + state)) {
                    to = rep2;
                    if (bit(REP2 + state)) {
                        to = rep3;
                        rep3 = rep2;
                    }
                    rep2 = rep1;
                }
                rep1 = rep0;
                rep0 = to;
            }
            count = length(REP_LENGTH, place);
            state = state < 7 ? 8 : 11;
        } else {
            rep3 = rep2;
            rep2 = rep1;
            rep1 = rep0;
            count = length(LENGTH, place);
            state = state < 7 ? 7 : 10;
            const slot = tree(SLOT + (Math.min(count, 3) << 6), 6), bits = (slot >> 1) - 1;
            rep0 = slot < 4 ? slot : (2 | slot & 1) << bits;
            if (slot >= 4 && slot < 14) rep0 += reverse(SPECIAL + rep0 - slot, bits);
            else if (slot >= 14) {
                let direct = 0;
                for (let i = 4; i < bits; ++i) {
                    feed();
                    range = range >>> 1;
                    const b = code >= range ? 1 : 0;
                    if (b) code -= range;
                    direct = direct << 1 | b;
                }
                rep0 = rep0 + (direct << 4) + reverse(ALIGN, 4) | 0;
                if (rep0 === -1) return out.subarray(0, n);
            }
        }
        for (count += 2; count > 0; --count, ++n) out[n] = out[n - rep0 - 1];
    }
}

// --- the service worker --------------------------------------------------------------------------------------------

// Tries the network first, then the cache; adds the headers that let the page use threads.
function service() {
    const KEPT = 'lambent';
    self.addEventListener('install', (e) => e.waitUntil(
        caches.open(KEPT).then((c) => Promise.all(FILES.map((f) => c.add(f).catch(() => {})))).then(() => self.skipWaiting())));
    self.addEventListener('activate', (e) => e.waitUntil(self.clients.claim()));
    const isolating = (answer) => {
        const headers = new Headers(answer.headers);
        headers.set('Cross-Origin-Opener-Policy', 'same-origin');
        headers.set('Cross-Origin-Embedder-Policy', 'require-corp');
        return new Response(answer.body, { status: answer.status, statusText: answer.statusText, headers });
    };
    self.addEventListener('fetch', (e) => {
        if (e.request.method !== 'GET' || new URL(e.request.url).origin !== self.location.origin) return;
        e.respondWith((async () => {
            const kept = await caches.open(KEPT);
            try {
                const answer = await fetch(e.request);
                if (answer.ok) kept.put(e.request, answer.clone());
                return isolating(answer);
            } catch (error) {
                const answer = await kept.match(e.request, { ignoreSearch: true });
                if (!answer) throw error;
                return isolating(answer);
            }
        })());
    });
}

// --- the rest of the script ----------------------------------------------------------------------------------------

async function unpacked(file) {
    const answer = await fetch(file);
    if (!answer.ok) throw new Error(`${file}: the server says ${answer.status}`);
    return unlzma(new Uint8Array(await answer.arrayBuffer()));
}

// Queues messages to a worker until the script is loaded.
async function begin() {
    const early = [];
    self.onmessage = (e) => early.push(e);
    const [script, body] = await Promise.all(['page.js.lzma', 'body.html.lzma'].map(
        async (file) => self.document || file[0] === 'p' ? new TextDecoder().decode(await unpacked(file)) : ''));
    if (body) document.body.innerHTML = body;
    (0, eval)(script);
    for (const e of early) self.onmessage(e);
}

if (typeof ServiceWorkerGlobalScope !== 'undefined' && self instanceof ServiceWorkerGlobalScope) service();
else begin().catch((e) => { if (self.document) document.body.textContent = e.message; else throw e; });
