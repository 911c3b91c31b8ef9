// Runs a program built for wasm32-wasip1: node run_wasi.mjs FILE.wasm [ARGUMENT...]
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';

const [, , file, ...rest] = process.argv;
const wasi = new WASI({ version: 'preview1', args: [file, ...rest], env: {} });
const module = await WebAssembly.compile(await readFile(file));
process.exit(wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject())));
