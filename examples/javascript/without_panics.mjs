// Removes the code for the messages of panics from a module, in the text format of `wasm-dis`: no message is ever shown.
// A panic ends in a trap, before and after.

import { readFileSync } from 'node:fs';

/** Parses expressions, each on lines of its own: its first line, and the inner expressions, or null if it has one line. */
function parse(lines) {
  const top = [];
  const open = [top];
  for (const line of lines) {
    const text = line.trim();
    if (text === ')') {
      open.pop();
      continue;
    }
    const inner = text.split('(').length > text.split(')').length ? [] : null;
    open.at(-1).push({ text, inner });
    if (inner !== null) open.push(inner);
  }
  return top;
}

function print({ text, inner }) {
  return inner === null ? text : [text, ...inner.map(print), ')'].join('\n');
}

const TRAP = { text: '(unreachable)', inner: null };
const isTrap = (expression) => expression?.text === TRAP.text;

const nameOf = ({ text }) => /\$[^\s)]+/.exec(text)?.[0];

const returns = ({ text, inner }) => text.startsWith('(return') || (inner ?? []).some(returns);

/** Whether a function ends in a trap, whichever way it goes: so do those that panic, and no others. */
const isPanic = (definition) => isTrap(definition.inner?.at(-1)) && !returns(definition);

/** Puts traps in place of calls of `panics`, and of branches to a trap. `leadsToTrap`: the expression after `list` is a trap. */
function shorten(list, panics, leadsToTrap, doomed) {
  for (let index = list.length - 1; index >= 0; index--) {
    const expression = list[index];
    const { text, inner } = expression;
    const name = nameOf(expression);
    if (text.startsWith('(call $') && panics.has(name)) list[index] = TRAP;
    else if (text === `(br ${name})` && doomed.has(name)) list[index] = TRAP;
    else if (inner !== null) {
      const isBlock = text === '(block' || text === `(block ${name}`;
      const isDoomed = isBlock && (index + 1 < list.length ? isTrap(list[index + 1]) : leadsToTrap);
      if (isDoomed) doomed.add(name);
      shorten(inner, panics, isDoomed, doomed);
      // So the same few bytes follow each check, not branches with different depths: they compress better.
      if (text === `(br_if ${name}` && doomed.has(name)) {
        list[index] = { text: '(if', inner: [...inner, { text: '(then', inner: [TRAP] }] };
      }
    }
  }
}

/** The bytes of a string as it is written in a module. */
function bytesOf(text) {
  const named = { t: '\t', n: '\n', r: '\r' };
  const character = (code) => (code.length === 2 ? String.fromCharCode(parseInt(code, 16)) : (named[code] ?? code));
  return Buffer.from(text.replace(/\\([0-9a-f]{2}|.)/g, (_, code) => character(code)), 'latin1');
}

/** Blanks, in a data segment, the places in the source that panics would tell: address and length of a path, line, column. */
function blankPlaces(segment) {
  const [, start, address, text] = /^(\(data .*\(i32\.const (\d+)\) )"(.*)"\)$/.exec(segment);
  const bytes = bytesOf(text);
  const paths = [];
  for (let at = 0; at + 16 <= bytes.length; at += 4) {
    const from = bytes.readUInt32LE(at) - address;
    const to = from + bytes.readUInt32LE(at + 4);
    if (from < 0 || to > bytes.length || to - from > 1000 || !/^[ -~]+\.rs$/.test(bytes.latin1Slice(from, to))) continue;
    bytes.fill(0, at, at + 16);
    paths.push([from, to]);
  }
  for (const [from, to] of paths) bytes.fill(0, from, to);
  return `${start}"${bytes.toString('hex').replace(/../g, '\\$&')}")`;
}

const lines = readFileSync(0, 'utf8').trimEnd().split('\n');
const rest = [];
const functions = [];
for (let index = 0; index < lines.length; index++) {
  const line = lines[index];
  if (line.startsWith(' (func ')) {
    const end = lines.indexOf(' )', index);
    functions.push(...parse(lines.slice(index, end + 1)));
    index = end;
  } else if (line.startsWith(' (data ')) rest.push(blankPlaces(line.trim()));
  else if (line !== ')') rest.push(line);
}

const panics = new Set(functions.filter(isPanic).map(nameOf));
for (const definition of functions) {
  if (panics.has(nameOf(definition))) definition.inner = [TRAP];
  else shorten(definition.inner, panics, false, new Set());
}

/** Orders by name without its hash and without dropped parts, then by parameters, then by size: similar functions are
 * neighbours, and compress better. */
function compare(one, other) {
  for (const [at, mine] of one.order.entries()) {
    if (mine !== other.order[at]) return mine < other.order[at] ? -1 : 1;
  }
  return 0;
}

const printed = functions.map((definition) => {
  const text = print(definition);
  const name = nameOf(definition);
  const alike = name.replace(/17h[0-9a-f]{16}E|\d+(?=drop_in_place)|(?<=drop_in_place).*/g, '');
  return { text, order: [alike, definition.text.replace(name, ''), text.length] };
});
process.stdout.write([...rest, ...printed.sort(compare).map(({ text }) => text), ')\n'].join('\n'));
