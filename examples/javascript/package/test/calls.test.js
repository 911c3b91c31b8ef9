// The functions of the module return or refuse for all numbers, and never trap.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const compiled = (name) => new WebAssembly.Module(readFileSync(new URL(`../${name}.wasm`, import.meta.url)));
const MODULES = { twohalf: compiled('twohalf'), plane: compiled('plane') };
const NUMBERS = [0, 1, 1, 2, 3, 5, 16, -1, 0.5, 10, 100, 1e-30, 3e38, 1e300, 2 ** 25, 2e9, 4e9, 2 ** 32, 2 ** 53, -2e9, NaN, Infinity];

/** Marsaglia's xorshift, in 32 bits. */
function random(seed) {
  let state = seed;
  return (below) => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) % below;
  };
}

for (let seed = 1; seed <= 20; seed++) {
  const [name, module] = Object.entries(MODULES)[seed % 2];
  test(`3,000 calls of ${name} at random from seed ${seed} answer or refuse, with words`, () => {
    const { exports } = new WebAssembly.Instance(module);
    const names = Object.keys(exports).filter((name) => typeof exports[name] === 'function').sort();
    const pick = random(seed * 7919);
    exports.simulator_new(0, 100);
    exports.depth_new?.(480, 60, 0, 100) ?? exports.simulator_new(0, 100);
    const tally = { answered: 0, refused: 0 };
    for (let call = 0; call < 3000; call++) {
      const name = names[pick(names.length)];
      if (name === 'simulator_free') continue;
      const values = Array.from({ length: exports[name].length }, () => NUMBERS[pick(NUMBERS.length)]);
      if (!name.startsWith('depth_new') && !name.startsWith('simulator_new')) values[0] = pick(8) ? pick(2) : values[0];
      let answer;
      try {
        answer = exports[name](...values);
      } catch (error) {
        assert.fail(`${name}(${values.join(', ')}): ${error}`);
      }
      tally[Number.isNaN(answer) ? 'refused' : 'answered'] += 1;
      if (Number.isNaN(answer)) assert.ok(exports.text_length() > 0, name);
    }
    assert.ok(tally.answered > 300 && tally.refused > 300, JSON.stringify(tally));
  });
}
