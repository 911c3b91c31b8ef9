// The simulator in 2.5D.

import { call, list, vector, vector3 } from './module.js';
import { Body, Geom, Thing, assign, finish, points } from './objects.js';
import { World } from './simulator.js';

const WALK_SETTINGS = [
  'acceleration',
  'airAcceleration',
  'jumpHeight',
  'stepUp',
  'snap',
  'maxSlope',
  'coyoteTime',
  'ledgeReach',
  'climbSpeed',
];

export class DepthBody extends Body {
  get position3d() {
    return vector3('depth_position3d', this.simulator.handle, this.id);
  }

  set position3d({ x, y, z }) {
    this.call('depth_set_position3d', x, y, z);
  }

  get velocity3d() {
    return vector3('depth_velocity3d', this.simulator.handle, this.id);
  }

  set velocity3d({ x, y, z }) {
    this.call('depth_set_velocity3d', x, y, z);
  }

  get screenPosition() {
    return this.vector('depth_screen_position');
  }

  get isGrounded() {
    return this.call('depth_is_grounded') === 1;
  }

  /** Height of the surface beneath it, or null. */
  get heightBeneath() {
    return list('depth_height_beneath', this.simulator.handle, this.id)[0] ?? null;
  }

  get walkSettings() {
    const numbers = list('depth_walk_settings', this.simulator.handle, this.id);
    return Object.fromEntries(WALK_SETTINGS.map((name, at) => [name, numbers[at]]));
  }

  set walkSettings(settings) {
    const all = { ...this.walkSettings, ...settings };
    this.call('depth_set_walk', ...WALK_SETTINGS.map((name) => all[name]));
  }

  applyForce3d({ x, y, z }) {
    this.call('depth_apply_force3d', x, y, z);
  }

  applyImpulse3d({ x, y, z }) {
    this.call('depth_apply_impulse3d', x, y, z);
  }

  moveTo3d({ x, y, z }) {
    this.call('depth_move_to3d', x, y, z);
  }

  setGround({ frictionCoefficient = 0, restitutionCoefficient = 0 }) {
    this.call('depth_set_ground', frictionCoefficient, restitutionCoefficient);
  }

  setObjectGeom(geom) {
    this.call('depth_set_object_geom', this.simulator.idOf(geom, Geom));
  }

  letGo() {
    this.call('depth_let_go');
  }
}

export class Platform extends Thing {
  static kind = 'platform';

  get isDisposed() {
    return this.id < 0 || this.call('platform_is_removed') === 1;
  }

  get position3d() {
    return vector3('platform_position3d', this.simulator.handle, this.id);
  }

  set position3d({ x, y, z }) {
    this.call('platform_set_position3d', x, y, z);
  }

  get screenCorners() {
    return points(list('platform_screen_corners', this.simulator.handle, this.id));
  }

  set velocity({ x, y, z }) {
    this.call('platform_set_velocity', x, y, z);
  }

  set surfaceSpeed({ along, depth }) {
    this.call('platform_set_surface_speed', along, depth);
  }

  set isOneWay(value) {
    this.call('platform_set_one_way', value);
  }

  setSurface({ frictionCoefficient = 0, restitutionCoefficient = 0 }) {
    this.call('platform_set_surface', frictionCoefficient, restitutionCoefficient);
  }

  moveTo({ x, y, z }) {
    this.call('platform_move_to', x, y, z);
  }

  dispose() {
    this.call('platform_remove');
  }
}

export class DepthSimulator extends World {
  static Body = DepthBody;

  constructor({ height, angle = 90, gravity = { x: 0, y: 0 }, methods = 'precise', ...settings } = {}) {
    super(call('depth_new', height, angle, gravity.x, gravity.y));
    if (methods === 'faithful') {
      call('depth_set_faithful', this.handle);
    } else if (methods !== 'precise') {
      throw new TypeError('methods are precise or faithful');
    }
    assign(this, settings);
  }

  partner(kind, id) {
    if (kind === 2) return 'ground';
    return kind === 1 ? this.thing(Platform, id) : this.geomOf(id);
  }

  #spawned(name, ...values) {
    const [body, geom] = list(name, this.handle, ...values);
    return { body: this.bodyOf(body), geom: this.geomOf(geom) };
  }

  spawnPrism(size, options = {}) {
    const { mass = 1, frictionCoefficient = 0.4, restitutionCoefficient = 0, isUpright = false } = options;
    const { x, y, z } = options.position3d ?? { x: 0, y: 0, z: 0 };
    const surface = [mass, frictionCoefficient, restitutionCoefficient, isUpright];
    return this.#spawned('depth_spawn_prism', size.width, size.height, size.depth, ...surface, x, y, z);
  }

  spawnBall(radius, options = {}) {
    const { mass = 1, frictionCoefficient = 0.4, restitutionCoefficient = 0 } = options;
    const { x, y, z } = options.position3d ?? { x: 0, y: 0, z: 0 };
    return this.#spawned('depth_spawn_ball', radius, mass, frictionCoefficient, restitutionCoefficient, x, y, z);
  }

  spawnFigure(size, { mass = 70, position3d: { x, y, z } = { x: 0, y: 0, z: 0 }, walk = {} } = {}) {
    const spawned = this.#spawned('depth_spawn_figure', size.width, size.height, size.depth, mass, x, y, z);
    finish(spawned.body, { walkSettings: walk });
    return spawned;
  }

  spawnLane({ left, right, front, back, height }) {
    const walls = list('depth_spawn_lane', this.handle, left, right, front, back, height);
    return walls.map((id) => this.thing(Platform, id));
  }

  createPlatform({ width, height, depth }, { x, y, z }, { rotation = 0, ...settings } = {}) {
    const id = call('platform_new', this.handle, width, height, depth, x, y, z, rotation);
    return finish(this.thing(Platform, id), settings);
  }

  setPrism(geom, depth) {
    call('depth_set_prism', this.handle, this.idOf(geom, Geom), depth);
  }

  setRound(geom, radius) {
    call('depth_set_round', this.handle, this.idOf(geom, Geom), radius);
  }

  walk(body, { x = 0, z = 0, jump = false }, dt) {
    return call('depth_walk', this.handle, this.idOf(body, DepthBody), x, z, jump, dt) === 1;
  }

  toScreen({ x, y, z }) {
    return vector('depth_to_screen', this.handle, x, y, z);
  }

  screenToGround({ x, y }) {
    return vector3('depth_screen_to_ground', this.handle, x, y);
  }

  #drawable(kind, id) {
    return kind === 1 ? this.thing(Platform, id) : this.bodyOf(id);
  }

  drawOrder() {
    const numbers = list('depth_draw_order', this.handle);
    const count = numbers.length / 2;
    return Array.from({ length: count }, (_, at) => this.#drawable(numbers[2 * at], numbers[2 * at + 1]));
  }

  pickFront({ x, y }) {
    const [kind, id] = list('depth_pick_front', this.handle, x, y);
    return kind === undefined ? null : this.#drawable(kind, id);
  }

  rayCast3d(start, end) {
    const ray = [start.x, start.y, start.z, end.x, end.y, end.z];
    const numbers = list('depth_ray_cast3d', this.handle, ...ray);
    if (numbers.length === 0) return null;
    const [kind, id, x, y, z, normalX, normalY, normalZ, fraction] = numbers;
    const [point, normal] = [{ x, y, z }, { x: normalX, y: normalY, z: normalZ }];
    return { partner: this.partner(kind, id), point, normal, fraction };
  }
}
