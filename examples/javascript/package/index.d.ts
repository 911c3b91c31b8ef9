/**
 * 2D and 2.5D game physics. Lengths in px or m, times in s, angles in rad, masses in kg, as you choose consistently. In the
 * plane y points down, as on the screen; in the world of 2.5D, `position3d` and the like, y is the height.
 */

/** A point or direction. */
export interface Vector2 {
  x: number;
  y: number;
}

/** A point or direction in the world: x along the picture, y up, z into it. */
export interface Vector3 {
  x: number;
  y: number;
  z: number;
}

/** A call that the engine refused, with its message. A refused call has no effect. */
export class PhysicsError extends Error {}

/**
 * Loads the module; await it once before any other call. Later calls wait for the first one.
 * @param source its address, if it is not beside this file; or its content.
 * @throws if it cannot be loaded; the call may be repeated.
 */
export function initialize(
  source?: string | URL | Response | BufferSource | WebAssembly.Module,
): Promise<void>;

/** An object of a simulator. Each has exactly one handle: handles can be compared. */
interface Thing {
  /** Data of the game; not part of snapshots. */
  userData: unknown;
  /** Whether it was disposed. It is removed in the next step; from then on every other call is refused. */
  readonly isDisposed: boolean;
}

/** Options of a new body. */
export interface BodyOptions {
  position?: Vector2;
  /** Clockwise on the screen, rad. */
  rotation?: number;
  linearVelocity?: Vector2;
  /** rad/s. */
  angularVelocity?: number;
  /** Finite and greater than 0. */
  mass?: number;
  /** Finite and greater than 0. */
  momentOfInertia?: number;
  /** A static body never moves. Default false. */
  isStatic?: boolean;
  /** A kinematic body moves with its velocity, or to its target; no force or contact changes its motion. Default false. */
  isKinematic?: boolean;
  /** Precise set: no body tunnels through static ones; a bullet does not tunnel through dynamic ones, either. Default false. */
  isBullet?: boolean;
  /** A disabled body neither moves nor collides. Default true. */
  enabled?: boolean;
  /** Factor of gravity. Default 1. */
  gravityScale?: number;
  /** Drag force per speed. Default 0.001. */
  linearDragCoefficient?: number;
  /** Drag torque per squared angular velocity. Default 0.001. */
  rotationalDragCoefficient?: number;
}

/** A rigid body: mass, position and velocity; geoms give it a shape. */
export class Body implements Thing, Required<BodyOptions> {
  protected constructor();
  userData: unknown;
  /** Its row in {@link Simulator.positions}: small, and used again after disposal. */
  readonly slot: number;
  readonly isDisposed: boolean;
  /** Whether its island sleeps; precise set. */
  readonly isAsleep: boolean;
  /** Rotation with all full turns, rad. */
  readonly totalRotation: number;
  position: Vector2;
  rotation: number;
  linearVelocity: Vector2;
  angularVelocity: number;
  mass: number;
  momentOfInertia: number;
  isStatic: boolean;
  isKinematic: boolean;
  isBullet: boolean;
  enabled: boolean;
  gravityScale: number;
  linearDragCoefficient: number;
  rotationalDragCoefficient: number;
  /** Moves a kinematic body to a position and rotation in the next step; it pushes and carries bodies that it touches. */
  moveTo(position: Vector2, rotation: number): void;
  /** Acts in the next step alone. */
  applyForce(amount: Vector2): void;
  /** Acts in the next step alone, with a torque unless its line contains the centre of mass. */
  applyForceAtWorldPoint(amount: Vector2, point: Vector2): void;
  applyTorque(torque: number): void;
  /** Mass times velocity. */
  applyImpulse(amount: Vector2): void;
  applyAngularImpulse(amount: number): void;
  wake(): void;
  /** Puts it to sleep in the next step, with its island; precise set. */
  sleep(): void;
  /** Sets mass and moment of inertia from its geoms: mass per square of the unit of length. */
  set density(value: number);
  /** The points at which it touched others in the last step, without sensors; precise set. {@link Simulator} only. */
  contacts(): BodyContact[];
  /** Converts a point from the world to the frame of the body. */
  getLocalPosition(worldPosition: Vector2): Vector2;
  /** Converts a point from the frame of the body to the world. */
  getWorldPosition(localPosition: Vector2): Vector2;
  /** Removes it, with its geoms, in the next step. */
  dispose(): void;
}

/** A shape; its offset and rotation offset belong to the geom or query. */
export type Shape =
  | { rectangle: { width: number; height: number } }
  | { circle: { radius: number } }
  /** Upright: `height` from tip to tip, `endRadius` less than half of it. */
  | { capsule: { height: number; endRadius: number } }
  /** Any simple outline, in the frame of its body. */
  | { polygon: readonly Vector2[] }
  /** Edges as terrain on a static body: points from left to right make a floor. Closed if the last is the first. */
  | { chain: readonly Vector2[] };

