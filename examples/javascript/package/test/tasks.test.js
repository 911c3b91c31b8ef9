// Five small games of at most 30 lines each.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const TASKS = {
  pile: /^100 of 100 crates sleep$/,
  ragdoll: /^the arm is at -(0\.9|1\.0) rad$/,
  platform: /^4 jumps, and aboard$/,
  coins: /^1 coin, sounds: (\d\.\d\d ?){3,}$/,
  ledges: /^heights 50 100 150, then 100$/,
};

for (const [name, said] of Object.entries(TASKS)) {
  test(`${name} does what it should, in at most 30 lines`, () => {
    const file = new URL(`../tasks/${name}.js`, import.meta.url);
    assert.ok(readFileSync(file, 'utf8').trim().split('\n').length <= 30);
    assert.match(execFileSync(process.execPath, [file.pathname], { encoding: 'utf8' }).trim(), said);
  });
}
