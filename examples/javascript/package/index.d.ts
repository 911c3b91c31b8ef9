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

/** A call that the engine refused, in its words. A refused call has changed nothing. */
export class PhysicsError extends Error {}

/**
 * Loads the module; to be awaited once before anything else. Later calls wait for the first one.
 * @param source where it is, if not beside this file; or what it is.
 * @throws if it cannot be loaded; then it may be tried again.
 */
export function initialize(
  source?: string | URL | Response | BufferSource | WebAssembly.Module,
): Promise<void>;

/** Something that lives in a simulator. Of each there is one handle: they can be compared. */
interface Thing {
  /** Whatever the game wants to keep with it; not part of snapshots. */
  userData: unknown;
  /** Whether it was disposed; every other call is refused once it is gone, which is with the next step. */
  readonly isDisposed: boolean;
}

/** What can be said of a body while it is made. */
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
  /** Nothing moves it. Default false. */
  isStatic?: boolean;
  /** Nothing pushes it; it goes on with its velocity, or to where it is told. Default false. */
  isKinematic?: boolean;
  /** Precise set: nothing ever passes through what stands still, and this not through what moves either. Default false. */
  isBullet?: boolean;
  /** Whether it takes part. Default true. */
  enabled?: boolean;
  /** How much of the gravity it feels. Default 1. */
  gravityScale?: number;
  /** Slows it down. Default 0.001. */
  linearDragCoefficient?: number;
  /** Default 0.001. */
  rotationalDragCoefficient?: number;
}

/** What has mass, place and motion; geoms give it a shape. */
export class Body implements Thing, Required<BodyOptions> {
  protected constructor();
  userData: unknown;
  /** Its row in {@link Simulator.positions}: small, and used again after disposal. */
  readonly slot: number;
  readonly isDisposed: boolean;
  /** At rest with everything that it hangs together with; precise set. */
  readonly isAsleep: boolean;
  /** Rotation with all turns, rad. */
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
  /** Lets the next step bring a kinematic body to a place and rotation; it pushes and carries what it touches. */
  moveTo(position: Vector2, rotation: number): void;
  /** Acts in the next step alone. */
  applyForce(amount: Vector2): void;
  /** Acts in the next step alone, and turns the body if it does not go through its middle. */
  applyForceAtWorldPoint(amount: Vector2, point: Vector2): void;
  applyTorque(torque: number): void;
  /** Mass times velocity. */
  applyImpulse(amount: Vector2): void;
  applyAngularImpulse(amount: number): void;
  wake(): void;
  /** From the world to the frame of the body. */
  getLocalPosition(worldPosition: Vector2): Vector2;
  /** From the frame of the body to the world. */
  getWorldPosition(localPosition: Vector2): Vector2;
  /** Takes it out of the simulation, with its geoms, in the next step. */
  dispose(): void;
}

/** What can be said of a geom while it is made. */
export interface GeomOptions {
  /** Place on the body, in its frame. Default its origin. */
  offset?: Vector2;
  /** Against the body, rad. Default 0. */
  rotationOffset?: number;
  /** Edge of a cell of the faithful set's distance grid; at 0 a tenth of the shorter side. Default 0. */
  collisionGridSize?: number;
  /** 0 is ice. Default 0. */
  frictionCoefficient?: number;
  /** Bounciness, usually 0 to 1. Default 0. */
  restitutionCoefficient?: number;
  /** The categories that it belongs to as bits, 31 of them: `1 << 3`. Default all. */
  collisionCategories?: number;
  /** The categories that it collides with. Two collide if either one's mask meets the other's categories. Default all. */
  collidesWith?: number;
  /** Geoms of the same group do not collide; 0 is no group. Default 0. */
  collisionGroup?: number;
  /** Whether new pairs with it are looked for. Default true. */
  collisionEnabled?: boolean;
  /** It tells of touches, but pushes nothing. Default false. */
  isSensor?: boolean;
}

/** A shape on a body, and how it collides. */
export class Geom implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  readonly body: Body;
  /** Its corners in the plane, to draw them. */
  readonly worldVertices: Vector2[];
  frictionCoefficient: number;
  restitutionCoefficient: number;
  collisionCategories: number;
  collidesWith: number;
  collisionGroup: number;
  collisionEnabled: boolean;
  isSensor: boolean;
  /** The geoms that it touches; of a sensor, what is in it. */
  overlaps(): Geom[];
  ignoreCollisionWith(other: Geom): void;
  restoreCollisionWith(other: Geom): void;
  dispose(): void;
}

