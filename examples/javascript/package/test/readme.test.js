// The README runs as it is printed.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

test('the code of the README runs, and says what it should', () => {
  const text = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const code = [...text.matchAll(/```js\n([\s\S]*?)```/g)].map(([, block]) => block).join('\n');
  const options = { cwd: new URL('..', import.meta.url), input: code, encoding: 'utf8' };
  const said = execFileSync(process.execPath, ['--input-type=module'], options);
  assert.match(said, /a thud of 2\d\d px\/s/);
  assert.match(said, /it rests at 80\.0/);
  assert.match(said, /the way is free/);
  assert.match(said, /the hero is at -?\d/);
  assert.match(said, /the replay parts at null/);
  assert.match(said, /draw it at [\d, \n]*draw it at/);
  assert.match(said, /the player is on the platform: true/);
});
