// The base class of both simulators, and the one in 2D.

import { bytes, call, hash, leaveBytes, leavePoints, list, vector, view } from './module.js';
import { Body, Geom, Joint, Spring, assign, finish, poseServoNumbers, rows } from './objects.js';
import { bodyNumbers, explosionNumbers, filterNumbers, geomNumbers, leave, pointNumbers } from './options.js';

const EVENT_TYPES = [
  'touchBegin',
  'touchEnd',
  'jointBroke',
  'springBroke',
  'notFinite',
  'sensorBegin',
  'sensorEnd',
  'hit',
  'bodySlept',
  'bodyWoke',
];
/** Numbers of an event. */
const EVENT_LENGTH = 9;
const registry = new FinalizationRegistry((handle) => call('simulator_free', handle));
/** Number of handles from which on those of disposed objects are removed. */
const FEWEST_TO_SWEEP = 1024;

/** Placement of a geom on its body, and its other settings. */
function placed({ offset = { x: 0, y: 0 }, rotationOffset = 0, collisionGridSize = 0, ...settings }) {
  return [[offset.x, offset.y, rotationOffset, collisionGridSize], settings];
}

export class World {
  #handle;
  #things = new Map();
  #sweepAt = FEWEST_TO_SWEEP;
  #positions = undefined;

  constructor(handle) {
    this.#handle = handle;
    registry.register(this, handle, this);
  }

  /** The number of the simulator in the module. */
  get handle() {
    return this.#handle;
  }

  free() {
    registry.unregister(this);
    call('simulator_free', this.#handle);
    this.#handle = 2 ** 32 - 1;
  }

  /** The one handle of an id, so that handles can be compared and carry data. */
  thing(Class, id) {
    const key = `${Class.kind}${id}`;
    let thing = this.#things.get(key);
    if (thing === undefined) {
      thing = new Class(this, id);
      this.#things.set(key, thing);
    }
    return thing;
  }

  bodyOf(id) {
    return this.thing(this.constructor.Body, id);
  }

  geomOf(id) {
    return this.thing(Geom, id);
  }

  /** The id of an object that must be of this simulator. */
  idOf(thing, Class) {
    if (!(thing instanceof Class)) throw new TypeError(`a ${Class.name} is needed`);
    if (thing.simulator !== this) throw new TypeError(`the ${Class.name} is of another simulator`);
    return thing.id;
  }

  #forgetDisposed() {
    for (const [key, thing] of this.#things) {
      if (thing.isDisposed) {
        this.#things.delete(key);
        thing.forget();
      }
    }
    this.#sweepAt = Math.max(FEWEST_TO_SWEEP, 2 * this.#things.size);
  }