/** Options of {@link Simulator.addBody}; the same names as those of the Rust crate's `BodyBuilder`. */
export interface AddBodyOptions {
  /** Default `dynamic`. A fixed body is static. */
  type?: 'dynamic' | 'kinematic' | 'fixed';
  position?: Vector2;
  /** Clockwise on the screen, rad. */
  rotation?: number;
  linearVelocity?: Vector2;
  /** rad/s. */
  angularVelocity?: number;
  /** Decay of the velocity per second, >= 0. Default 0. */
  linearDamping?: number;
  /** Decay of the angular velocity per second, >= 0. Default 0. */
  angularDamping?: number;
  /** Factor of gravity. Default 1. */
  gravityScale?: number;
  /** Default: from the geoms. */
  mass?: number;
  /** Default: from the geoms. */
  momentOfInertia?: number;
  /** Default false. */
  lockRotation?: boolean;
  /** Whether it does not tunnel through dynamic bodies, either. Default false. */
  bullet?: boolean;
  /** Default true. */
  sleepAllowed?: boolean;
  /** Default false. */
  startsAsleep?: boolean;
  /** Whether falling asleep and waking are events. Default true. */
  sleepEvents?: boolean;
  /** Default true. */
  enabled?: boolean;
  /** Data of the game. */
  userData?: unknown;
}

/** Settings of a geom in {@link AddGeomOptions}; the same names as those of the Rust crate's `GeomBuilder`. */
export interface GeomSettings {
  /** Position on the body, in its frame. Default its origin. */
  offset?: Vector2;
  /** Rotation relative to the body, rad. Default 0. */
  rotationOffset?: number;
  /** Mass per square of the unit of length. Default: a square with sides of one length unit has mass 1. */
  density?: number;
  mass?: number;
  /** Friction coefficient, >= 0. Default 0.6. */
  friction?: number;
  /** Coefficient of restitution. Default 0. */
  restitution?: number;
  /** The categories that it belongs to as bits, 31 of them: `1 << 3`. Default all. */
  categories?: number;
  /** The categories that it collides with. Two collide if both masks have a category of the other. Default all. */
  collidesWith?: number;
  /** Geoms of the same group do not collide; 0 is no group. Default 0. */
  group?: number;
  /** A sensor has events and exerts no impulse, on bodies of all types. Default false. */
  sensor?: boolean;
  /** The events that it wants. Default touches and sensors. */
  events?: ('touch' | 'sensor' | 'hit')[];
  /** Direction in the frame of the body out of the only solid side: other shapes pass from all other sides. */
  oneWay?: Vector2;
  /** Data of the game. */
  userData?: unknown;
}

/** Shape and settings of a geom. */
export type AddGeomOptions = Shape & GeomSettings;

/** A point at which a body touches another. */
export interface BodyContact {
  /** The geom of the body. */
  geom: Geom;
  other: Geom;
  point: Vector2;
  /** Unit vector from the other geom to that of the body: up for a body that stands on it. */
  normal: Vector2;
  /** Distance along the normal, negative for penetration. */
  separation: number;
  /** Impulse along the normal in the last step or its last substep. */
  normalImpulse: number;
}

/** The geoms that a query finds. */
export interface QueryFilter {
  /** Geoms of at least one of these categories. Default all. */
  categories?: number;
  /** Categories of the query itself: geoms that collide with none of them are not found. Default all. */
  asCategories?: number;
  /** Whether geoms of static bodies are found. Default true. */
  fixed?: boolean;
  /** Default true. */
  kinematic?: boolean;
  /** Default true. */
  dynamic?: boolean;
  /** Default false. */
  sensors?: boolean;
  excludeBody?: Body;
  excludeGeom?: Geom;
  /** A further test. Not for `nearestPoint`, explosions and radial forces. */
  accepts?: (geom: Geom) => boolean;
}

/** The nearest point of a geom. */
export interface NearestPoint {
  geom: Geom;
  /** The given point if that is inside. */
  point: Vector2;
  /** Unit vector from the geom to the given point; zero if that is inside. */
  normal: Vector2;
  distance: number;
}

/** A push away from a point. */
export interface Explosion {
  position: Vector2;
  /** Distance of a geom up to which the strength is full. Default 0. */
  radius?: number;
  /** Distance beyond the radius over which it falls to 0. Default 0. */
  falloff?: number;
  /** Impulse, or force, per length of the width that a geom turns to the point; negative to pull. */
  strength: number;
  filter?: Omit<QueryFilter, 'accepts'>;
}

