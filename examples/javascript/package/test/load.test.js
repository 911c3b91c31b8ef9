// The module is loaded from wherever it is.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { Worker } from 'node:worker_threads';

const address = new URL('../twohalf.wasm', import.meta.url);
const index = new URL('../index.js', import.meta.url);

/** Loads it in a fresh program, which steps a simulator once. */
function load(source) {
  const program = `
    const { parentPort, workerData } = require('node:worker_threads');
    import(${JSON.stringify(index)}).then(async ({ Simulator, initialize }) => {
      await initialize(workerData);
      const simulator = new Simulator();
      simulator.createCircleBody(1, 1);
      simulator.step(0.1);
      parentPort.postMessage(simulator.positions.length);
    });`;
  return new Promise((resolve, reject) => {
    const worker = new Worker(program, { eval: true, workerData: source });
    worker.once('message', resolve);
    worker.once('error', reject);
  });
}

test('from its bytes, and compiled', async () => {
  const bytes = await readFile(address);
  assert.equal(await load(bytes), 3);
  assert.equal(await load(new WebAssembly.Module(bytes)), 3);
});

test('from beside the package, and from an address on the disk or the net', async () => {
  assert.equal(await load(undefined), 3);
  assert.equal(await load(address.href), 3);
  const server = createServer(async (request, response) => {
    if (request.url !== '/there.wasm') response.statusCode = 404;
    response.end(await readFile(address));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address();
  try {
    assert.equal(await load(`http://127.0.0.1:${port}/there.wasm`), 3);
    await assert.rejects(load(`http://127.0.0.1:${port}/elsewhere.wasm`), { message: /could not be loaded: 404/ });
  } finally {
    server.closeAllConnections();
    server.close();
  }
});