/** What can be said of a joint while it is made. */
export interface JointOptions {
  /** Precise set, joints that turn or slide: a speed that it seeks, and the greatest torque or force for it. `null`: none. */
  motor?: { speed: number; greatestEffort: number } | null;
  /** Precise set, joints that turn or slide: from where to where, rad or length. `null`: none. */
  limits?: { lower: number; upper: number } | null;
  /** Error beyond which it breaks: it is disabled, and an event tells so. */
  breakpoint?: number;
  /** Precise set: force beyond which it breaks. */
  greatestForce?: number;
  /** Precise set: torque beyond which it breaks. */
  greatestTorque?: number;
  /** How much it yields. Default 0. */
  softness?: number;
  /** Part of its error that a step corrects. */
  biasFactor?: number;
  /** Of angle joints: the angle that they keep, rad. Default 0. */
  targetAngle?: number;
  /** Default true. */
  enabled?: boolean;
}

/** Two bodies, or a body and the world, held together. */
export class Joint implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  /** How far a joint that turns or slides has done so, rad or length. */
  readonly travel: number;
  /** What it held with in the last step; precise set. */
  readonly force: Vector2;
  readonly torque: number;
  enabled: boolean;
  set motor(value: { speed: number; greatestEffort: number } | null);
  set limits(value: { lower: number; upper: number } | null);
  set breakpoint(value: number);
  set greatestForce(value: number);
  set greatestTorque(value: number);
  set softness(value: number);
  set biasFactor(value: number);
  set targetAngle(value: number);
  dispose(): void;
}

/** What can be said of a spring while it is made. */
export interface SpringOptions {
  /** Error beyond which it breaks: it is disabled, and an event tells so. */
  breakpoint?: number;
  /** Default true. */
  enabled?: boolean;
}

/** Pulls and pushes towards a length or an angle. */
export class Spring implements Thing {
  protected constructor();
  userData: unknown;
  readonly isDisposed: boolean;
  enabled: boolean;
  set breakpoint(value: number);
  set springConstant(value: number);
  set dampingConstant(value: number);
  /** Of fixed linear springs: the point of the world that they pull to. */
  set worldAttachPoint(value: Vector2);
  dispose(): void;
}

/** What both simulators have; `AnyBody` is the kind of their bodies, `Partner` what geoms can touch. */
interface World<AnyBody extends Body, Partner> {
  /** Acceleration of everything, y down. */
  gravity: Vector2;
  /** Substeps of a step with the precise set, 4 to begin with; passes of the solver with the faithful one. Default 5. */
  iterations: number;
  /** How the frictions of two geoms combine. Default `average`. */
  set frictionType(value: 'average' | 'minimum');
  /** Whether what has come to rest sleeps; precise set. Default true. */
  set isSleepEnabled(value: boolean);
  /**
   * Goes on by so many seconds, greater than 0; best always the same.
   * @throws {PhysicsError} for anything else.
   */
  step(dt: number): void;
  /** What began and ceased to touch, broke or failed since the last call, in order; at most the last 65,536. */
  drainEvents(): Event<AnyBody, Partner>[];
  /** Everything that can influence a later bit, to be restored later, here or on another machine. */
  snapshot(): Uint8Array;
  /**
   * Becomes the simulator of a snapshot and goes on with the same bits. Handles of what lives now and in the snapshot stay good;
   * those of what is not in it are disposed. What was disposed since may get a new handle, without `userData`: keep by `slot`
   * what a game needs of it. The events that nobody has asked for are gone.
   * @throws {PhysicsError} for bytes that are no snapshot of such a simulator; then nothing has changed.
   */
  restore(snapshot: Uint8Array): void;
  /** Gives its memory back; every later call is refused. It happens by itself when nothing refers to it any more. */
  free(): void;

  createRectangleBody(width: number, height: number, mass: number, options?: BodyOptions): AnyBody;
  createCircleBody(radius: number, mass: number, options?: BodyOptions): AnyBody;
  /** Upright: `height` from tip to tip, `endRadius` less than half of it. */
  createCapsuleBody(height: number, endRadius: number, mass: number, options?: BodyOptions): AnyBody;
  createPolygonBody(vertices: readonly Vector2[], mass: number, options?: BodyOptions): AnyBody;
  createBody(mass: number, momentOfInertia: number, options?: BodyOptions): AnyBody;

