// The same bits as the engines outside of WebAssembly, and after going back.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import * as engine from '../index.js';
import { Hash, SCENES, STEPS, play } from './scenes.js';

await engine.initialize();

const arguments_ = ['run', '--quiet', '--locked', '-p', 'twohalf-javascript', '--bin', 'javascript_scenes'];
const printed = execFileSync('cargo', arguments_, { cwd: import.meta.dirname, encoding: 'utf8' });
const natively = new Map(printed.trim().split('\n').map((line) => line.split(': ')));

function hashOf(bytes) {
  const hash = new Hash();
  hash.words(bytes);
  return hash.value;
}

test('there is a native scene for each of these', () => {
  assert.deepEqual([...natively.keys()], Object.keys(SCENES));
});

for (const [name, make] of Object.entries(SCENES)) {
  test(`${name}: 600 steps and the snapshot after them have the bits of the native engine`, () => {
    const scene = make(engine);
    const motion = play(scene);
    assert.equal(`${motion} ${hashOf(scene.simulator.snapshot())}`, natively.get(name));
  });

  test(`${name}: what is restored in mid-run goes on with the same bits, also in another simulator`, () => {
    const scene = make(engine);
    play(scene, 0, 200);
    const snapshot = scene.simulator.snapshot();
    const once = play(scene, 200, STEPS);
    scene.simulator.restore(snapshot);
    assert.equal(play(scene, 200, STEPS), once);

    const other = make(engine);
    play(other, 0, 7);
    other.simulator.restore(snapshot);
    assert.equal(play(other, 200, STEPS), once);
  });
}