/** Options of a new geom. */
export interface GeomOptions {
  /** Position on the body, in its frame. Default its origin. */
  offset?: Vector2;
  /** Rotation relative to the body, rad. Default 0. */
  rotationOffset?: number;
  /** Edge of a cell of the faithful set's distance grid; at 0 a tenth of the shorter side. Default 0. */
  collisionGridSize?: number;
  /** Friction coefficient, >= 0. Default 0. */
  frictionCoefficient?: number;
  /** Coefficient of restitution, usually 0 to 1. Default 0. */
  restitutionCoefficient?: number;
  /** The categories that it belongs to as bits, 31 of them: `1 << 3`. Default all. */
  collisionCategories?: number;
  /** The categories that it collides with. Two collide if either one's mask has a category of the other. Default all. */
  collidesWith?: number;
  /** Geoms of the same group do not collide; 0 is no group. Default 0. */
  collisionGroup?: number;
  /** Whether it forms new pairs. Default true. */
  collisionEnabled?: boolean;
  /** A sensor reports touches and exerts no impulse. Default false. */
  isSensor?: boolean;
}

/** A shape on a body, and how it collides. */
export class Geom implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  readonly body: Body;
  /** Its corners in the plane, for drawing. */
  readonly worldVertices: Vector2[];
  frictionCoefficient: number;
  restitutionCoefficient: number;
  collisionCategories: number;
  collidesWith: number;
  collisionGroup: number;
  collisionEnabled: boolean;
  isSensor: boolean;
  /** Makes it a sensor, or an ordinary geom, and leaves its body as it is; {@link isSensor} makes the body static. */
  set sensor(value: boolean);
  /** The geoms that it touches; of a sensor, the geoms in it. */
  overlaps(): Geom[];
  ignoreCollisionWith(other: Geom): void;
  restoreCollisionWith(other: Geom): void;
  dispose(): void;
}

/** A spring with a damper that a joint has for a motor. */
export interface JointServo {
  /** The travel that it seeks: rad, or length along an axis. */
  target: number;
  /** Torque per rad, or force per length, >= 0. */
  stiffness: number;
  /** Torque per angular velocity, or force per velocity, >= 0. */
  damping: number;
  /** Greatest torque or force. Default no bound. */
  greatestEffort?: number;
}

/** Strength of a motor joint. */
export interface PoseServo {
  /** Hz, >= 0. Default 4. */
  frequency?: number;
  /** 1 for critical damping. Default 1. */
  dampingRatio?: number;
  /** Default no bound. */
  greatestForce?: number;
  /** Default no bound. */
  greatestTorque?: number;
}

/** Options of a new joint. */
export interface JointOptions {
  /** Precise set, joints with an axis or an angle: a target that it seeks. `null`: none. */
  servo?: JointServo | null;
  /** Precise set, motor joints: the pose that it seeks: the place of the second body in the frame of the first, and the angle. */
  targetPose?: { offset: Vector2; angle: number };
  /** Whether the joined bodies collide. Default true. */
  bodiesCollide?: boolean;
  /** Precise set, revolute and prismatic joints: target speed, and greatest torque or force for it. `null`: none. */
  motor?: { speed: number; greatestEffort: number } | null;
  /** Precise set, revolute and prismatic joints: limits of its travel, rad or length. `null`: none. */
  limits?: { lower: number; upper: number } | null;
  /** Error beyond which it breaks: it is disabled, with an event. */
  breakpoint?: number;
  /** Precise set: force beyond which it breaks. */
  greatestForce?: number;
  /** Precise set: torque beyond which it breaks. */
  greatestTorque?: number;
  /** Softness, 0 for a rigid joint. Default 0. */
  softness?: number;
  /** Fraction of its error that a step corrects. */
  biasFactor?: number;
  /** Target angle of angle joints, rad. Default 0. */
  targetAngle?: number;
  /** Default true. */
  enabled?: boolean;
}

/** A constraint between two bodies, or a body and the world. */
export class Joint implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  /** Angle of a revolute joint in rad, or displacement of a prismatic joint. */
  readonly travel: number;
  /** Constraint force of the last step; precise set. */
  readonly force: Vector2;
  readonly torque: number;
  enabled: boolean;
  set motor(value: { speed: number; greatestEffort: number } | null);
  set limits(value: { lower: number; upper: number } | null);
  set servo(value: JointServo | null);
  /** Of a motor joint. */
  set poseServo(value: PoseServo);
  /** Of a motor joint. */
  set targetPose(value: { offset: Vector2; angle: number });
  set bodiesCollide(value: boolean);
  set breakpoint(value: number);
  set greatestForce(value: number);
  set greatestTorque(value: number);
  set softness(value: number);
  set biasFactor(value: number);
  set targetAngle(value: number);
  dispose(): void;
}

/** Options of a new spring. */
export interface SpringOptions {
  /** Error beyond which it breaks: it is disabled, with an event. */
  breakpoint?: number;
  /** Default true. */
  enabled?: boolean;
}

/** A force or torque towards a rest length or angle. */
export class Spring implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  enabled: boolean;
  set breakpoint(value: number);
  set springConstant(value: number);
  set dampingConstant(value: number);
  /** World end of a fixed linear spring. */
  set worldAttachPoint(value: Vector2);
  dispose(): void;
}

