// page.js: the page's script, in three roles: the page itself, the worker that draws, and the helpers. lambent.js
// loads it in packed form.
'use strict';

// Constants of page_calls.h: PAGE_WIDTH and on, and PAGE_TO_.
const AT = { width: 0, height: 1, triangles: 2, lights: 3, baked: 4, threads: 5, eye: 6, right: 9, up: 12, back: 15,
             halfWidth: 18, halfHeight: 19, low: 20, high: 23, light: 26, progress: 33, trim: 34, rmse: 35, dropped: 36,
             memory: 37, count: 38 };
const TO_SCREEN = 0, TO_LINEAR = 1, TO_BEST = 2;
const FULL = 0, DIRECT = 1, INDIRECT = 2;
const NODE = 10;

// --- the modules, joined: in the worker that draws and in each helper ----------------------------------------------

// A module with one instruction of simd128.
const SIMD = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253,
                             15, 253, 98, 11]);

async function compile(file) {
    return WebAssembly.compile(await unpacked(file));
}

// Appends the kernels' functions to the other module's table, at the same numbers in every thread.
async function join(modules, memory, said) {
    const words = [];
    const write = (file, vectors, count, written) => {
        const view = new DataView(memory.buffer);
        let bytes = 0;
        for (let i = 0; i < count; ++i) {
            const at = view.getUint32(vectors + 8 * i, true), size = view.getUint32(vectors + 8 * i + 4, true);
            words.push(...new Uint8Array(memory.buffer, at, size));
            bytes += size;
        }
        view.setUint32(written, bytes, true);
        for (let end = words.indexOf(10); end >= 0; end = words.indexOf(10)) {
            if (said) said(new TextDecoder().decode(new Uint8Array(words.splice(0, end + 1))).trim());
        }
        return 0;
    };
    const none = () => 8; // EBADF
    const wasi = { fd_write: write, fd_close: none, fd_fdstat_get: none, fd_seek: none };
    const main = (await WebAssembly.instantiate(modules.main, { env: { memory, now: () => performance.now() },
                                                                wasi_snapshot_preview1: wasi })).exports;
    const kernels = (await WebAssembly.instantiate(modules.kernels, { env: { memory } })).exports;
    const from = kernels.__indirect_function_table, to = main.__indirect_function_table;
    const first = to.grow(from.length);
    for (let i = 0; i < from.length; ++i) to.set(first + i, from.get(i));
    return { main, kernels, first };
}

const STACK = 1 << 20, KERNELS_STACK = 1 << 17;

// --- the worker that draws -----------------------------------------------------------------------------------------