  createRectangleGeom(body: AnyBody, width: number, height: number, options?: GeomOptions): Geom;
  /** `numberOfEdges` is of what the faithful set and rays see. Default 16. */
  createCircleGeom(body: AnyBody, radius: number, options?: GeomOptions & { numberOfEdges?: number }): Geom;
  /** `edges` of each end, for what the faithful set and rays see. Default 8. */
  createCapsuleGeom(
    body: AnyBody,
    height: number,
    endRadius: number,
    options?: GeomOptions & { edges?: number },
  ): Geom;
  /** Any simple outline; its centroid comes to lie at the offset. */
  createPolygonGeom(body: AnyBody, vertices: readonly Vector2[], options?: GeomOptions): Geom;
  /** Precise set: edges as terrain on a static body: points from left to right make a floor. Closed if the last is the first. */
  createChainGeom(body: AnyBody, points: readonly Vector2[], options?: GeomOptions): Geom;

  /** The anchor is a point of the world; bodies turn about it. */
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
  /** Between a point of a body, in its frame, and a point of the world: what a mouse drags with. */
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

/** What happened. Of two geoms that touch each other only one is `geom`. */
export type Event<AnyBody extends Body = Body, Partner = Geom> =
  | { type: 'touchBegin' | 'touchEnd'; geom: Geom; partner: Partner }
  | { type: 'jointBroke'; joint: Joint }
  | { type: 'springBroke'; spring: Spring }
  /** The body left all numbers; it was put back and, unless it is static, disabled. */
  | { type: 'notFinite'; body: AnyBody };

/** Settings of a {@link Simulator}. */
export interface SimulatorOptions {
  /** y down. Default none. */
  gravity?: Vector2;
  /** `precise`, the default, is fast and accurate; `faithful` is Farseer Physics 2.1.3, bit for bit. */
  methods?: 'precise' | 'faithful';
  /** Precise set: how long something of middle size is. Default 32, for pixels; 1 for metres. */
  lengthUnit?: number;
  /** Faithful set: how contacts are found. Default `distanceGrid`. */
  narrowPhase?: 'distanceGrid' | 'sat';
  iterations?: number;
  frictionType?: 'average' | 'minimum';
  isSleepEnabled?: boolean;
}

/** Where a ray enters a geom. */
export interface RayCastHit {
  geom: Geom;
  point: Vector2;
  /** Outward, of length 1. */
  normal: Vector2;
  /** Part of the way from start to end, 0 to 1. */
  fraction: number;
}

/** The 2D engine. */
export class Simulator {
  /** @throws {PhysicsError} for gravity or a length unit that is not finite; {TypeError} for unknown settings. */
  constructor(options?: SimulatorOptions);
  /**
   * x, y and rotation of each body from `3 * body.slot` on: in the order of creation, until something is disposed, whose row is
   * NaN until it is used again. A view of the module's memory as things are now: ask for it once per frame, not once for ever,
   * and copy what is to last.
   */
  readonly positions: Float32Array;
  /** Where a ray enters the first geom of these categories, or null. A geom that holds the start is not hit there. */
  rayCast(start: Vector2, end: Vector2, options?: { categories?: number }): RayCastHit | null;
  /** The geoms whose boxes reach into a box. */
  queryAabb(min: Vector2, max: Vector2): Geom[];
}

export interface Simulator extends World<Body, Geom> {}

/** How a figure walks: lengths in px, times in s. */
export interface WalkSettings {
  /** px/s². Default 1500. */
  acceleration: number;
  /** px/s². Default 600. */
  airAcceleration: number;
  /** How far the soles rise. Default 60. */
  jumpHeight: number;
  /** The highest curb that is walked up as if it were none. Default 8. */
  stepUp: number;
  /** How far below the soles the floor may be for a figure to be put down on it instead of falling. Default 8. */
  snap: number;
  /** The steepest slope that is a floor, rad. Default 50 degrees. */
  maxSlope: number;
  /** How long one may still jump after an edge. Default 0.1. */
  coyoteTime: number;
  /** How far over the soles the edges are that it takes hold of in the air; 0, the default, for none. */
  ledgeReach: number;
  /** How fast it climbs over an edge, px/s. Default 160. */
  climbSpeed: number;
}

/** A body of the 2.5D engine. What it inherits is of its plane: x as in the world, y down. */
export class DepthBody extends Body {
  protected constructor();
  /** x and z of its origin, and as y the height of its lowest point over the ground. */
  position3d: Vector3;
  velocity3d: Vector3;
  /** Where its origin appears. */
  readonly screenPosition: Vector2;
  /** Whether it lies or stands on something. */
  readonly isGrounded: boolean;
  /** The height of what it would fall on, for its shadow; null where there is nothing. */
  readonly heightBeneath: number | null;
  /** How it walks; what is not set stays. */
  get walkSettings(): WalkSettings;
  set walkSettings(value: Partial<WalkSettings>);
  applyForce3d(amount: Vector3): void;
  applyImpulse3d(amount: Vector3): void;
  /** Lets the next step bring a kinematic body to a place. */
  moveTo3d(position3d: Vector3): void;
  /** What the ground is like for it; what is not said is 0. */
  setGround(surface: { frictionCoefficient?: number; restitutionCoefficient?: number }): void;
  /** With which of its geoms it lies on the ground; without one it falls for ever. Things that are spawned have one. */
  setObjectGeom(geom: Geom): void;
  /** Gives a figure that walked back to gravity. */
  letGo(): void;
}

/** What can be said of a platform while it is made. */
export interface PlatformOptions {
  /** Tilt, clockwise on the screen, rad: a slope. Default 0. */
  rotation?: number;
  velocity?: Vector3;
  /** It is a belt: speed of its surface along its tilted width, and along z. */
  surfaceSpeed?: { along: number; depth: number };
  /** Open from below and from its sides. Default false. */
  isOneWay?: boolean;
}

/** A box that nothing pushes, to stand on. */
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
  /** What is not said is 0. */
  setSurface(surface: { frictionCoefficient?: number; restitutionCoefficient?: number }): void;
  /** Lets the next step bring it to a place; it carries what stands on it. */
  moveTo(position3d: Vector3): void;
  /** Takes it away, at once. */
  dispose(): void;
}