/** Members of both simulators; `AnyBody` is the class of their bodies, `Partner` the type of a touch partner. */
interface World<AnyBody extends Body, Partner> {
  /** Acceleration of gravity, y down. */
  gravity: Vector2;
  /** Precise set: substeps of a step, 4 at first. Faithful set: iterations of the solver, 5 at first. */
  iterations: number;
  /** Combination of the friction coefficients of two geoms. Default `average`. */
  set frictionType(value: 'average' | 'minimum');
  /** Whether bodies at rest sleep; precise set. Default true. */
  set isSleepEnabled(value: boolean);
  /**
   * Makes a step of `dt` seconds, greater than 0; best always the same.
   * @throws {PhysicsError} for other values.
   */
  step(dt: number): void;
  /** Begins and ends of touches, breaks and failures since the last call, in order; at most the last 65,536. */
  drainEvents(): Event<AnyBody, Partner>[];
  /** Hash of the motion of all bodies: equal runs have equal hashes on all machines. */
  stateHash(): bigint;
  /** The complete state, for a restore later, here or on another machine, with the same bits. */
  snapshot(): Uint8Array;
  /**
   * Restores a snapshot, and goes on with the same bits. Handles of objects that exist now and in the snapshot stay valid;
   * those of objects that are not in it are disposed. An object that was disposed since may get a new handle, without `userData`:
   * store data of the game by `slot`. Events that were not drained are lost.
   * @throws {PhysicsError} for bytes that are no snapshot of such a simulator, without effect.
   */
  restore(snapshot: Uint8Array): void;
  /** Frees its memory; every later call is refused. Garbage collection does the same. */
  free(): void;

  createRectangleBody(width: number, height: number, mass: number, options?: BodyOptions): AnyBody;
  createCircleBody(radius: number, mass: number, options?: BodyOptions): AnyBody;
  /** Upright: `height` from tip to tip, `endRadius` less than half of it. */
  createCapsuleBody(height: number, endRadius: number, mass: number, options?: BodyOptions): AnyBody;
  createPolygonBody(vertices: readonly Vector2[], mass: number, options?: BodyOptions): AnyBody;
  createBody(mass: number, momentOfInertia: number, options?: BodyOptions): AnyBody;

  createRectangleGeom(body: AnyBody, width: number, height: number, options?: GeomOptions): Geom;
  /** `numberOfEdges` is that of the polygon for the faithful set and rays. Default 16. */
  createCircleGeom(body: AnyBody, radius: number, options?: GeomOptions & { numberOfEdges?: number }): Geom;
  /** `edges` of each end are those of the polygon for the faithful set and rays. Default 8. */
  createCapsuleGeom(
    body: AnyBody,
    height: number,
    endRadius: number,
    options?: GeomOptions & { edges?: number },
  ): Geom;
  /** Any simple outline; its centroid is placed at the offset. */
  createPolygonGeom(body: AnyBody, vertices: readonly Vector2[], options?: GeomOptions): Geom;
  /** Precise set: edges as terrain on a static body: points from left to right make a floor. Closed if the last is the first. */
  createChainGeom(body: AnyBody, points: readonly Vector2[], options?: GeomOptions): Geom;

  /** The anchor is a point of the world, about which the bodies turn. */
  createRevoluteJoint(body1: AnyBody, body2: AnyBody, anchor: Vector2, options?: JointOptions): Joint;
  createFixedRevoluteJoint(body: AnyBody, anchor: Vector2, options?: JointOptions): Joint;
  /** The anchors are points of the bodies, in their frames; they keep their distance. */
  createPinJoint(
    body1: AnyBody,
    anchor1: Vector2,
    body2: AnyBody,
    anchor2: Vector2,
    options?: JointOptions,
  ): Joint;
  /** As a pin joint, but the distance may be anything from `min` to `max`. */
  createSliderJoint(
    body1: AnyBody,
    anchor1: Vector2,
    body2: AnyBody,
    anchor2: Vector2,
    min: number,
    max: number,
    options?: JointOptions,
  ): Joint;
  createWeldJoint(body1: AnyBody, body2: AnyBody, anchor: Vector2, options?: JointOptions): Joint;
  /** Precise set: `body2` slides along an axis of `body1`. */
  createPrismaticJoint(
    body1: AnyBody,
    body2: AnyBody,
    anchor: Vector2,
    axis: Vector2,
    options?: JointOptions,
  ): Joint;
  /** Precise set: `body2` turns freely and moves along an axis of `body1`, against a spring with a damper. */
  createWheelJoint(
    body1: AnyBody,
    body2: AnyBody,
    anchor: Vector2,
    axis: Vector2,
    stiffness: number,
    damping: number,
    options?: JointOptions,
  ): Joint;
  /** Precise set: a spring with a damper between the angles of two bodies. */
  createAngleSpringJoint(
    body1: AnyBody,
    body2: AnyBody,
    stiffness: number,
    damping: number,
    options?: JointOptions,
  ): Joint;
  /** Precise set: `body2` seeks a pose relative to `body1`, that which it has now or {@link JointOptions.targetPose}. */
  createMotorJoint(body1: AnyBody, body2: AnyBody, servo?: PoseServo, options?: JointOptions): Joint;
  createAngleJoint(body1: AnyBody, body2: AnyBody, options?: JointOptions): Joint;
  createFixedAngleJoint(body: AnyBody, options?: JointOptions): Joint;
  createAngleLimitJoint(
    body1: AnyBody,
    body2: AnyBody,
    min: number,
    max: number,
    options?: JointOptions,
  ): Joint;
  createFixedAngleLimitJoint(body: AnyBody, min: number, max: number, options?: JointOptions): Joint;

