import { load } from './module.js';

export { DepthBody, DepthSimulator, Platform } from './depth.js';
export { PhysicsError } from './module.js';
export { CharacterMover } from './mover.js';
export { Body, Geom, Joint, Spring } from './objects.js';
export { Recording } from './recording.js';
export { FixedStepRunner } from './runner.js';
export { Simulator } from './simulator.js';

export function initialize(source = new URL('./twohalf.wasm', import.meta.url)) {
  return load(source);
}
