// probes.mjs: reads the two files of `lambent bake --to probes`, and evaluates irradiance at a place for a normal.
//
//     const probes = openProbes(await (await fetch('air.json')).json(), await (await fetch('air.bin')).arrayBuffer());
//     const [r, g, b] = probes.irradiance([x, y, z], [nx, ny, nz]); // W/m2; a surface reflects albedo / pi of it

const cosine = [3.141593, 2.094395, 2.094395, 2.094395, 0.785398, 0.785398, 0.785398, 0.785398, 0.785398];

// Real spherical harmonics of a unit vector, in the order l l + l + m.
const harmonics = ([x, y, z]) => [
    0.282095, 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
    0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)];

export function openProbes(header, numbers) {
    const { first, step, count, floats } = header, bytes = new DataView(numbers);
    if (header.lambent !== 'probes' || numbers.byteLength !== 4 * floats * count[0] * count[1] * count[2])
        throw new Error('these are no probes of lambent, or the numbers are of another file');

    // Returns the last probe before a coordinate, and the weight of the next one.
    const before = (at, k) => {
        const along = Math.min(Math.max((at - first[k]) / step[k], 0), count[k] - 1);
        const i = Math.min(Math.floor(along), Math.max(count[k] - 2, 0));
        return [i, along - i];
    };

    const irradiance = (at, normal) => {
        const place = at.map(before), y = harmonics(normal), out = [0, 0, 0];
        for (let corner = 0; corner < 8; ++corner) {
            const next = [corner & 1, corner >> 1 & 1, corner >> 2];
            const weight = next.reduce((w, n, k) => w * (n ? place[k][1] : 1 - place[k][1]), 1);
            if (weight === 0) continue;
            const [i, j, k] = next.map((n, axis) => place[axis][0] + n);
            const from = 4 * floats * (i + count[0] * (j + count[1] * k));
            for (let term = 0; term < 27; ++term)
                out[term % 3] += weight * bytes.getFloat32(from + 4 * term, true) * y[Math.floor(term / 3)] * cosine[Math.floor(term / 3)];
        }
        return out.map((v) => Math.max(v, 0));
    };
    return { irradiance };
}
