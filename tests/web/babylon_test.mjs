// babylon_test.mjs: tests baked lightmaps in Babylon.js, without a GPU: babylon_test.mjs MODULES FILE...
//
// The material of each mesh has the lightmap in a slot without an effect.
import fs from 'fs';
import path from 'path';
import { createRequire } from 'module';

const [modules, ...files] = process.argv.slice(2);
const from = createRequire(path.resolve(modules, 'package.json'));
const { NullEngine, Scene, LoadAssetContainerAsync } = from('@babylonjs/core');
from('@babylonjs/loaders/glTF');
let failed = 0;
for (const file of files) {
    const scene = new Scene(new NullEngine());
    const data = 'data:model/gltf-binary;base64,' + fs.readFileSync(file).toString('base64');
    const read = await LoadAssetContainerAsync(data, scene, { pluginExtension: '.glb' });
    const meshes = read.meshes.filter((m) => m.getTotalVertices() > 0);
    const lit = meshes.filter((m) => {
        const own = m.material, t = own.ambientTexture || own.emissiveTexture;
        return t && t.getInternalTexture()?.label === 'lambent lightmap' && t.coordinatesIndex > 0 &&
               (own.ambientTexture ? own.ambientTextureStrength === 0 : own.emissiveColor.toLuminance() === 0);
    });
    console.log(`${file}: Babylon.js reads ${meshes.length} meshes, ${lit.length} with the picture of light`);
    failed |= meshes.length === 0 || lit.length !== meshes.length;
}
process.exit(failed ? 1 : 0);