function engine() {
    let memory, main, said = [];
    let scene = null;          // the open scene: { slow, show, exposed }
    let wanted = 0, drawn = 0; // the last requested state, and the state of the last whole frame
    let busy = false, measured = 0, checks = true, asked = 0;
    const tick = new MessageChannel();
    tick.port1.onmessage = () => pump();
    const bytes = (at, size) => new Uint8Array(memory.buffer, at, size);

    function text(at) {
        const all = new Uint8Array(memory.buffer);
        let end = at;
        while (all[end]) ++end;
        return new TextDecoder().decode(all.slice(at, end));
    }
    function withText(words, call) {
        const coded = new TextEncoder().encode(words + '\0');
        const at = main.page_take(coded.length);
        bytes(at, coded.length).set(coded);
        const result = call(at);
        main.page_give(at);
        return result;
    }
    function put(name, data) {
        const at = main.page_take(data.byteLength);
        if (!at) throw new Error(`${name}: out of memory`);
        bytes(at, data.byteLength).set(new Uint8Array(data));
        if (!withText(name, (n) => main.page_file_put(n, at, data.byteLength))) throw new Error(`${name}: too many files`);
    }
    function taken(name) {
        const at = withText(name, (n) => main.page_file_data(n)), size = withText(name, (n) => main.page_file_size(n));
        return at ? bytes(at, size).slice() : null;
    }
    function numbers(light = 0) {
        return Array.from(new Float64Array(memory.buffer, main.page_numbers(light), AT.count));
    }
    function picture() {
        const n = numbers(), size = 4 * n[AT.width] * n[AT.height];
        return { width: n[AT.width], height: n[AT.height],
                 pixels: new Uint8ClampedArray(bytes(main.page_pixels(), size)).buffer };
    }
    function send(kind, more) {
        const p = picture();
        postMessage({ kind, serial: scene && scene.serial, ...p, ...more }, [p.pixels]);
    }

    async function start(o) {
        const isThreaded = self.crossOriginIsolated && o.threads > 1;
        const kernels = o.kernels || (WebAssembly.validate(SIMD) ? 'simd' : 'scalar');
        const modules = {};
        let demo;
        [modules.main, modules.kernels, demo] = await Promise.all(
            ['lambent', `kernels_${kernels}`, 'demo'].map((name) => compile(`${name}.wasm.lzma`)));
        memory = new WebAssembly.Memory({ initial: 512, maximum: 32768, shared: true });
        const all = await join(modules, memory, (line) => said.push(line));
        main = all.main;
        main.__wasm_call_ctors();
        all.kernels.__stack_pointer.value = main.page_take(KERNELS_STACK) + KERNELS_STACK & -16;
        main.page_use_kernels((all.kernels.lmb_kernels_scalar || all.kernels.lmb_kernels_simd128).value, all.first);
        const room = (await WebAssembly.instantiate(demo, { env: { memory } })).exports;
        room.__stack_pointer.value = main.page_take(KERNELS_STACK) + KERNELS_STACK & -16;
        const at = main.__indirect_function_table.grow(2);
        main.__indirect_function_table.set(at, room.demo_scene);
        main.__indirect_function_table.set(at + 1, room.demo_view);
        main.page_use_demo(at, at + 1);
        if (!main.page_ready()) throw new Error('this browser computes otherwise than IEEE binary32 asks for');
        for (let i = 1; isThreaded && i < o.threads; ++i) {
            const stacks = [main.page_take(STACK) + STACK & -16, main.page_take(KERNELS_STACK) + KERNELS_STACK & -16];
            const helper = new Worker(self.location.href, { name: 'helper' });
            await new Promise((done, failed) => {
                helper.onmessage = done;
                helper.onerror = () => failed(new Error('a helper did not start'));
                helper.postMessage({ modules, memory, stacks });
            });
        }
        for (let tries = 0; isThreaded && main.page_helpers() < o.threads - 1 && tries < 500; ++tries) {
            await new Promise((done) => setTimeout(done, 2));
        }
        return { threads: main.page_take_helpers(), kernels, isolated: !!self.crossOriginIsolated };
    }

    function open(o) {
        const before = performance.now();
        scene = null;
        said = [];
        if (!withText(o.words.join('\n'), (w) => main.page_open(w))) throw new Error(text(main.page_report()));
        if (o.look) main.page_look(...o.look);
        for (const l of o.lights || []) main.page_put_light(...l);
        if (o.exposure !== undefined) main.page_set_exposure(o.exposure);
        scene = { show: o.show, serial: o.serial, exposed: o.exposure !== undefined, still: !!o.still, last: Infinity };
        const lights = [];
        const n = numbers();
        for (let i = 0; i < n[AT.lights]; ++i) lights.push(numbers(i).slice(AT.light, AT.light + 7));
        ++wanted;
        if (!scene.still) tick.port2.postMessage(0);
        return { numbers: n, lights, said, ms: performance.now() - before };
    }

    // Draws steps until the frame is done and yields between them, so that user input is handled. Returns false if
    // another frame was requested meanwhile.
    async function frame(target, show, state, isWhole) {
        if (!main.page_begin(target, show)) throw new Error(text(main.page_report()));
        let ms = 0, since = performance.now(), told = since;
        for (;;) {
            const fast = scene.last < 150 || show === DIRECT;
            const begun = performance.now(), more = main.page_step(fast ? 1024 : 4), now = performance.now();
            ms += now - begun;
            if (more < 0) throw new Error(text(main.page_report()));
            if (!more) return ms;
            if (now - since > 12 && !fast || now - since > 200) {
                if (!isWhole && now - told > 150) {
                    told = now;
                    if (target === TO_SCREEN) send('part', { progress: numbers()[AT.progress] });
                    else postMessage({ kind: 'progress', target, progress: numbers()[AT.progress] });
                }
                await breath();
                since = performance.now();
                if (state !== wanted) return -1;
            }
        }
    }
    function breath() {
        return new Promise((done) => {
            const c = new MessageChannel();
            c.port1.onmessage = done;
            c.port2.postMessage(0);
        });
    }

    // The first frames choose the exposure: first direct light, then all light.
    async function draw(state) {
        const show = scene.show;
        if (!scene.exposed) {
            if (await frame(TO_LINEAR, DIRECT, state, true) < 0) return;
            main.page_exposure();
            main.page_to_pixels();
            send('part', { progress: 0 });
            if (await frame(TO_LINEAR, show, state, false) < 0) return;
            main.page_exposure();
            scene.exposed = true;
        }
        if (scene.last > 150 && show === FULL) {
            if (await frame(TO_SCREEN, DIRECT, state, true) < 0) return;
            send('part', { progress: 0 });
        }
        const ms = await frame(TO_SCREEN, show, state, false);
        if (ms < 0) return;
        scene.last = ms;
        drawn = state;
        send('frame', { ms, state, exposure: main.page_exposure_now() });
    }

    // Compares the linear frame with the best one once nothing moves.
    async function measure(state) {
        await new Promise((done) => setTimeout(done, 700));
        if (state !== wanted || !checks) return;
        if (await frame(TO_LINEAR, FULL, state, true) < 0) return;
        const begun = performance.now();
        const ms = await frame(TO_BEST, FULL, state, false);
        if (ms < 0 || !main.page_measure()) return;
        measured = state;
        const n = numbers();
        postMessage({ kind: 'error', trim: n[AT.trim], rmse: n[AT.rmse], ms, waited: performance.now() - begun });
    }

    async function pump() {
        if (busy || !scene || scene.still) return;
        busy = true;
        try {
            while (scene && !scene.still && !asked && (drawn !== wanted || (checks && scene.show === FULL && measured !== wanted))) {
                const state = wanted;
                if (drawn !== state) await draw(state);
                else await measure(state);
                if (state === wanted && drawn === state && !(checks && scene && scene.show === FULL)) break;
            }
        } catch (e) {
            postMessage({ kind: 'failed', why: e.message });
            scene = null;
        }
        busy = false;
    }

    const calls = {
        start,
        put: (o) => { for (const f of o.files) put(f.name, f.data); },
        drop: (o) => withText(o.name, (n) => main.page_file_drop(n)),
        open,
        setNow: (o) => {
            main.page_look(...o.look);
            for (const l of o.lights) main.page_put_light(...l);
        },
        set: (o) => {
            if (o.checks !== undefined) checks = o.checks;
            if (!scene) return;
            if (o.look) main.page_look(...o.look);
            for (const l of o.lights || []) main.page_put_light(...l);
            if (o.show !== undefined) scene.show = o.show;
            if (o.look || o.lights || o.show !== undefined) ++wanted;
            tick.port2.postMessage(0);
        },
        // A frame in one piece, for tests and figures: draws it `times` times; if `moves` is set,
        // the light circles a little.
        once: async (o) => {
            ++wanted;
            const ms = [];
            for (let i = 0; i < o.times; ++i) {
                if (o.path) main.page_look(...o.path[i % o.path.length]);
                if (o.lightPath) main.page_put_light(...o.lightPath[i % o.lightPath.length]);
                const before = performance.now();
                if (!main.page_begin(TO_SCREEN, o.show)) throw new Error(text(main.page_report()));
                let more;
                do more = main.page_step(4096); while (more > 0);
                if (more < 0) throw new Error(text(main.page_report()));
                ms.push(performance.now() - before);
            }
            drawn = wanted;
            send('frame', { ms: Math.min(...ms), state: wanted, exposure: main.page_exposure_now() });
            return { ms, hash: text(main.page_hash()) };
        },
        shown: () => {
            ++wanted;
            const before = performance.now(), at = main.page_show();
            if (!at) throw new Error(text(main.page_report()));
            const width = main.page_show_width(), height = main.page_show_height();
            return { width, height, ms: performance.now() - before,
                     pixels: new Uint8ClampedArray(bytes(at, 4 * width * height)).buffer };
        },
        cut: (o) => {
            if (!scene) return { count: 0 };
            const at = main.page_cut(o.x, o.y), count = main.page_cut_count();
            return { count, size: main.page_cut_size(),
                     nodes: Array.from(new Float32Array(memory.buffer, at, NODE * count)) };
        },
        run: (o) => {
            const before = performance.now();
            said = [];
            const status = withText(o.words.join('\n'), (w) => main.page_run(w));
            const ms = performance.now() - before, data = o.out ? taken(o.out) : null;
            if (o.out) withText(o.out, (n) => main.page_file_drop(n));
            if (status !== 0) throw new Error(said[said.length - 1] || text(main.page_report()));
            return { data, said, ms };
        },
        hash: () => text(main.page_hash()),
    };
    // Runs calls one at a time, in order; frames continue between them.
    let queue = Promise.resolve();
    onmessage = (e) => {
        if (e.data.call === 'set') { // input moves faster than frames
            calls.set(e.data);
            return;
        }
        const isCut = e.data.call === 'cut';
        wanted += isCut ? 0 : 1; // interrupts the current frame
        asked += isCut ? 0 : 1;
        queue = queue.then(async () => {
            while (busy && !isCut) await breath();
            try {
                postMessage({ kind: 'answer', id: e.data.id, value: await calls[e.data.call](e.data) });
            } catch (error) {
                postMessage({ kind: 'answer', id: e.data.id, why: error.message });
            }
            asked -= isCut ? 0 : 1;
            tick.port2.postMessage(0);
        });
    };
}