  get gravity() {
    return vector('simulator_gravity', this.#handle);
  }

  set gravity({ x, y }) {
    call('simulator_set_gravity', this.#handle, x, y);
  }

  get iterations() {
    return call('simulator_iterations', this.#handle);
  }

  set iterations(value) {
    call('simulator_set_iterations', this.#handle, value);
  }

  set frictionType(value) {
    if (value !== 'average' && value !== 'minimum') throw new TypeError('frictionType is average or minimum');
    call('simulator_set_minimum_friction', this.#handle, value === 'minimum');
  }

  set isSleepEnabled(value) {
    call('simulator_set_sleep_enabled', this.#handle, value);
  }

  step(dt) {
    call('simulator_step', this.#handle, dt);
    if (this.#things.size > this.#sweepAt) this.#forgetDisposed();
  }

  get positions() {
    const length = call('simulator_positions_length', this.#handle);
    this.#positions = view(this.#positions, call('simulator_positions_pointer', this.#handle), length);
    return this.#positions;
  }

  drainEvents() {
    const numbers = list('simulator_drain_events', this.#handle);
    return rows(numbers, EVENT_LENGTH).map((row) => this.#event(row));
  }

  #event([kind, id, partnerKind, partnerId, x, y, normalX, normalY, speed]) {
    const type = EVENT_TYPES[kind];
    if (kind < 2) return { type, geom: this.geomOf(id), partner: this.partner(partnerKind, partnerId) };
    if (kind === 5 || kind === 6) return { type, sensor: this.geomOf(id), visitor: this.geomOf(partnerId) };
    if (kind === 7) {
      const [point, normal] = [{ x, y }, { x: normalX, y: normalY }];
      return { type, geom: this.geomOf(id), partner: this.geomOf(partnerId), point, normal, speed };
    }
    if (kind === 2) return { type, joint: this.thing(Joint, id) };
    if (kind === 3) return { type, spring: this.thing(Spring, id) };
    return { type, body: this.bodyOf(id) };
  }

  partner(_kind, id) {
    return this.geomOf(id);
  }

  stateHash() {
    return hash('simulator_state_hash', this.#handle);
  }

  snapshot() {
    return bytes('simulator_snapshot', this.#handle);
  }

  restore(snapshot) {
    this.goBack('simulator_restore', snapshot);
  }

  /** Restores bytes by a function of the module. */
  goBack(name, snapshot) {
    leaveBytes(snapshot);
    call(name, this.#handle);
    this.#forgetDisposed();
  }

  #body(name, options, ...values) {
    return finish(this.bodyOf(call(name, this.#handle, ...values)), options);
  }

  createRectangleBody(width, height, mass, options = {}) {
    return this.#body('body_rectangle', options, width, height, mass);
  }

  createCircleBody(radius, mass, options = {}) {
    return this.#body('body_circle', options, radius, mass);
  }

  createCapsuleBody(height, endRadius, mass, options = {}) {
    return this.#body('body_capsule', options, height, endRadius, mass);
  }

  createPolygonBody(vertices, mass, options = {}) {
    leavePoints(vertices);
    return this.#body('body_polygon', options, mass);
  }

  createBody(mass, momentOfInertia, options = {}) {
    return this.#body('body_new', options, mass, momentOfInertia);
  }

  #geom(name, body, placement, settings, ...values) {
    const id = call(name, this.#handle, this.idOf(body, Body), ...values, ...placement);
    return finish(this.geomOf(id), settings);
  }

  createRectangleGeom(body, width, height, options = {}) {
    const [placement, settings] = placed(options);
    return this.#geom('geom_rectangle', body, placement, settings, width, height);
  }

  createCircleGeom(body, radius, { numberOfEdges = 16, ...options } = {}) {
    const [placement, settings] = placed(options);
    return this.#geom('geom_circle', body, placement, settings, radius, numberOfEdges);
  }

  createCapsuleGeom(body, height, endRadius, { edges = 8, ...options } = {}) {
    const [placement, settings] = placed(options);
    return this.#geom('geom_capsule', body, placement, settings, height, endRadius, edges);
  }

  createPolygonGeom(body, vertices, options = {}) {
    const [placement, settings] = placed(options);
    leavePoints(vertices);
    return this.#geom('geom_polygon', body, placement, settings);
  }

  createChainGeom(body, points, options = {}) {
    const [placement, settings] = placed(options);
    leavePoints(points);
    return this.#geom('geom_chain', body, placement, settings);
  }

  #joint(name, options, ...values) {
    return finish(this.thing(Joint, call(name, this.#handle, ...values)), options);
  }

  createRevoluteJoint(body1, body2, anchor, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    return this.#joint('joint_revolute', options, first, second, anchor.x, anchor.y);
  }

  createFixedRevoluteJoint(body, anchor, options = {}) {
    return this.#joint('joint_fixed_revolute', options, this.idOf(body, Body), anchor.x, anchor.y);
  }

  createPinJoint(body1, anchor1, body2, anchor2, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    return this.#joint('joint_pin', options, first, anchor1.x, anchor1.y, second, anchor2.x, anchor2.y);
  }

  createSliderJoint(body1, anchor1, body2, anchor2, min, max, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    const anchors = [first, anchor1.x, anchor1.y, second, anchor2.x, anchor2.y];
    return this.#joint('joint_slider', options, ...anchors, min, max);
  }

  createWeldJoint(body1, body2, anchor, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    return this.#joint('joint_weld', options, first, second, anchor.x, anchor.y);
  }

  createPrismaticJoint(body1, body2, anchor, axis, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    return this.#joint('joint_prismatic', options, first, second, anchor.x, anchor.y, axis.x, axis.y);
  }

  createWheelJoint(body1, body2, anchor, axis, stiffness, damping, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    const place = [anchor.x, anchor.y, axis.x, axis.y];
    return this.#joint('joint_wheel', options, first, second, ...place, stiffness, damping);
  }

  createAngleSpringJoint(body1, body2, stiffness, damping, options = {}) {
    return this.#joint('joint_angle_spring', options, ...this.#pair(body1, body2), stiffness, damping);
  }

  createMotorJoint(body1, body2, servo = {}, options = {}) {
    return this.#joint('joint_motor', options, ...this.#pair(body1, body2), ...poseServoNumbers(servo));
  }

  createAngleJoint(body1, body2, options = {}) {
    return this.#joint('joint_angle', options, ...this.#pair(body1, body2));
  }

  createFixedAngleJoint(body, options = {}) {
    return this.#joint('joint_fixed_angle', options, this.idOf(body, Body));
  }

  createAngleLimitJoint(body1, body2, min, max, options = {}) {
    return this.#joint('joint_angle_limit', options, ...this.#pair(body1, body2), min, max);
  }

  createFixedAngleLimitJoint(body, min, max, options = {}) {
    return this.#joint('joint_fixed_angle_limit', options, this.idOf(body, Body), min, max);
  }

  #pair(body1, body2) {
    return [this.idOf(body1, Body), this.idOf(body2, Body)];
  }

  #spring(name, options, ...values) {
    return finish(this.thing(Spring, call(name, this.#handle, ...values)), options);
  }

  createLinearSpring(body1, point1, body2, point2, springConstant, dampingConstant, options = {}) {
    const [first, second] = this.#pair(body1, body2);
    const ends = [first, point1.x, point1.y, second, point2.x, point2.y];
    return this.#spring('spring_linear', options, ...ends, springConstant, dampingConstant);
  }

  createFixedLinearSpring(body, bodyPoint, worldPoint, springConstant, dampingConstant, options = {}) {
    const ends = [this.idOf(body, Body), bodyPoint.x, bodyPoint.y, worldPoint.x, worldPoint.y];
    return this.#spring('spring_fixed_linear', options, ...ends, springConstant, dampingConstant);
  }

  createAngleSpring(body1, body2, springConstant, dampingConstant, options = {}) {
    return this.#spring('spring_angle', options, ...this.#pair(body1, body2), springConstant, dampingConstant);
  }

  createFixedAngleSpring(body, springConstant, dampingConstant, options = {}) {
    return this.#spring('spring_fixed_angle', options, this.idOf(body, Body), springConstant, dampingConstant);
  }

  collideAll(point) {
    return list('query_collide_all', this.#handle, point.x, point.y).map((id) => this.geomOf(id));
  }
}

Body.kind = 'body';
Geom.kind = 'geom';
Joint.kind = 'joint';
Spring.kind = 'spring';
World.Body = Body;

/** Hits of geoms that a filter accepts. */
function accepted(hits, { accepts }) {
  return accepts ? hits.filter(({ geom }) => accepts(geom)) : hits;
}

/** All 31 categories. */
const ALL_CATEGORIES = 0x7fffffff;

export class Simulator extends World {
  constructor({
    gravity = { x: 0, y: 0 },
    methods = 'precise',
    lengthUnit = 32,
    narrowPhase = 'distanceGrid',
    ...settings
  } = {}) {
    super(call('simulator_new', gravity.x, gravity.y));
    if (methods === 'precise') {
      call('simulator_set_precise', this.handle, lengthUnit);
    } else if (methods === 'faithful' && (narrowPhase === 'distanceGrid' || narrowPhase === 'sat')) {
      call('simulator_set_faithful', this.handle, narrowPhase === 'sat');
    } else {
      throw new TypeError('methods are precise, or faithful with the narrowPhase distanceGrid or sat');
    }
    assign(this, settings);
  }

  addBody(options = {}, geoms = []) {
    leave([...bodyNumbers(options), geoms.length, ...geoms.flatMap(geomNumbers)]);
    const [bodyId, ...geomIds] = list('add_body', this.handle);
    const body = this.bodyOf(bodyId);
    body.userData = options.userData;
    const made = geomIds.map((id, at) => {
      const geom = this.geomOf(id);
      geom.userData = geoms[at].userData;
      return geom;
    });
    return { body, geoms: made };
  }

  addGeom(body, options) {
    leave(geomNumbers(options));
    const geom = this.geomOf(call('add_geom', this.handle, this.idOf(body, Body)));
    geom.userData = options.userData;
    return geom;
  }

  set largestSpeed(speed) {
    if (speed === null) call('simulator_remove_largest_speed', this.handle);
    else call('simulator_set_largest_speed', this.handle, speed);
  }

  set hitSpeed(speed) {
    call('simulator_set_hit_speed', this.handle, speed);
  }

  explode(explosion) {
    leave(explosionNumbers(this, explosion));
    return call('simulator_explode', this.handle);
  }

  applyRadialForce(explosion) {
    leave(explosionNumbers(this, explosion));
    return call('simulator_apply_radial_force', this.handle);
  }

  snapshotMoving() {
    return bytes('simulator_snapshot_moving', this.handle);
  }

  restoreMoving(moving) {
    this.goBack('simulator_restore_moving', moving);
  }

  #hits(name, mode) {
    return rows(list(name, this.handle, mode), 6).map(([id, x, y, normalX, normalY, fraction]) => ({
      geom: this.geomOf(id),
      point: { x, y },
      normal: { x: normalX, y: normalY },
      fraction,
    }));
  }

  castRay(start, end, filter = {}) {
    if (filter.accepts) return this.castRayAll(start, end, filter)[0] ?? null;
    leave([...pointNumbers(start), ...pointNumbers(end), ...filterNumbers(this, filter)]);
    return this.#hits('query_cast_ray', 0)[0] ?? null;
  }

  castRayAll(start, end, filter = {}) {
    leave([...pointNumbers(start), ...pointNumbers(end), ...filterNumbers(this, filter)]);
    return accepted(this.#hits('query_cast_ray', 1), filter);
  }

  castRayAny(start, end, filter = {}) {
    if (filter.accepts) return this.castRay(start, end, filter);
    leave([...pointNumbers(start), ...pointNumbers(end), ...filterNumbers(this, filter)]);
    return this.#hits('query_cast_ray', 2)[0] ?? null;
  }

  #leaveCast(shape, position, rotation, motion, filter) {
    const place = [...pointNumbers(position), rotation, ...pointNumbers(motion)];
    leave([...place, ...filterNumbers(this, filter), ...geomNumbers(shape)]);
  }

  castShape(shape, position, rotation, motion, filter = {}) {
    if (filter.accepts) return this.castShapeAll(shape, position, rotation, motion, filter)[0] ?? null;
    this.#leaveCast(shape, position, rotation, motion, filter);
    return this.#hits('query_cast_shape', 0)[0] ?? null;
  }

  castShapeAll(shape, position, rotation, motion, filter = {}) {
    this.#leaveCast(shape, position, rotation, motion, filter);
    return accepted(this.#hits('query_cast_shape', 1), filter);
  }

  #overlaps(shape, position, rotation, filter, mode) {
    leave([...pointNumbers(position), rotation, ...filterNumbers(this, filter), ...geomNumbers(shape)]);
    return list('query_overlap_shape', this.handle, mode).map((id) => this.geomOf(id));
  }

  overlapShape(shape, position, rotation = 0, filter = {}) {
    const geoms = this.#overlaps(shape, position, rotation, filter, 0);
    return filter.accepts ? geoms.filter(filter.accepts) : geoms;
  }

  overlapAny(shape, position, rotation = 0, filter = {}) {
    if (filter.accepts) return this.overlapShape(shape, position, rotation, filter)[0] ?? null;
    return this.#overlaps(shape, position, rotation, filter, 1)[0] ?? null;
  }

  geomsAt(point, filter = {}) {
    leave([...pointNumbers(point), ...filterNumbers(this, filter)]);
    const geoms = list('query_geoms_at', this.handle).map((id) => this.geomOf(id));
    return filter.accepts ? geoms.filter(filter.accepts) : geoms;
  }

  nearestPoint(point, maxDistance, filter = {}) {
    if (filter.accepts) throw new TypeError('nearestPoint has no accepts');
    leave([...pointNumbers(point), maxDistance, ...filterNumbers(this, filter)]);
    const [id, x, y, normalX, normalY, distance] = list('query_nearest_point', this.handle);
    if (id === undefined) return null;
    return { geom: this.geomOf(id), point: { x, y }, normal: { x: normalX, y: normalY }, distance };
  }

  rayCast(start, end, { categories = ALL_CATEGORIES } = {}) {
    const ray = [start.x, start.y, end.x, end.y];
    const [id, x, y, normalX, normalY, fraction] = list('query_ray_cast', this.handle, ...ray, categories);
    if (id === undefined) return null;
    return { geom: this.geomOf(id), point: { x, y }, normal: { x: normalX, y: normalY }, fraction };
  }

  queryAabb(min, max) {
    return list('query_aabb', this.handle, min.x, min.y, max.x, max.y).map((id) => this.geomOf(id));
  }
}