  /** The points are of the bodies, in their frames; its length is their distance now. */
  createLinearSpring(
    body1: AnyBody,
    point1: Vector2,
    body2: AnyBody,
    point2: Vector2,
    springConstant: number,
    dampingConstant: number,
    options?: SpringOptions,
  ): Spring;
  /** A spring between a point of a body, in its frame, and a point of the world, such as for dragging with the mouse. */
  createFixedLinearSpring(
    body: AnyBody,
    bodyPoint: Vector2,
    worldPoint: Vector2,
    springConstant: number,
    dampingConstant: number,
    options?: SpringOptions,
  ): Spring;
  createAngleSpring(
    body1: AnyBody,
    body2: AnyBody,
    springConstant: number,
    dampingConstant: number,
    options?: SpringOptions,
  ): Spring;
  createFixedAngleSpring(
    body: AnyBody,
    springConstant: number,
    dampingConstant: number,
    options?: SpringOptions,
  ): Spring;

  /** The geoms at a point: of the plane, or in 2.5D of the screen. */
  collideAll(point: Vector2): Geom[];
}

/**
 * An event. Of two geoms that touch each other only one is `geom`. Geoms of `addBody` have the events that they want, and those of
 * sensors are `sensorBegin` and `sensorEnd`; all other geoms have `touchBegin` and `touchEnd`, also with sensors.
 */
export type Event<AnyBody extends Body = Body, Partner = Geom> =
  | { type: 'touchBegin' | 'touchEnd'; geom: Geom; partner: Partner }
  | { type: 'sensorBegin' | 'sensorEnd'; sensor: Geom; visitor: Geom }
  /** A touch that began faster than {@link Simulator.hitSpeed}; the normal points from `geom` to `partner`. */
  | { type: 'hit'; geom: Geom; partner: Geom; point: Vector2; normal: Vector2; speed: number }
  | { type: 'bodySlept' | 'bodyWoke'; body: AnyBody }
  | { type: 'jointBroke'; joint: Joint }
  | { type: 'springBroke'; spring: Spring }
  /** The state of the body overflowed; it was restored and, unless the body is static, the body was disabled. */
  | { type: 'notFinite'; body: AnyBody };

/** Settings of a {@link Simulator}. */
export interface SimulatorOptions {
  /** y down. Default none. */
  gravity?: Vector2;
  /** `precise`, the default, is fast and accurate; `faithful` is Farseer Physics 2.1.3, bit for bit. */
  methods?: 'precise' | 'faithful';
  /** Precise set: size of a typical object. Default 32, for pixels; 1 for metres. */
  lengthUnit?: number;
  /** Faithful set: the narrow phase. Default `distanceGrid`. */
  narrowPhase?: 'distanceGrid' | 'sat';
  iterations?: number;
  frictionType?: 'average' | 'minimum';
  isSleepEnabled?: boolean;
}

/** The point at which a ray enters a geom. */
export interface RayCastHit {
  geom: Geom;
  point: Vector2;
  /** Outward unit vector. */
  normal: Vector2;
  /** Fraction of the distance from start to end, 0 to 1. */
  fraction: number;
}

/** The 2D engine. */
export class Simulator {
  /** @throws {PhysicsError} for gravity or a length unit that is not finite; {TypeError} for unknown settings. */
  constructor(options?: SimulatorOptions);
  /**
   * x, y and rotation of each body from `3 * body.slot` on, in the order of creation. The row of a disposed body is NaN until it
   * is used again. A view of the module's memory at present: read it once per frame, and copy values that are to last.
   */
  readonly positions: Float32Array;
  /** The first hit of a ray among the geoms of these categories, or null. A geom around the start is not hit there. */
  rayCast(start: Vector2, end: Vector2, options?: { categories?: number }): RayCastHit | null;
  /** The geoms whose AABBs overlap a box. */
  queryAabb(min: Vector2, max: Vector2): Geom[];

