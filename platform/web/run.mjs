// run.mjs: runs a WebAssembly program of start_web.c in node: node run.mjs PROGRAM
import fs from 'fs';

let memory;

function put(address) {
    const bytes = new Uint8Array(memory.buffer, address);
    process.stdout.write(Buffer.from(bytes.subarray(0, bytes.indexOf(0))));
}

const { instance } = await WebAssembly.instantiate(fs.readFileSync(process.argv[2]), { env: { put } });
memory = instance.exports.memory;
process.exitCode = instance.exports.run();
