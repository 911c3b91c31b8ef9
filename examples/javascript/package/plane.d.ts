/**
 * The 2D engine alone, in a smaller module: everything here is as in `twohalf`, but for the module that `initialize` loads. A
 * program uses one of the two.
 */
export {
  Body,
  CharacterMover,
  FixedStepRunner,
  Geom,
  Joint,
  PhysicsError,
  Recording,
  Simulator,
  Spring,
  initialize,
  type AddBodyOptions,
  type AddGeomOptions,
  type BodyContact,
  type Event,
  type Explosion,
  type MoverInput,
  type MoverOptions,
  type MoverReport,
  type NearestPoint,
  type QueryFilter,
  type RayCastHit,
  type Shape,
} from './index.js';