/** What can be said of something that is spawned. */
export interface SpawnOptions {
  /** x, height of its lowest point, z. Default the origin. */
  position3d?: Vector3;
  /** Default 1. */
  mass?: number;
  /** Against everything, the ground too. Default 0.4. */
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
  /** Of the screen, px. */
  height: number;
  /** Of the z axis on the screen, degrees, 1 to 179; 90 is straight up. Default 90. */
  angle?: number;
  /** y down. Default none. */
  gravity?: Vector2;
  methods?: 'precise' | 'faithful';
  iterations?: number;
  frictionType?: 'average' | 'minimum';
  isSleepEnabled?: boolean;
}

/** Where a ray enters something of the world. */
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
   * Somebody who walks: an upright cylinder of mass 70, without friction, whose diameter is the mean of width and depth. Only with
   * the precise set of methods, as walking.
   */
  spawnFigure(
    size: Size,
    options?: { mass?: number; position3d?: Vector3; walk?: Partial<WalkSettings> },
  ): Spawned;
  /** Four invisible walls around a level: left, right, front and back. */
  spawnLane(bounds: { left: number; right: number; front: number; back: number; height: number }): Platform[];
  /** A platform at its {@link Platform.position3d}. It takes part at once. */
  createPlatform(size: Size, position3d: Vector3, options?: PlatformOptions): Platform;
  /** Gives the outline of a geom a depth. */
  setPrism(geom: Geom, depth: number): void;
  /** Makes a geom a ball. */
  setRound(geom: Geom, radius: number): void;
  /**
   * Lets a figure walk, jump and fall as a player expects: before each step, with the step's `dt`. Speeds in px/s.
   * Answers whether it stands.
   */
  walk(body: DepthBody, wish: { x?: number; z?: number; jump?: boolean }, dt: number): boolean;
  toScreen(point: Vector3): Vector2;
  /** The point of the ground that appears at a point of the screen. */
  screenToGround(point: Vector2): Vector3;
  /** What is to be drawn, from back to front. */
  drawOrder(): (DepthBody | Platform)[];
  /** What is in front at a point of the screen, or null. */
  pickFront(point: Vector2): DepthBody | Platform | null;
  /** Where a ray enters the first thing, or null. */
  rayCast3d(start: Vector3, end: Vector3): RayHit3d | null;
}

export interface DepthSimulator extends World<DepthBody, Geom | Platform | 'ground'> {}