  /**
   * Adds a body with its geoms. Mass, centre and moment of inertia follow from the geoms.
   * @throws {PhysicsError} for values that are not possible; {TypeError} for unknown names. No object is added then.
   */
  addBody(options?: AddBodyOptions, geoms?: readonly AddGeomOptions[]): { body: Body; geoms: Geom[] };
  /** Adds a geom to a body, whose mass stays. */
  addGeom(body: Body, options: AddGeomOptions): Geom;
  /** Largest speed of dynamic bodies, `null` for none; precise set. Not in snapshots. */
  set largestSpeed(value: number | null);
  /** Speed from which on a touch of geoms that want hits is one. Not in snapshots. */
  set hitSpeed(value: number);
  /** Pushes dynamic bodies near a point by impulses; returns the number of geoms. */
  explode(explosion: Explosion): number;
  /** Pushes dynamic bodies near a point by forces in the next step; returns the number of geoms. */
  applyRadialForce(explosion: Explosion): number;
  /** All of a {@link snapshot} but the geoms, in about three quarters of the bytes: for rollback. */
  snapshotMoving(): Uint8Array;
  /**
   * Puts back such a state. Geoms keep the settings that they have now.
   * @throws {PhysicsError} if other geoms exist than then.
   */
  restoreMoving(moving: Uint8Array): void;

  /** The first geom that a ray enters, or null. */
  castRay(start: Vector2, end: Vector2, filter?: QueryFilter): RayCastHit | null;
  /** All geoms that a ray enters, by distance. */
  castRayAll(start: Vector2, end: Vector2, filter?: QueryFilter): RayCastHit[];
  /** Any geom on the way: the cheapest test of a line of sight. */
  castRayAny(start: Vector2, end: Vector2, filter?: QueryFilter): RayCastHit | null;
  /** The first geom that a shape touches on its way from a position by a motion; it touches at `position + fraction * motion`. */
  castShape(
    shape: AddGeomOptions,
    position: Vector2,
    rotation: number,
    motion: Vector2,
    filter?: QueryFilter,
  ): RayCastHit | null;
  castShapeAll(
    shape: AddGeomOptions,
    position: Vector2,
    rotation: number,
    motion: Vector2,
    filter?: QueryFilter,
  ): RayCastHit[];
  /** The geoms that a shape touches or overlaps. */
  overlapShape(shape: AddGeomOptions, position: Vector2, rotation?: number, filter?: QueryFilter): Geom[];
  /** Any geom that a shape touches or overlaps: whether there is room for it. */
  overlapAny(shape: AddGeomOptions, position: Vector2, rotation?: number, filter?: QueryFilter): Geom | null;
  /** The geoms that contain a point. */
  geomsAt(point: Vector2, filter?: QueryFilter): Geom[];
  /** The nearest geom within a distance. */
  nearestPoint(point: Vector2, maxDistance: number, filter?: Omit<QueryFilter, 'accepts'>): NearestPoint | null;
}

export interface Simulator extends World<Body, Geom> {}

/** Options of a {@link CharacterMover}: lengths in px, times in s, angles in rad. */
export interface MoverOptions {
  /** Greatest acceleration on the ground. Default 1500. */
  acceleration?: number;
  /** Greatest acceleration in the air. Default 600. */
  airAcceleration?: number;
  /** Default 1. */
  gravityScale?: number;
  /** Height of a jump whose key is held. Default 60. */
  jumpHeight?: number;
  /** Fraction of the upward velocity that stays when the key is released. Default 0.5. */
  jumpCut?: number;
  /** Time after an edge in which a jump is still possible. Default 0.1. */
  coyoteTime?: number;
  /** Time before landing in which the press of the key is remembered. Default 0.1. */
  jumpBuffer?: number;
  /** Slope of the steepest ground. Default 50 degrees. */
  maxSlope?: number;
  /** Height of the highest edge that is stepped up. Default 8. */
  stepUp?: number;
  /** Greatest gap below the soles that is closed without a fall. Default 8. */
  snap?: number;
  /** Greatest force that pushes dynamic bodies. Default 3000. */
  pushForce?: number;
  /** Mass whose weight acts on dynamic bodies under it. Default 2. */
  mass?: number;
  /** Geoms of at least one of these categories are obstacles. Default all. */
  categories?: number;
  /** Categories of the mover. Default all. */
  asCategories?: number;
}

/** Input of a {@link CharacterMover}. */
export interface MoverInput {
  /** Wanted speed along X, relative to the ground. Default 0. */
  x?: number;
  /** Whether the jump key is down. A jump begins when it goes down. Default false. */
  jump?: boolean;
  /** Whether to drop through one-way ground. Default false. */
  drop?: boolean;
}

/** A contact of a {@link CharacterMover}. */
export interface MoverTouch {
  geom: Geom;
  point: Vector2;
  /** Unit vector from the geom to the mover. */
  normal: Vector2;
}

/** The outcome of a move. */
export interface MoverReport {
  ground: MoverTouch | null;
  left: MoverTouch | null;
  right: MoverTouch | null;
  ceiling: MoverTouch | null;
  /** A body that is in the mover and cannot push it out of itself. */
  crushedBy: Body | null;
  jumped: boolean;
  landed: boolean;
  landingSpeed: number;
}

