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

const file = process.argv[2], air = JSON.parse(fs.readFileSync(file)), all = fs.readFileSync(file.replace(/\.json$/, '.bin'));
const probes = openProbes(air, all.buffer.slice(all.byteOffset, all.byteOffset + all.length));
const middle = air.first.map((v, k) => v + air.step[k] * (air.count[k] - 1) / 2);
const sides = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]].map((n) => probes.irradiance(middle, n));
check('the middle of the room is lit from all sides', sides.map((v) => +(v[0] > 0 && v[1] > 0 && v[2] > 0)), sides.map(() => 1));
const redness = (v) => v[0] / (v[0] + v[1] + v[2]); // the demo's wall at -x is red
check('red comes from the red wall', [+(redness(sides[1]) > 1.3 * redness(sides[0]))], [1]);
process.exit(failed);
