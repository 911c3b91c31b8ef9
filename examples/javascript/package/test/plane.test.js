// The entry of 2D alone: the same engine, in a smaller module.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { test } from 'node:test';
import { Worker } from 'node:worker_threads';
import * as plane from '../plane.js';
import { SCENES, STEPS, play } from './scenes.js';

const HERE = import.meta.url;
const PLANE_SCENES = ['pile', 'faithful pile', 'machines'];

/** Plays the scenes with an entry of the package in a program of its own: their hashes. */
function playWith(entry) {
  const program = `
    const { parentPort } = require('node:worker_threads');
    (async () => {
      const engine = await import(${JSON.stringify(new URL(entry, HERE))});
      const { SCENES, play } = await import(${JSON.stringify(new URL('scenes.js', HERE))});
      await engine.initialize();
      parentPort.postMessage(${JSON.stringify(PLANE_SCENES)}.map((name) => play(SCENES[name](engine))));
    })();`;
  return new Promise((resolve, reject) => {
    const worker = new Worker(program, { eval: true });
    worker.once('message', resolve);
    worker.once('error', reject);
  });
}

test('it is an entry of the package', async () => {
  const { exports, files } = JSON.parse(await readFile(new URL('../package.json', HERE), 'utf8'));
  assert.deepEqual(exports['./plane'], { types: './plane.d.ts', default: './plane.js' });
  for (const file of ['plane.d.ts', 'plane.wasm']) assert.ok(files.includes(file), file);
});

test('scenes have the same bits with it as with both engines', async () => {
  assert.deepEqual(await playWith('../plane.js'), await playWith('../index.js'));
});

test('a snapshot goes on with the same bits', async () => {
  await plane.initialize();
  const scene = SCENES.pile(plane);
  play(scene, 0, 200);
  const snapshot = scene.simulator.snapshot();
  const once = play(scene, 200, STEPS);
  scene.simulator.restore(snapshot);
  assert.equal(play(scene, 200, STEPS), once);
});

test('it has nothing of 2.5D, which says so where it is asked for', async () => {
  await plane.initialize();
  assert.equal(plane.DepthSimulator, undefined);
  const { DepthSimulator } = await import('../index.js');
  assert.throws(() => new DepthSimulator({ height: 480 }), { name: 'PhysicsError', message: /2D alone/ });
});

test('its module is smaller by a fifth at least', async () => {
  const [alone, both] = await Promise.all(['../plane.wasm', '../twohalf.wasm'].map((file) => readFile(new URL(file, HERE))));
  assert.ok(alone.length < 0.8 * both.length, `${alone.length} and ${both.length} bytes`);
});
