// probes_test.mjs: tests the reader of probes with light computed by hand, and with a file of the tool: probes_test.mjs
// AIR.json
import fs from 'fs';
import { openProbes } from './probes.mjs';

let failed = 0;
const check = (what, is, wanted) => {
    if (is.every((v, i) => Math.abs(v - wanted[i]) < 1e-4)) return;
    console.log(`FAIL ${what}: ${is}, not ${wanted}`);
    failed = 1;
};

// Two probes along x: the first without light, the second with red radiance 1 from all directions, and with a green
// term along +y.
const numbers = new DataView(new ArrayBuffer(2 * 28 * 4));
numbers.setFloat32(4 * 28, 1 / 0.282095, true);
numbers.setFloat32(4 * (28 + 4), 0.5, true);
const header = { lambent: 'probes', first: [1, 0, 0], step: [2, 1, 1], count: [2, 1, 1], floats: 28 };
const two = openProbes(header, numbers.buffer), green = 0.5 * 0.488603 * 2.094395;
check('all around', two.irradiance([3, 0, 0], [0, 0, 1]), [Math.PI, 0, 0]);
check('along a term', two.irradiance([3, 5, 5], [0, 1, 0]), [Math.PI, green, 0]);
check('away from it', two.irradiance([3, 0, 0], [0, -1, 0]), [Math.PI, 0, 0]);
check('between places', two.irradiance([1.5, 0, 0], [0, 1, 0]), [Math.PI / 4, green / 4, 0]);
check('beyond the lattice', two.irradiance([-9, 0, 0], [0, 1, 0]), [0, 0, 0]);
try {
    openProbes(header, new ArrayBuffer(8));
    check('too few numbers are refused', [0], [1]);
} catch (e) {
    check('and the error says so', [+e.message.includes('no probes')], [1]);
}

// Two probes with distances: surfaces are 1 m around the first and far from the second, in all directions. A place 1.5 m
// from the first cannot see it. If a probe lies in a solid, the other one lights the place.
const far = new DataView(new ArrayBuffer(2 * 220 * 4)), put = (probe, i, v) => far.setFloat32(4 * (220 * probe + i), v, true);
for (let probe = 0; probe < 2; ++probe) {
    put(probe, 3 * 0 + probe, 1 / 0.282095); // the first is red, the second green
    put(probe, 27, 1);
    for (let t = 0; t < 96; ++t) { put(probe, 28 + 2 * t, probe ? 0.1 : 1); put(probe, 29 + 2 * t, probe ? 0.01 : 1); }
}
const walled = openProbes({ ...header, floats: 220 }, far.buffer);
const redShare = (at, normal) => { const [r, g] = walled.irradiance(at, normal); return r / (r + g); };
check('light is no more for two probes', [redShare([1.2, 0, 0], [0, 1, 0]) > 0.5, Math.abs(walled.irradiance([1.2, 0, 0], [0, 1, 0]).reduce((a, b) => a + b) - Math.PI) < 1e-3].map(Number), [1, 1]);
check('a probe behind a wall does not count', [+(redShare([2.5, 0, 0], [0, 1, 0]) < 1e-3)], [1]);
check('a probe behind the surface counts less', [+(redShare([1.5, 0, 0], [1, 0, 0]) < redShare([1.5, 0, 0], [-1, 0, 0]) / 1.5)], [1]);
put(0, 27, 0);
check('a probe in a solid does not count', [+(redShare([1.2, 0, 0], [0, 1, 0]) < 1e-2)], [1]);

// A wall 1 m from the first probe, on one side of it, in the layout of tools/bake/light_distances.h.
put(0, 27, 1);
for (const [axis, way] of [[0, 1], [1, 1], [1, -1], [2, 1], [2, -1]]) {
    for (let t = 0; t < 96; ++t) {
        const face = t >> 4, a = face >> 1, d = [0, 0, 0];
        d[a] = face & 1 ? -1 : 1;
        d[(a + 1) % 3] = (2 * (t & 3) + 1) / 4 - 1;
        d[(a + 2) % 3] = (2 * (t >> 2 & 3) + 1) / 4 - 1;
        const inverse = Math.max(d[axis] * way, 0);
        put(0, 28 + 2 * t, inverse); put(0, 29 + 2 * t, inverse * inverse);
        put(1, 28 + 2 * t, 0); put(1, 29 + 2 * t, 0);
    }
    const place = (far) => [1.4, 0.2, -0.3].map((v, c) => v + (c === axis ? far * way : 0)), up = [0, 0, 0].map((v, c) => +(c === (axis + 1) % 3));
    check(`the wall of axis ${axis}, ${way}: beyond it`, [+(redShare(place(1.5), up) < 0.02)], [1]);
    const other = axis === 1 ? 2 : 1, aside = (far, by) => place(far).map((v, c) => v + (c === other ? by : 0));
    for (const by of [-2.2, 2.2]) {
        check(`the wall of axis ${axis}, ${way}: beyond it, ${by} m aside`, [+(redShare(aside(1.8, by), up) < 0.1)], [1]);
        check(`the wall of axis ${axis}, ${way}: on the other side, ${by} m aside`, [+(redShare(aside(-1.8, by), up) > 0.2)], [1]);
    }
    check(`the wall of axis ${axis}, ${way}: before it`, [+(redShare(place(0.3), up) > 0.25)], [1]);
    check(`the wall of axis ${axis}, ${way}: on the other side`, [+(redShare(place(-1.5), up) > 0.25)], [1]);
}

const file = process.argv[2], air = JSON.parse(fs.readFileSync(file)), all = fs.readFileSync(file.replace(/\.json$/, '.bin'));
const probes = openProbes(air, all.buffer.slice(all.byteOffset, all.byteOffset + all.length));
const middle = air.first.map((v, k) => v + air.step[k] * (air.count[k] - 1) / 2);
const sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]].map((n) => probes.irradiance(middle, n));
check('the middle of the room is lit from all sides', sides.map((v) => +(v[0] > 0 && v[1] > 0 && v[2] > 0)), sides.map(() => 1));
const redness = (v) => v[0] / (v[0] + v[1] + v[2]); // the demo's wall at -x is red
check('red comes from the red wall', [+(redness(sides[1]) > 1.3 * redness(sides[0]))], [1]);
process.exit(failed);
