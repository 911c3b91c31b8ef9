// Bodies, geoms, joints and springs: handles of objects in a simulator.

import { call, list, vector } from './module.js';

/** Slots and generations share a number; see `id_number.rs`. */
const SLOTS = 2 ** 24;

/** The greatest number of 32 bits: no bound. */
const MAX = 3.4028234663852886e38;

/** Everything that a simulator has under an id. */
export class Thing {
  #simulator;
  #id;
  userData = undefined;

  constructor(simulator, id) {
    this.#simulator = simulator;
    this.#id = id;
  }

  get simulator() {
    return this.#simulator;
  }

  get id() {
    return this.#id;
  }

  /** Makes it stale: its object is not in the restored simulator. */
  forget() {
    this.#id = -1;
  }

  call(name, ...values) {
    return call(name, this.#simulator.handle, this.#id, ...values);
  }

  vector(name, ...values) {
    return vector(name, this.#simulator.handle, this.#id, ...values);
  }
}

/** Adds properties that are numbers or, with `is`, true or false: `name` by `${kind}_name` and `${kind}_set_name`. */
function define(Class, kind, names) {
  for (const property of names) {
    const name = property.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
    const isFlag = property.startsWith('is') || property.endsWith('nabled');
    Object.defineProperty(Class.prototype, property, {
      get() {
        const value = this.call(`${kind}_${name}`);
        return isFlag ? value === 1 : value;
      },
      set(value) {
        this.call(`${kind}_set_${name}`, value);
      },
    });
  }
}

/** Sets the given options; an unknown name throws. */
export function assign(thing, options) {
  for (const [name, value] of Object.entries(options)) {
    if (value === undefined) continue;
    if (!(name in thing)) throw new TypeError(`${thing.constructor.name} has no ${name}`);
    thing[name] = value;
  }
  return thing;
}

/** The same for a new object, which is disposed if they are refused. */
export function finish(thing, options) {
  try {
    return assign(thing, options);
  } catch (error) {
    thing.dispose();
    throw error;
  }
}

export class Body extends Thing {
  get slot() {
    return this.id % SLOTS;
  }

  get isDisposed() {
    return this.id < 0 || this.call('body_is_disposed') === 1;
  }

  get isAsleep() {
    return this.call('body_is_asleep') === 1;
  }

  get position() {
    return this.vector('body_position');
  }

  set position({ x, y }) {
    this.call('body_set_position', x, y);
  }

  get totalRotation() {
    return this.call('body_total_rotation');
  }

  get linearVelocity() {
    return this.vector('body_linear_velocity');
  }

  set linearVelocity({ x, y }) {
    this.call('body_set_linear_velocity', x, y);
  }

  moveTo({ x, y }, rotation) {
    this.call('body_move_to', x, y, rotation);
  }

  applyForce({ x, y }) {
    this.call('body_apply_force', x, y);
  }

  applyForceAtWorldPoint({ x, y }, point) {
    this.call('body_apply_force_at_world_point', x, y, point.x, point.y);
  }

  applyTorque(torque) {
    this.call('body_apply_torque', torque);
  }

  applyImpulse({ x, y }) {
    this.call('body_apply_impulse', x, y);
  }

  applyAngularImpulse(amount) {
    this.call('body_apply_angular_impulse', amount);
  }

  wake() {
    this.call('body_wake');
  }

  sleep() {
    this.call('body_sleep');
  }

  set density(density) {
    this.call('body_set_density', density);
  }

  /** The points at which it touched others in the last step. */
  contacts() {
    const { simulator } = this;
    const numbers = list('body_contacts', simulator.handle, this.id);
    return rows(numbers, 8).map(([geom, other, x, y, normalX, normalY, separation, normalImpulse]) => ({
      geom: simulator.geomOf(geom),
      other: simulator.geomOf(other),
      point: { x, y },
      normal: { x: normalX, y: normalY },
      separation,
      normalImpulse,
    }));
  }

  getLocalPosition({ x, y }) {
    return this.vector('body_local_position', x, y);
  }

  getWorldPosition({ x, y }) {
    return this.vector('body_world_position', x, y);
  }

  dispose() {
    this.call('body_dispose');
  }
}

define(Body, 'body', [
  'rotation',
  'angularVelocity',
  'mass',
  'momentOfInertia',
  'isStatic',
  'isKinematic',
  'isBullet',
  'enabled',
  'gravityScale',
  'linearDragCoefficient',
  'rotationalDragCoefficient',
]);

export class Geom extends Thing {
  get body() {
    return this.simulator.bodyOf(this.call('geom_body'));
  }

  get isDisposed() {
    return this.id < 0 || this.call('geom_is_disposed') === 1;
  }

  get worldVertices() {
    const numbers = list('geom_world_vertices', this.simulator.handle, this.id);
    return points(numbers);
  }

  /** The geoms that it touched in the last step. */
  overlaps() {
    const ids = list('query_overlaps', this.simulator.handle, this.id);
    return ids.map((id) => this.simulator.geomOf(id));
  }

  set sensor(value) {
    this.call('geom_set_sensor', value);
  }

  ignoreCollisionWith(other) {
    this.call('geom_ignore_collision_with', this.simulator.idOf(other, Geom));
  }

  restoreCollisionWith(other) {
    this.call('geom_restore_collision_with', this.simulator.idOf(other, Geom));
  }

  dispose() {
    this.call('geom_dispose');
  }
}

define(Geom, 'geom', [
  'frictionCoefficient',
  'restitutionCoefficient',
  'collisionCategories',
  'collidesWith',
  'collisionGroup',
  'collisionEnabled',
  'isSensor',
]);

/** Numbers in rows of a length. */
export function rows(numbers, length) {
  return Array.from({ length: numbers.length / length }, (_, at) => numbers.slice(length * at, length * (at + 1)));
}

/** The strength of a motor joint as numbers, with the defaults of the engine. */
export function poseServoNumbers({ frequency = 4, dampingRatio = 1, greatestForce = MAX, greatestTorque = MAX }) {
  return [frequency, dampingRatio, greatestForce, greatestTorque];
}

/** Pairs of numbers as points. */
export function points(numbers) {
  return Array.from({ length: numbers.length / 2 }, (_, at) => ({ x: numbers[2 * at], y: numbers[2 * at + 1] }));
}

/** Adds properties that can only be set. */
function defineSetters(Class, kind, names) {
  for (const property of names) {
    const name = property.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
    Object.defineProperty(Class.prototype, property, {
      set(value) {
        this.call(`${kind}_set_${name}`, value);
      },
    });
  }
}

export class Joint extends Thing {
  get isDisposed() {
    return this.id < 0 || this.call('joint_is_disposed') === 1;
  }

  set motor(motor) {
    if (motor === null) this.call('joint_remove_motor');
    else this.call('joint_set_motor', motor.speed, motor.greatestEffort);
  }

  set limits(limits) {
    if (limits === null) this.call('joint_remove_limits');
    else this.call('joint_set_limits', limits.lower, limits.upper);
  }

  set servo(servo) {
    if (servo === null) {
      this.call('joint_remove_servo');
    } else {
      const { target, stiffness, damping, greatestEffort = MAX } = servo;
      this.call('joint_set_servo', target, stiffness, damping, greatestEffort);
    }
  }

  set poseServo(servo) {
    this.call('joint_set_pose_servo', ...poseServoNumbers(servo));
  }

  set targetPose({ offset, angle }) {
    this.call('joint_set_target_pose', offset.x, offset.y, angle);
  }

  get travel() {
    return this.call('joint_travel');
  }

  get force() {
    return this.vector('joint_force');
  }

  get torque() {
    return this.call('joint_torque');
  }

  dispose() {
    this.call('joint_dispose');
  }
}

define(Joint, 'joint', ['enabled']);
defineSetters(Joint, 'joint', [
  'bodiesCollide',
  'breakpoint',
  'greatestForce',
  'greatestTorque',
  'softness',
  'biasFactor',
  'targetAngle',
]);

export class Spring extends Thing {
  get isDisposed() {
    return this.id < 0 || this.call('spring_is_disposed') === 1;
  }

  set worldAttachPoint({ x, y }) {
    this.call('spring_set_world_attach_point', x, y);
  }

  dispose() {
    this.call('spring_dispose');
  }
}

define(Spring, 'spring', ['enabled']);
defineSetters(Spring, 'spring', ['breakpoint', 'springConstant', 'dampingConstant']);
