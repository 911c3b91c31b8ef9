// The 2D engine alone: a smaller module.

import { load } from './module.js';

export { PhysicsError } from './module.js';
export { CharacterMover } from './mover.js';
export { Body, Geom, Joint, Spring } from './objects.js';
export { Recording } from './recording.js';
export { FixedStepRunner } from './runner.js';
export { Simulator } from './simulator.js';

export function initialize(source = new URL('./plane.wasm', import.meta.url)) {
  return load(source);
}
