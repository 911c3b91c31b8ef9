// `build` removes the messages of panics from a module, and no other code.

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const script = fileURLToPath(new URL('../../without_panics.mjs', import.meta.url));

/** The functions after the removal, without indentation. */
function without(text) {
  const { status, stdout, stderr } = spawnSync(process.execPath, [script], { input: `(module\n${text}\n)\n`, encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  return stdout.replace(/^ +/gm, '');
}

const PANIC = ` (func $panic (param $0 i32)
  (call $tell
   (local.get $0)
  )
  (unreachable)
 )`;

test('a function that only panics traps at once, and so do its callers', () => {
  const text = without(`${PANIC}
 (func $caller
  (call $panic
   (i32.const 7)
  )
 )`);
  assert.equal(text, '(module\n(func $caller\n(unreachable)\n)\n(func $panic (param $0 i32)\n(unreachable)\n)\n)\n');
});

test('a function that may return stays as it is', () => {
  const text = without(` (func $maybe (param $0 i32)
  (if
   (local.get $0)
   (return)
  )
  (unreachable)
 )
 (func $caller
  (call $maybe
   (i32.const 7)
  )
 )`);
  assert.match(text, /\(call \$maybe\n/);
  assert.match(text, /\(return\)\n\)\n\(unreachable\)/);
});

test('a check traps where it stands, and what leads elsewhere stays', () => {
  const text = without(`${PANIC}
 (func $checked (param $0 i32) (result i32)
  (block $bad
   (block $good
    (br_if $bad
     (local.get $0)
    )
    (br $good)
   )
   (return
    (i32.const 1)
   )
  )
  (call $panic
   (i32.const 7)
  )
 )`);
  assert.match(text, /\(if\n\(local.get \$0\)\n\(then\n\(unreachable\)\n\)\n\)\n\(br \$good\)/);
});

test('a place in the source is blanked, and the text of a refusal stays', () => {
  const path = 'a.rs';
  const place = '\\00\\04\\00\\00\\04\\00\\00\\00\\03\\00\\00\\00\\t\\00\\00\\00'; // 4 bytes at 1024, line 3, column 9
  const refusal = 'radius\\00\\00\\14\\04\\00\\00\\06\\00\\00\\00'; // and where it is: 6 bytes at 1044
  const text = without(` (data $.rodata (i32.const 1024) "${path}${place}${refusal}")`);
  const left = `${'00'.repeat(20)}${Buffer.from('radius').toString('hex')}00001404000006000000`;
  assert.equal(text.match(/"(.*)"/)[1].replaceAll('\\', ''), left);
});