/** A character of the 2D engine that walks, jumps and falls by casts; `update` it once after each step. */
export class CharacterMover {
  constructor(simulator: Simulator, shape: AddGeomOptions, position: Vector2, options?: MoverOptions);
  /** Overwrites the given options. */
  set options(value: MoverOptions);
  update(input: MoverInput, dt: number): MoverReport;
  position: Vector2;
  readonly velocity: Vector2;
  /** Throws it off the ground. */
  launch(velocity: Vector2): void;
  readonly isGrounded: boolean;
  /** A kinematic body that follows it, so that queries, sensors and dynamic bodies meet it. */
  body: Body | null;
  /** State between two moves, for saves and rollback. */
  state: Uint8Array;
  dispose(): void;
}

/** Steps of a fixed length for frames of any length, with poses between two steps. */
export class FixedStepRunner {
  constructor(simulator: Simulator, options?: { updatesPerSecond?: number; maxUpdates?: number });
  /** Length of a step in s. */
  readonly dt: number;
  /** Greatest number of steps of a frame; the rest is dropped. Default 5. */
  maxUpdates: number;
  /** Makes the steps that are due after `elapsed` s; returns their number. `update` must make a step. */
  advance(elapsed: number, update?: (simulator: Simulator, dt: number) => void): number;
  /** Fraction of a step since the last one, 0 to 1. */
  readonly interpolation: number;
  /** The pose between the last two steps, or null for a body that was not there. */
  pose(body: Body): { position: Vector2; rotation: number } | null;
  /** Lets the next step not interpolate a body that was put elsewhere. */
  markTeleport(body: Body): void;
  /** Forgets waiting time and poses: after a restore. */
  reset(): void;
}

/** Makes the calls of the game for a step, by its input, and the step itself. */
export type Play = (simulator: Simulator, input: Uint8Array, dt: number) => void;

/** A run in one file: a state every so many steps, and of each step its length, the input of the game and a hash. */
export class Recording {
  /** Begins with the present state. `keyframeInterval`: steps from one saved state to the next; default 60. */
  constructor(simulator: Simulator, keyframeInterval?: number);
  /** @throws {PhysicsError} for bytes that are no recording of this version. */
  static fromBytes(file: Uint8Array): Recording;
  toBytes(): Uint8Array;
  /** Records a step, after it. */
  record(simulator: Simulator, dt: number, input?: Uint8Array): void;
  /** Number of recorded steps. */
  readonly length: number;
  readonly keyframeInterval: number;
  dt(step: number): number;
  input(step: number): Uint8Array;
  /** Hash of the state after a step. */
  stateHash(step: number): bigint;
  /** Puts the simulator to the state after a number of steps. `play` is not called at a keyframe. */
  restore(simulator: Simulator, steps: number, play: Play): void;
  /** Replays the run; the first step with other bits than recorded, or null. */
  firstDivergence(simulator: Simulator, play: Play): number | null;
  /** The first step in which two recordings differ, or null. */
  firstDifference(other: Recording): number | null;
  /** Frees its memory, as garbage collection does. */
  free(): void;
}

/** Settings of walking figures: lengths in px, times in s. */
export interface WalkSettings {
  /** px/s². Default 1500. */
  acceleration: number;
  /** px/s². Default 600. */
  airAcceleration: number;
  /** Height of a jump at the soles. Default 60. */
  jumpHeight: number;
  /** The highest curb that does not stop it. Default 8. */
  stepUp: number;
  /** Greatest distance of a floor below the soles to which it is put down instead of falling. Default 8. */
  snap: number;
  /** The steepest slope that is a floor, rad. Default 50 degrees. */
  maxSlope: number;
  /** Time after an edge in which a jump is still possible. Default 0.1. */
  coyoteTime: number;
  /** Height over the soles up to which it grabs ledges in the air; 0, the default, for none. */
  ledgeReach: number;
  /** Speed of climbing over a ledge, px/s. Default 160. */
  climbSpeed: number;
}

/** A body of the 2.5D engine. Inherited members are in its plane: x as in the world, y down. */
export class DepthBody extends Body {
  protected constructor();
  /** x and z of its origin, and as y the height of its lowest point over the ground. */
  position3d: Vector3;
  velocity3d: Vector3;
  /** Position of its origin on the screen. */
  readonly screenPosition: Vector2;
  /** Whether it lies or stands on a support. */
  readonly isGrounded: boolean;
  /** Height of the surface beneath it, for its shadow; null if there is none. */
  readonly heightBeneath: number | null;
  /** Settings of its walking; absent ones are kept. */
  get walkSettings(): WalkSettings;
  set walkSettings(value: Partial<WalkSettings>);
  applyForce3d(amount: Vector3): void;
  applyImpulse3d(amount: Vector3): void;
  /** Moves a kinematic body to a position in the next step. */
  moveTo3d(position3d: Vector3): void;
  /** Friction and restitution of the ground for it; absent values are 0. */
  setGround(surface: { frictionCoefficient?: number; restitutionCoefficient?: number }): void;
  /** Sets the geom that rests on the ground; without one it falls for ever. Spawned bodies have one. */
  setObjectGeom(geom: Geom): void;
  /** Ends walking: the figure falls and slides like any body. */
  letGo(): void;
}