function helper() {
    onmessage = async (e) => {
        const { modules, memory, stacks } = e.data;
        const all = await join(modules, memory, null);
        all.main.__stack_pointer.value = stacks[0];
        all.kernels.__stack_pointer.value = stacks[1];
        postMessage('here');
        all.main.page_help();
    };
}

// --- the page ------------------------------------------------------------------------------------------------------

function page() {
    const $ = (id) => document.getElementById(id);
    const asked = new URLSearchParams(location.search);
    const LEVELS = ['baked', 'draft', 'default', 'best'];
    const view = $('view').getContext('2d'), over = $('over').getContext('2d');
    const worker = new Worker('lambent.js', { name: 'engine' });
    const waiting = new Map();
    let next = 1, scenes = [], now = null, tab = 'bounce', runs = null, dropped = 0;
    let camera = null, lights = [], light = 0, atLight = false, frames = [], cut = null;

    function call(name, more = {}, transfer = []) {
        return new Promise((done, failed) => {
            waiting.set(next, { done, failed });
            worker.postMessage({ call: name, id: next++, ...more }, transfer);
        });
    }
    worker.onmessage = (e) => {
        const m = e.data;
        if (m.kind === 'answer') {
            const w = waiting.get(m.id);
            waiting.delete(m.id);
            if (m.why !== undefined) w.failed(new Error(m.why));
            else w.done(m.value);
        } else if (m.kind === 'frame' || m.kind === 'part') {
            if (tab !== 'bounce' || showsWhole() || m.serial !== opening) return;
            if (m.kind === 'frame' && show() === 'full' && !quick) now.exposure = m.exposure;
            put(m);
            $('bar').style.width = m.kind === 'frame' ? 0 : `${100 * m.progress}%`;
            if (m.kind === 'frame') tellFrame(m);
        } else if (m.kind === 'progress') {
            $('bar').style.width = `${100 * m.progress}%`;
            if (m.target === TO_BEST) $('error').textContent = `best: ${Math.round(100 * m.progress)} %`;
        } else if (m.kind === 'error') {
            $('bar').style.width = 0;
            $('error').textContent = `${(100 * m.trim).toFixed(1)} %`;
        } else if (m.kind === 'failed') say(m.why, true);
    };
    worker.onerror = (e) => say(`the worker stopped: ${e.message}`, true);

    function say(text, isBad = false) {
        $('say').textContent = text;
        $('say').className = isBad ? 'bad' : '';
    }
    function put(m) {
        const c = $('view');
        if (c.width !== m.width || c.height !== m.height) {
            c.width = m.width;
            c.height = m.height;
            $('over').width = m.width;
            $('over').height = m.height;
            $('picture').style.setProperty('--shape', m.width / m.height);
        }
        view.putImageData(new ImageData(new Uint8ClampedArray(m.pixels), m.width, m.height), 0, 0);
        drawOver();
    }
    function tellTime(ms) {
        $('ms').textContent = `${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`;
        $('fps').textContent = ms > 0 ? (1000 / ms).toFixed(1) : '';
    }
    function tellFrame(m) {
        frames.push(m.ms);
        if (frames.length > 20) frames.shift();
        tellTime(frames.slice().sort((a, b) => a - b)[frames.length >> 1]);
        document.body.dataset.frame = m.state;
    }

    // --- vectors and the camera ------------------------------------------------------------------------------------

    const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const length = (a) => Math.hypot(...a);
    const turn = (v, axis, angle) => { // Rodrigues
        const c = Math.cos(angle), s = Math.sin(angle), d = dot(v, axis) * (1 - c);
        const x = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0]];
        return v.map((n, i) => n * c + x[i] * s + axis[i] * d);
    };
    const clamp = (v, low, high) => Math.min(Math.max(v, low), high);

    // Sets the camera from the module's numbers: the eye, the target, the scene's box.
    function takeCamera(n) {
        const v = (at) => n.slice(at, at + 3);
        const low = v(AT.low), high = v(AT.high), eye = v(AT.eye), ahead = v(AT.back).map((x) => -x);
        const middle = low.map((x, i) => 0.5 * (x + high[i])), size = length(sub(high, low));
        const isInside = eye.every((x, i) => x > low[i] && x < high[i]);
        const far = clamp(dot(sub(middle, eye), ahead), 0.05 * size, 3 * size);
        camera = { eye, target: add(eye, ahead, isInside ? 0.3 * size : far), low, high, size, isInside,
                   halfWidth: n[AT.halfWidth], halfHeight: n[AT.halfHeight], home: null };
    }
    function axes() {
        const a = sub(camera.target, camera.eye), ahead = a.map((x) => x / length(a));
        const r = [-ahead[2], 0, ahead[0]], right = r.map((x) => x / length(r));
        const up = [right[1] * ahead[2] - right[2] * ahead[1], right[2] * ahead[0] - right[0] * ahead[2],
                    right[0] * ahead[1] - right[1] * ahead[0]];
        return { ahead, right, up };
    }
    // Inside a room the view turns; outside, the camera orbits.
    function turnCamera(x, y) {
        const { ahead, right } = axes();
        const level = Math.asin(clamp(ahead[1], -1, 1));
        const rise = clamp(level - y, -1.45, 1.45) - level;
        const to = turn(turn(sub(camera.target, camera.eye), right, rise), [0, 1, 0], -x);
        if (camera.isInside) camera.target = add(camera.eye, to);
        else camera.eye = sub(camera.target, to);
        sendView();
    }
    function moveCamera(share) {
        const { ahead } = axes();
        const step = share * (camera.isInside ? 0.3 * camera.size : length(sub(camera.target, camera.eye)));
        if (!camera.isInside && length(sub(camera.target, camera.eye)) - step < 0.02 * camera.size) return;
        let eye = add(camera.eye, ahead, step);
        if (camera.isInside) {
            eye = eye.map((x, i) => clamp(x, camera.low[i] + 0.02 * camera.size, camera.high[i] - 0.02 * camera.size));
            camera.target = add(eye, sub(camera.target, camera.eye));
        }
        camera.eye = eye;
        sendView();
    }
    function sendView() {
        cut = null;
        if (showsWhole()) showWhole();
        else worker.postMessage({ call: 'set', look: [...camera.eye, ...camera.target] });
        $('error').textContent = '';
        drawOver();
    }

    // Moves lamps across the picture at their depth, and turns suns. x and y are relative to the picture's height.
    function moveLight(x, y) {
        const l = lights[light];
        if (!l) return;
        const { ahead, right, up } = axes();
        if (l.kind === 2) {
            l.direction = turn(turn(l.direction, up, 2 * x), right, 2 * y);
            const n = length(l.direction);
            l.direction = l.direction.map((v) => v / n);
        } else {
            const per = 2 * camera.halfHeight * Math.max(dot(sub(l.position, camera.eye), ahead), 0.1 * camera.size);
            const to = add(add(l.position, right, x * per), up, -y * per);
            const air = 0.01 * camera.size;
            l.position = l.isInside ? to.map((v, i) => clamp(v, camera.low[i] + air, camera.high[i] - air)) : to;
        }
        sendLight();
    }
    function sendLight() {
        const l = lights[light];
        cut = null;
        if (showsWhole()) showWhole();
        else worker.postMessage({ call: 'set', lights: [[light, ...l.position, ...l.direction]] });
        $('error').textContent = '';
        drawOver();
    }
    // Projects a point to px of the canvas; null behind the eye.
    function project(p) {
        const { ahead, right, up } = axes(), d = sub(p, camera.eye), depth = dot(d, ahead);
        if (depth <= 1e-6) return null;
        return { x: $('view').width * (0.5 + 0.5 * dot(d, right) / (depth * camera.halfWidth)),
                 y: $('view').height * (0.5 - 0.5 * dot(d, up) / (depth * camera.halfHeight)), depth };
    }

    // --- over the picture: the light's place, and a cut ------------------------------------------------------------

    function drawOver() {
        over.clearRect(0, 0, $('over').width, $('over').height);
        const scale = $('over').width / Math.max($('over').clientWidth, 1);
        if (tab === 'mix') {
            over.fillStyle = '#ffe9b0';
            over.beginPath();
            over.arc(239.5 + 386 * MIX.at[0] / 2.4, 179.5 - 386 * MIX.at[1] / 2.4, 6 * scale, 0, 7);
            over.fill();
        }
        if (tab !== 'bounce' || !camera || isMap()) return;
        over.lineWidth = 1.5 * scale;
        for (const node of cut ? cut.nodes : []) {
            const p = project(node.at);
            if (!p) continue;
            const r = Math.max(node.radius * $('over').height / (2 * camera.halfHeight * p.depth), 1.5 * scale);
            over.strokeStyle = `hsl(${200 - 25 * node.level} 80% 62% / ${0.35 + 0.65 * node.share})`;
            over.beginPath();
            over.arc(p.x, p.y, Math.min(r, $('over').width), 0, 7);
            over.stroke();
        }
        if (cut) {
            over.strokeStyle = '#fff';
            over.strokeRect((cut.x & -8) - 0.5, (cut.y & -8) - 0.5, 9, 9);
        }
        lights.forEach((l, i) => {
            const p = l.kind !== 2 ? project(l.position) : null;
            if (!p) return;
            over.strokeStyle = i === light && atLight ? '#ffd9a0' : '#ffffffa0';
            over.beginPath();
            over.arc(p.x, p.y, 7 * scale, 0, 7);
            over.moveTo(p.x + 2 * scale, p.y);
            over.arc(p.x, p.y, 2 * scale, 0, 7);
            over.stroke();
        });
    }
    async function askCut(x, y) {
        const answer = await call('cut', { x, y });
        const nodes = [];
        for (let i = 0; i < answer.count; ++i) {
            const n = answer.nodes.slice(NODE * i, NODE * i + NODE);
            nodes.push({ at: n.slice(0, 3), radius: n[3], value: n[4], share: n[5], level: n[6] });
        }
        cut = nodes.length > 0 ? { x, y, nodes } : null;
        document.body.dataset.cut = nodes.length;
        if ($('show').value === 'cut') {
            say(cut ? `${nodes.length} nodes of the light's tree light this pixel; a circle is as large as its node`
                    : 'point at a surface that bounced light reaches');
        }
        drawOver();
    }

    // --- display ---------------------------------------------------------------------------------------------------

    const show = () => $('show').value;
    const showsWhole = () => !['full', 'direct', 'indirect', 'cut'].includes(show());
    const isMap = () => ['light-distance', 'points', 'groups'].includes(show());
    const showNumber = () => ({ direct: DIRECT, indirect: INDIRECT }[show()] || FULL);

    function words() {
        const level = LEVELS[$('quality').value], w = ['render', now.file, '-o', 'page.ppm', '--size', $('size').value,
                                                       '--samples', '1'];
        if (showsWhole()) w.push('--show', show());
        if (isMap()) return [...w, '--shadow-map', show() === 'groups' || show() === 'points' ? '256' : '512'];
        if (level === 'baked' && now.transfer && show() !== 'cut' && show() !== 'occlusion') {
            return [...w, '--transfer', now.transfer];
        }
        return [...w, '--quality', level === 'baked' || show() === 'cut' && level === 'default' ? 'draft' : level];
    }
    async function fetchFile(name) {
        const answer = await fetch(name);
        if (!answer.ok) throw new Error(`${name}: the server says ${answer.status}`);
        return answer.arrayBuffer();
    }
    async function have(names) {
        for (const name of names.filter((n) => n && !now.have.has(n))) {
            const data = await fetchFile(name);
            await call('put', { files: [{ name, data }] }, [data]);
            now.have.add(name);
        }
    }
    const allLights = () => lights.map((l, i) => [i, ...l.position, ...l.direction]);

    // Reopens the scene with the controls' settings; keeps camera, lights and exposure.
    let opening = 0, quick = false;
    async function openOnce(more) {
        const turnOf = opening;
        const answer = await call('open', {
            serial: turnOf, still: showsWhole() || asked.has('still'), look: camera ? [...camera.eye, ...camera.target] : undefined,
            lights: camera ? allLights() : undefined, exposure: now.exposure, ...more });
        if (turnOf !== opening) return null;
        const n = answer.numbers;
        if (!camera) takeLights(n, answer.lights);
        camera.halfWidth = n[AT.halfWidth];
        camera.halfHeight = n[AT.halfHeight];
        $('triangles').textContent = n[AT.triangles].toLocaleString('en');
        return answer;
    }
    async function open(isNew) {
        let turnOf = ++opening;
        quick = false;
        try {
            if (isNew) {
                camera = null;
                lights = [];
                cut = null;
            }
            const level = LEVELS[$('quality').value];
            $('level').textContent = level;
            $('error').textContent = '';
            await have(now.files || []);
            if (turnOf !== opening) return;
            if (level === 'baked' && now.transfer && !now.have.has(now.transfer)) { // direct light while baked light is
                                                                                    // loading
                quick = true;
                await openOnce({ words: ['render', now.file, '-o', 'page.ppm', '--size', $('size').value, '--samples', '1',
                                         '--show', 'direct'], show: DIRECT });
                await have([now.transfer]);
                if (turnOf !== opening) return;
                quick = false;
                turnOf = ++opening;
            }
            frames = [];
            const answer = await openOnce({ words: words(), show: showNumber() });
            if (!answer) return;
            const notes = answer.said.filter((s) => s.includes('note:') || s.includes('no light'));
            say(notes.length > 0 ? notes[0].replace(/^lambent: (note: )?/, '')
                                 : level === 'baked' && now.transfer && show() === 'cut' ? 'cuts light what is not baked: shown by draft'
                                 : show() === 'cut' ? 'point at the picture' : '');
            document.body.dataset.open = turnOf;
            if (showsWhole()) await showWhole();
        } catch (e) {
            if (turnOf === opening) say(e.message, true);
        }
    }
    function takeLights(n, told) {
        takeCamera(n);
        lights = told.map((l) => ({ kind: l[0], position: l.slice(1, 4), direction: l.slice(4, 7),
                                    isInside: l.slice(1, 4).every((x, i) => x >= camera.low[i] && x <= camera.high[i]) }));
        light = 0;
        $('lights').hidden = lights.length < 2;
        $('light').replaceChildren(...lights.map((l, i) => new Option(`${['point', 'spot', 'sun'][l.kind]} ${i + 1}`, i)));
    }

    // Draws pictures other than light whole, one after another.
    let whole = null, again = false;
    async function showWhole() {
        if (whole) {
            again = true;
            return;
        }
        whole = (async () => {
            do {
                again = false;
                $('bar').style.width = '60%';
                await call('setNow', { look: [...camera.eye, ...camera.target], lights: allLights() });
                const m = await call('shown');
                put(m);
                tellTime(m.ms);
                document.body.dataset.shown = show();
            } while (again);
        })();
        try {
            await whole;
        } catch (e) {
            say(e.message, true);
        }
        $('bar').style.width = 0;
        whole = null;
    }

    // --- scenes ----------------------------------------------------------------------------------------------------

    async function choose(i) {
        now = scenes[i];
        now.have = now.have || new Set();
        const canBake = !!now.transfer;
        if (!canBake && $('quality').value === '0') $('quality').value = 1;
        if (canBake && now.exposure === undefined) $('quality').value = 0;
        await open(true);
    }
    async function takeFiles(list) {
        const files = [];
        for (const f of list) files.push({ name: `dropped/${f.name}`, data: await f.arrayBuffer() });
        const main = files.find((f) => /\.(glb|gltf|obj|ply)$/i.test(f.name));
        if (!main) {
            say(`${list.length > 0 ? list[0].name : 'nothing'}: not a scene; .glb, .gltf, .obj and .ply are read`, true);
            return;
        }
        try {
            const transfer = files.find((f) => /\.lmt$/i.test(f.name));
            await call('put', { files });
            scenes.push({ name: main.name.slice(8), file: main.name, transfer: transfer && transfer.name,
                          have: new Set(files.map((f) => f.name)) });
            $('scene').add(new Option(main.name.slice(8), scenes.length - 1));
            $('scene').value = scenes.length - 1;
            ++dropped;
            await choose(scenes.length - 1);
        } catch (e) {
            say(e.message, true);
        }
    }

    // --- the other systems -----------------------------------------------------------------------------------------

    // Reads a binary PPM of 8 bits from the tool.
    function fromPpm(data) {
        const head = new TextDecoder().decode(data.slice(0, 40)).match(/^P6\s+(\d+)\s+(\d+)\s+255\s/);
        const width = +head[1], height = +head[2], from = head[0].length, pixels = new Uint8ClampedArray(4 * width * height);
        for (let i = 0; i < width * height; ++i) {
            for (let c = 0; c < 3; ++c) pixels[4 * i + c] = data[from + 3 * i + c];
            pixels[4 * i + 3] = 255;
        }
        return { width, height, pixels };
    }
    let other = null, otherAgain = false;
    async function drawOther() {
        if (other) {
            otherAgain = true;
            return;
        }
        other = tab;
        try {
            do {
                otherAgain = false;
                const which = tab;
                if (which === 'bounce') break;
                $('bar').style.width = '50%';
                const w = await { relight: relightWords, relief: reliefWords, mix: mixWords }[which]();
                const answer = await call('run', { words: w, out: 'other.ppm' });
                if (tab !== which) continue;
                put(fromPpm(answer.data));
                tellTime(answer.ms);
                document.body.dataset.other = which;
            } while (otherAgain);
        } catch (e) {
            say(e.message, true);
        }
        $('bar').style.width = 0;
        other = null;
    }
    function relightWords() {
        const x = +$('relight-x').value, z = +$('relight-z').value;
        return ['relight', '--world', 'demo', '--object', 'demo', '--at', `${x},0,${z}`, '--at', `${x - 2.4},0,${z + 0.6}`,
                '--roughness', $('relight-r').value, '--eye', `${x - 1},1.7,${z + 7}`, '--target', `${x - 1},1,${z}`,
                '--size', '640x360', '--samples', '1', '-q', '-o', 'other.ppm'];
    }
    const sent = new Set();
    async function need(...names) {
        for (const name of names.filter((n) => !sent.has(n))) {
            const data = await fetchFile(name);
            await call('put', { files: [{ name, data }] }, [data]);
            sent.add(name);
        }
    }
    async function reliefWords() {
        await need('relief.lmr');
        const a = $('relief-turn').value * Math.PI / 180, b = $('relief-up').value * Math.PI / 180, far = RELIEF.far;
        const eye = [far * Math.sin(a) * Math.cos(b), RELIEF.middle + far * Math.sin(b), far * Math.cos(a) * Math.cos(b)];
        return ['relief', 'render', 'relief.lmr', '--eye', eye.map((x) => x.toFixed(4)).join(','), '--target',
                `0,${RELIEF.middle},0`, '--fov', '30', '--size', '480x480', '--samples', '1', '--show', $('relief-show').value,
                '--light', 'sun:0,0,0:-0.6,-0.7,-0.4:3,2.9,2.7', '-q', '-o', 'other.ppm'];
    }
    // The photo shows the demo's room through a lens with 50 degrees of height; the light is in the camera's space.
    const MIX = { file: ['mix/photo.png', 'mix/depth.pfm', 'mix/vase.obj'], lens: '385.99,385.99,239.5,179.5', at: [-0.8, 0.9] };
    async function mixWords() {
        await need(...MIX.file);
        const [x, y] = MIX.at, to = [-0.45 - x, -0.85 - y, -1];
        return ['mix', '--photo', MIX.file[0], '--depth', MIX.file[1], '--intrinsics', MIX.lens, '--object', MIX.file[2], '--fit',
                '--turn', $('mix-turn').value, '--show', $('mix-show').value, '--voxels', '6', '--samples', '1', '--light',
                `spot:${x.toFixed(3)},${y.toFixed(3)},-2.4:${to.map((v) => v.toFixed(3)).join(',')}:14,13.2,12:20,38`,
                '-o', 'other.ppm'];
    }
    const RELIEF = { far: 3, middle: 0.5 };
    const WORDS = {
        relight: 'Two figures take their light from pictures of the field around them, where they stand.',
        relief: 'A complex model, drawn as a few triangles that carry its surface.',
        mix: 'A virtual vase in one photo of a room, with depth. Drag, or arrow keys, move the light that falls on it.',
    };
    function setTab(name) {
        tab = name;
        for (const t of document.querySelectorAll('nav button')) t.setAttribute('aria-selected', t.id === `tab-${name}`);
        for (const e of document.querySelectorAll('[data-for]')) e.hidden = e.dataset.for !== name;
        for (const id of ['ms', 'fps', 'triangles']) $(id).textContent = '';
        over.clearRect(0, 0, $('over').width, $('over').height);
        say(WORDS[name] || '');
        if (name === 'bounce') open(false);
        else {
            worker.postMessage({ call: 'set', checks: false });
            drawOther();
        }
        if (name === 'bounce') worker.postMessage({ call: 'set', checks: !asked.has('nochecks') });
    }

    // --- user input ------------------------------------------------------------------------------------------------

    const held = new Map();
    let holdsLight = false, pinch = 0;
    function place(e) {
        const box = $('over').getBoundingClientRect();
        return { x: (e.clientX - box.left) / box.width * $('over').width, y: (e.clientY - box.top) / box.height * $('over').height,
                 unit: $('over').height / box.height };
    }
    function moveMix(dx, dy) {
        MIX.at = [clamp(MIX.at[0] + dx, -1.4, 1.4), clamp(MIX.at[1] - dy, -0.4, 1.05)];
        drawOver();
        drawOther();
    }
    $('over').addEventListener('pointerdown', (e) => {
        if (tab === 'mix') $('over').setPointerCapture(e.pointerId), held.set(e.pointerId, { x: e.clientX, y: e.clientY });
        if (tab !== 'bounce' || !camera || isMap()) return;
        $('over').setPointerCapture(e.pointerId);
        $('picture').focus({ preventScroll: true });
        const p = place(e);
        held.set(e.pointerId, { x: e.clientX, y: e.clientY });
        holdsLight = atLight;
        lights.forEach((l, i) => {
            const at = l.kind !== 2 && project(l.position);
            if (at && Math.hypot(at.x - p.x, at.y - p.y) < 22 * p.unit) {
                light = i;
                holdsLight = true;
            }
        });
        $('picture').classList.add('holds');
    });
    $('over').addEventListener('pointermove', (e) => {
        const before = held.get(e.pointerId);
        if (!before) {
            if (show() === 'cut' && camera) {
                const p = place(e);
                askCutSoon(Math.floor(p.x), Math.floor(p.y));
            }
            return;
        }
        const dx = e.clientX - before.x, dy = e.clientY - before.y, high = $('over').getBoundingClientRect().height;
        held.set(e.pointerId, { x: e.clientX, y: e.clientY });
        if (tab === 'mix') return moveMix(2.2 * dx / high, 2.2 * dy / high);
        if (held.size === 2) {
            const [a, b] = [...held.values()], wide = Math.hypot(a.x - b.x, a.y - b.y);
            if (pinch > 0) moveCamera(1 - pinch / wide);
            pinch = wide;
        } else if (holdsLight) moveLight(dx / high, dy / high);
        else turnCamera((camera.isInside ? -1.4 : 3) * dx / high, (camera.isInside ? -1.4 : 3) * dy / high);
    });
    for (const kind of ['pointerup', 'pointercancel']) {
        $('over').addEventListener(kind, (e) => {
            held.delete(e.pointerId);
            pinch = 0;
            if (held.size === 0) $('picture').classList.remove('holds');
        });
    }
    let cutWanted = null, cutAsked = false;
    async function askCutSoon(x, y) {
        cutWanted = [x, y];
        if (cutAsked) return;
        cutAsked = true;
        while (cutWanted) {
            const at = cutWanted;
            cutWanted = null;
            await askCut(...at);
        }
        cutAsked = false;
    }
    $('over').addEventListener('wheel', (e) => {
        if (tab !== 'bounce' || !camera || isMap()) return;
        e.preventDefault();
        moveCamera(-0.0012 * clamp(e.deltaY, -200, 200));
    }, { passive: false });
    $('picture').addEventListener('keydown', (e) => {
        if (!/bounce|mix/.test(tab) || !camera || e.ctrlKey || e.metaKey || e.altKey) return;
        const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
        if (tab === 'mix') {
            if (step) {
                moveMix(0.1 * step[0], 0.1 * step[1]);
                e.preventDefault();
            }
            return;
        }
        if (step && atLight) moveLight(0.03 * step[0], 0.03 * step[1]);
        else if (step) turnCamera(0.06 * step[0], 0.06 * step[1]);
        else if (e.key === '+' || e.key === '=') moveCamera(0.08);
        else if (e.key === '-') moveCamera(-0.08);
        else if (e.key === 'l' || e.key === 'L') setDrag(!atLight);
        else return;
        e.preventDefault();
    });
    function setDrag(isLight) {
        atLight = isLight;
        $('drag-camera').setAttribute('aria-pressed', !isLight);
        $('drag-light').setAttribute('aria-pressed', isLight);
        drawOver();
    }
    $('drag-camera').onclick = () => setDrag(false);
    $('drag-light').onclick = () => setDrag(true);
    $('light').onchange = () => { light = +$('light').value; drawOver(); };
    $('scene').onchange = () => choose(+$('scene').value);
    $('quality').oninput = () => {
        if ($('quality').value === '0' && now && !now.transfer) {
            $('quality').value = 1;
            say('nothing is baked for this scene; `lambent bake` makes a .lmt, to be dropped with it');
        }
        $('level').textContent = LEVELS[$('quality').value];
        open(false);
    };
    $('size').onchange = $('show').onchange = () => { cut = null; open(false); };
    $('pick').onclick = () => $('files').click();
    $('files').onchange = () => takeFiles([...$('files').files]);
    for (const kind of ['dragover', 'dragleave', 'drop']) {
        document.addEventListener(kind, (e) => {
            e.preventDefault();
            $('picture').classList.toggle('drop', kind === 'dragover');
            if (kind === 'drop') takeFiles([...e.dataTransfer.files]);
        });
    }
    for (const t of document.querySelectorAll('nav button')) t.onclick = () => setTab(t.id.slice(4));
    for (const id of ['relight-x', 'relight-z', 'relight-r', 'relief-turn', 'relief-up', 'relief-show', 'mix-show', 'mix-turn']) $(id).oninput = drawOther;

    // --- start -----------------------------------------------------------------------------------------------------

    async function begin() {
        if ('serviceWorker' in navigator && !asked.has('noservice')) {
            navigator.serviceWorker.register('lambent.js').catch(() => {});
        }
        for (const e of document.querySelectorAll('[data-for]')) e.hidden = e.dataset.for !== 'bounce';
        const list = fetch('scenes.json').then((a) => a.ok ? a.json() : []).catch(() => []);
        const threads = +asked.get('threads') || Math.min(navigator.hardwareConcurrency || 1, 8);
        runs = await call('start', { threads, kernels: asked.get('kernels') });
        $('runs').textContent = `${runs.threads} thread${runs.threads > 1 ? 's' : ''}, ${runs.kernels}`;
        $('runs').title = runs.isolated ? '' : 'the page is not cross-origin isolated: reload it once to use all threads';
        scenes = [{ name: 'demo', file: 'demo' }, ...await list].map((s) => ({ ...s }));
        const own = scenes.filter((s) => s.file === 'demo');
        if (own.length > 1) scenes = [Object.assign(own[0], own[1]), ...scenes.filter((s) => s.file !== 'demo')];
        $('scene').replaceChildren(...scenes.map((s, i) => new Option(s.name, i)));
        if (asked.has('nochecks')) worker.postMessage({ call: 'set', checks: false });
        $('quality').value = 1;
        if (asked.has('size')) $('size').value = asked.get('size');
        await choose(Math.max(scenes.findIndex((s) => s.name === asked.get('scene')), 0));
        document.body.dataset.ready = 1;
    }
    window.lambent = { call, get state() { return { camera, lights, now, runs }; } }; // for tests
    begin().catch((e) => say(e.message, true));
}

if (typeof document !== 'undefined') page();
else if (self.name === 'helper') helper();
else engine();
