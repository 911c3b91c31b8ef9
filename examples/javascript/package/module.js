// The WebAssembly module: loading, calls, and exchange of data through its memory.

/** A call that the engine refused, in its words. */
export class PhysicsError extends Error {
  name = 'PhysicsError';
}

let functions = null;
let buffer = null;
let numbers = null;
let loading = null;

async function instantiate(source) {
  if (source instanceof WebAssembly.Module) return WebAssembly.instantiate(source);
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) {
    return (await WebAssembly.instantiate(source)).instance;
  }
  const url = source instanceof Response ? null : new URL(source, import.meta.url);
  if (url?.protocol === 'file:' && typeof process === 'object') {
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ 'node:fs/promises');
    return (await WebAssembly.instantiate(await readFile(url))).instance;
  }
  const response = url ? await fetch(url) : source;
  if (!response.ok) throw new PhysicsError(`${response.url} could not be loaded: ${response.status}`);
  return (await WebAssembly.instantiate(await response.arrayBuffer())).instance;
}

export async function load(source) {
  loading ??= instantiate(source).then(
    (instance) => {
      functions = instance.exports;
    },
    (error) => {
      loading = null;
      throw error;
    },
  );
  await loading;
}

/** Calls a function of the module; throws if it refuses. */
export function call(name, ...values) {
  if (functions === null) throw new PhysicsError('await initialize() first');
  if (functions[name] === undefined) throw new PhysicsError('a module of 2D alone was loaded: initialize that of twohalf');
  const answer = functions[name](...values);
  // Only a refusal returns NaN.
  if (answer !== answer) throw new PhysicsError(text());
  return answer;
}

function text() {
  const bytes = new Uint8Array(functions.memory.buffer, functions.text_pointer(), functions.text_length());
  return new TextDecoder().decode(bytes);
}

/** Memory moves to another buffer when it grows. */
export function memory() {
  if (buffer !== functions.memory.buffer) {
    buffer = functions.memory.buffer;
    numbers = new Float64Array(buffer);
  }
  return numbers;
}

/** The numbers that a function leaves behind. */
export function list(name, ...values) {
  const count = call(name, ...values);
  const start = functions.numbers_pointer() / 8;
  return Array.from(memory().subarray(start, start + count));
}

export function vector(name, ...values) {
  call(name, ...values);
  const start = functions.numbers_pointer() / 8;
  const at = memory();
  return { x: at[start], y: at[start + 1] };
}

export function vector3(name, ...values) {
  call(name, ...values);
  const start = functions.numbers_pointer() / 8;
  const at = memory();
  return { x: at[start], y: at[start + 1], z: at[start + 2] };
}

/** The 64 bits that a function leaves behind in two halves, the upper one first. */
export function hash(name, ...values) {
  const [upper, lower] = list(name, ...values);
  return (BigInt(upper) << 32n) | BigInt(lower);
}

/** Leaves points for the next function. */
export function leavePoints(points) {
  const start = call('reserve_numbers', 2 * points.length) / 8;
  const at = memory();
  points.forEach((point, index) => {
    at[start + 2 * index] = point.x;
    at[start + 2 * index + 1] = point.y;
  });
}

/** A copy of the bytes that a function leaves behind. */
export function bytes(name, ...values) {
  const count = call(name, ...values);
  return new Uint8Array(functions.memory.buffer, functions.bytes_pointer(), count).slice();
}

/** Leaves bytes for the next function. */
export function leaveBytes(value) {
  if (!(value instanceof Uint8Array)) throw new TypeError('a Uint8Array is needed');
  const start = call('reserve_bytes', value.length);
  new Uint8Array(functions.memory.buffer, start, value.length).set(value);
}

/** A view of 32-bit floats in memory; `old` if it is the same. */
export function view(old, pointer, length) {
  const now = functions.memory.buffer;
  if (old?.buffer === now && old.byteOffset === pointer && old.length === length) return old;
  return new Float32Array(now, pointer, length);
}