/** Options of a new platform. */
export interface PlatformOptions {
  /** Tilt, clockwise on the screen, rad: a slope. Default 0. */
  rotation?: number;
  velocity?: Vector3;
  /** Speed of its surface, as of a belt, along its tilted width, and along z. */
  surfaceSpeed?: { along: number; depth: number };
  /** Open from below and from its sides. Default false. */
  isOneWay?: boolean;
}

/** A static or moving box to stand on, which no contact moves. */
export class Platform implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  /** x and z of its middle, and as y the height of its underside when level. */
  position3d: Vector3;
  /** Its eight corners on the screen: of the front, clockwise from the top left one, then of the back likewise. */
  readonly screenCorners: Vector2[];
  set velocity(value: Vector3);
  set surfaceSpeed(value: { along: number; depth: number });
  set isOneWay(value: boolean);
  /** Absent values are 0. */
  setSurface(surface: { frictionCoefficient?: number; restitutionCoefficient?: number }): void;
  /** Moves it to a position in the next step; it carries the bodies on it. */
  moveTo(position3d: Vector3): void;
  /** Removes it at once. */
  dispose(): void;
}

/** Options of a spawned body. */
export interface SpawnOptions {
  /** x, height of its lowest point, z. Default the origin. */
  position3d?: Vector3;
  /** Default 1. */
  mass?: number;
  /** For all contacts, also with the ground. Default 0.4. */
  frictionCoefficient?: number;
  /** Default 0. */
  restitutionCoefficient?: number;
}

export interface Size {
  /** Along x. */
  width: number;
  /** Along y. */
  height: number;
  /** Along z. */
  depth: number;
}

/** A body with its only geom. */
export interface Spawned {
  body: DepthBody;
  geom: Geom;
}

/** Settings of a {@link DepthSimulator}. */
export interface DepthSimulatorOptions {
  /** Height of the screen, px. */
  height: number;
  /** Angle of the z axis on the screen, degrees, 1 to 179; 90 is straight up. Default 90. */
  angle?: number;
  /** y down. Default none. */
  gravity?: Vector2;
  methods?: 'precise' | 'faithful';
  iterations?: number;
  frictionType?: 'average' | 'minimum';
  isSleepEnabled?: boolean;
}

/** The point at which a ray enters a geom, a platform or the ground. */
export interface RayHit3d {
  partner: Geom | Platform | 'ground';
  point: Vector3;
  normal: Vector3;
  fraction: number;
}

/** The 2.5D engine: bodies with height and depth, each with its ground, and platforms. */
export class DepthSimulator {
  /** @throws {PhysicsError} for a height or angle out of range; {TypeError} for unknown settings. */
  constructor(options: DepthSimulatorOptions);
  /**
   * x, y, z and rotation of each body from `4 * body.slot` on, as {@link DepthBody.position3d}; otherwise as
   * {@link Simulator.positions}.
   */
  readonly positions: Float32Array;
  /** A box. `isUpright`: it never topples. */
  spawnPrism(size: Size, options?: SpawnOptions & { isUpright?: boolean }): Spawned;
  /** A ball, which rolls in all directions. */
  spawnBall(radius: number, options?: SpawnOptions): Spawned;
  /**
   * A walking figure: an upright cylinder of mass 70, without friction, whose diameter is the mean of width and depth. Only with
   * the precise set of methods, like walking.
   */
  spawnFigure(
    size: Size,
    options?: { mass?: number; position3d?: Vector3; walk?: Partial<WalkSettings> },
  ): Spawned;
  /** Four invisible walls around a level: left, right, front and back. */
  spawnLane(bounds: { left: number; right: number; front: number; back: number; height: number }): Platform[];
  /** A platform at its {@link Platform.position3d}. It collides at once. */
  createPlatform(size: Size, position3d: Vector3, options?: PlatformOptions): Platform;
  /** Gives the outline of a geom a depth. */
  setPrism(geom: Geom, depth: number): void;
  /** Makes a geom a ball. */
  setRound(geom: Geom, radius: number): void;
  /**
   * Moves a figure that walks, jumps and falls as a player expects: call it before each step, with the step's `dt`. Speeds in px/s.
   * Returns whether it stands.
   */
  walk(body: DepthBody, wish: { x?: number; z?: number; jump?: boolean }, dt: number): boolean;
  toScreen(point: Vector3): Vector2;
  /** The point of the ground that appears at a point of the screen. */
  screenToGround(point: Vector2): Vector3;
  /** The bodies and platforms, from back to front. */
  drawOrder(): (DepthBody | Platform)[];
  /** The front body or platform at a point of the screen, or null. */
  pickFront(point: Vector2): DepthBody | Platform | null;
  /** The first hit of a ray, or null. */
  rayCast3d(start: Vector3, end: Vector3): RayHit3d | null;
}

export interface DepthSimulator extends World<DepthBody, Geom | Platform | 'ground'> {}
