// probes.mjs: reads the two files of `lambent bake --to probes`, and evaluates irradiance at a place for a normal.
//
//     const probes = openProbes(await (await fetch('air.json')).json(), await (await fetch('air.bin')).arrayBuffer());
//     const [r, g, b] = probes.irradiance([x, y, z], [nx, ny, nz]); // W/m2; a surface reflects albedo / pi of it

const cosine = [3.141593, 2.094395, 2.094395, 2.094395, 0.785398, 0.785398, 0.785398, 0.785398, 0.785398];
const open = 0.25, side = 4; // less open places lie in solids; texels along an edge of a face of distances

// Real spherical harmonics of a unit vector, in the order l l + l + m.
const harmonics = ([x, y, z]) => [
    0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
    0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)];
const sum = (values) => values.reduce((a, b) => a + b, 0), length = (v) => Math.hypot(...v);

// The four texels of the cube map around a direction, each with a weight; and the component along the face's axis.
const texels = (way) => {
    const size = way.map(Math.abs), axis = size.indexOf(Math.max(...size)), along = size[axis];
    const [x, y] = [1, 2].map((n) => (0.5 + 0.5 * way[(axis + n) % 3] / along) * side - 0.5);
    const [i, j] = [x, y].map((f) => Math.floor(Math.min(Math.max(f, 0), side - 2)));
    const first = ((2 * axis + (way[axis] < 0 ? 1 : 0)) * side + j) * side + i, u = x - i, v = y - j;
    return [along, [[first, (1 - u) * (1 - v)], [first + 1, u * (1 - v)], [first + side, (1 - u) * v], [first + side + 1, u * v]]];
};

export function openProbes(header, numbers) {
    const { first, step, count, floats } = header, bytes = new DataView(numbers), shortest = Math.min(...step);
    if (header.lambent !== 'probes' || numbers.byteLength !== 4 * floats * count[0] * count[1] * count[2])
        throw new Error('these are no probes of lambent, or the numbers are of another file');
    const number = (i) => bytes.getFloat32(4 * i, true);

    // Returns the last probe before a coordinate, and the weight of the next one.
    const before = (at, k) => {
        const along = Math.min(Math.max((at - first[k]) / step[k], 0), count[k] - 1);
        const i = Math.min(Math.floor(along), Math.max(count[k] - 2, 0));
        return [i, along - i];
    };

    // How far a place uses a probe: less if the probe lies behind the surface, or if other surfaces lie between them.
    const visibility = (from, probe, at, normal) => {
        const away = probe.map((p, c) => p - at[c]), moved = at.map((a, c) => a + 0.2 * shortest * normal[c] - probe[c]);
        const facing = length(away) > 0 ? 0.5 + 0.5 * sum(away.map((a, c) => a * normal[c])) / length(away) : 1;
        let seen = 1;
        if (length(moved) > 0) {
            const [along, map] = texels(moved), mean = sum(map.map(([t, w]) => w * number(from + 28 + 2 * t)));
            const square = sum(map.map(([t, w]) => w * number(from + 29 + 2 * t)));
            const over = mean - 1 / along, variance = Math.max(square - mean * mean, (0.02 * mean) ** 2);
            if (over > 0) seen = (variance / (variance + over * over)) ** 3;
        }
        const weight = Math.max(seen * (facing * facing + 0.2), 1e-4);
        return (weight < 0.2 ? weight ** 3 / 0.04 : weight) * (number(from + 27) < open ? 1e-4 : 1);
    };

    const irradiance = (at, normal) => {
        const place = at.map(before), y = harmonics(normal), out = [0, 0, 0];
        let weights = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const next = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weight = next.reduce((w, n, k) => w * (n ? place[k][1] : 1 - place[k][1]), 1);
            if (weight === 0) continue;
            const index = next.map((n, axis) => place[axis][0] + n);
            const from = floats * (index[0] + count[0] * (index[1] + count[1] * index[2]));
            if (floats > 28) weight *= visibility(from, index.map((i, c) => first[c] + i * step[c]), at, normal);
            weights += weight;
            for (let term = 0; term < 27; ++term)
                out[term % 3] += weight * number(from + term) * y[Math.floor(term / 3)] * cosine[Math.floor(term / 3)];
        }
        return out.map((v) => Math.max(v / weights, 0));
    };
    return { irradiance };
}
