/**
 * The 2D engine alone, in a smaller module: everything here is as in `twohalf`, but for the module that `initialize` loads. A
 * program uses one of the two.
 */
export {
  Body,
  Geom,
  Joint,
  PhysicsError,
  Simulator,
  Spring,
  initialize,
  type Event,
} from './index.js';
