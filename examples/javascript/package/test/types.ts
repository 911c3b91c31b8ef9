// Code that `tsc` must accept, and code that it must refuse.

import {
  type AddGeomOptions,
  CharacterMover,
  type DepthBody,
  DepthSimulator,
  type Event,
  FixedStepRunner,
  type Geom,
  Platform,
  type QueryFilter,
  Recording,
  Simulator,
  initialize,
} from '../index.js';

await initialize();
const simulator = new Simulator({ gravity: { x: 0, y: 300 }, methods: 'faithful', narrowPhase: 'sat' });
const body = simulator.createCircleBody(10, 1, { position: { x: 1, y: 2 }, isBullet: true });
const geom: Geom = simulator.createCircleGeom(body, 10, { numberOfEdges: 24, isSensor: true });
const joint = simulator.createFixedRevoluteJoint(body, { x: 0, y: 0 }, { motor: { speed: 1, greatestEffort: 5 } });
joint.limits = null;
for (let row: number = body.slot, at = simulator.positions; row < at.length; row += 3) at[row];
const hit = simulator.rayCast({ x: 0, y: 0 }, { x: 1, y: 0 });
if (hit !== null) hit.geom.body.applyImpulse(hit.normal);

function tell(event: Event): number {
  switch (event.type) {
    case 'touchBegin':
    case 'touchEnd':
      return event.partner.body.mass;
    case 'jointBroke':
      return event.joint.travel;
    case 'springBroke':
      event.spring.enabled = true;
      return 0;
    case 'sensorBegin':
    case 'sensorEnd':
      return event.sensor.body.mass + event.visitor.body.mass;
    case 'hit':
      return event.speed * event.normal.y;
    case 'bodySlept':
    case 'bodyWoke':
    case 'notFinite':
      return event.body.mass;
  }
}
simulator.drainEvents().forEach(tell);

const hull: AddGeomOptions = { polygon: [{ x: 0, y: 0 }, { x: 9, y: 0 }, { x: 0, y: 9 }], friction: 0.4, events: ['hit'], oneWay: { x: 0, y: -1 } };
const { body: crate, geoms } = simulator.addBody({ type: 'kinematic', lockRotation: true, userData: 7 }, [hull, { circle: { radius: 4 } }]);
const filter: QueryFilter = { categories: 1 << 3, excludeBody: crate, accepts: (found) => found !== geoms[0] };
const cast = simulator.castShape({ capsule: { height: 9, endRadius: 2 } }, { x: 0, y: 0 }, 0, { x: 9, y: 0 }, filter);
if (cast !== null) cast.geom.sensor = true;
simulator.createWheelJoint(body, crate, { x: 0, y: 0 }, { x: 0, y: 1 }, 100, 5, { bodiesCollide: false }).servo = null;
simulator.createMotorJoint(body, crate, { frequency: 2 }, { targetPose: { offset: { x: 1, y: 0 }, angle: 0 } });
const mover = new CharacterMover(simulator, { circle: { radius: 9 } }, { x: 0, y: 0 }, { stepUp: 9 });
const landed: boolean = mover.update({ x: 9, jump: true }, 1 / 60).landed;
const runner = new FixedStepRunner(simulator, { updatesPerSecond: 120 });
runner.advance(0.1, (running, dt) => running.step(dt));
const turned: number | undefined = runner.pose(crate)?.rotation;
const recording = new Recording(simulator, 30);
recording.record(simulator, 1 / 60);
const parted: number | null = Recording.fromBytes(recording.toBytes()).firstDivergence(simulator, (played, [push = 0], dt) => {
  played.explode({ position: { x: 0, y: 0 }, strength: push });
  played.step(dt);
});
const same: boolean = simulator.stateHash() === recording.stateHash(0);
simulator.restoreMoving(simulator.snapshotMoving());

const depth = new DepthSimulator({ height: 480 });
const figure: DepthBody = depth.spawnFigure({ width: 1, height: 2, depth: 1 }, { walk: { jumpHeight: 80 } }).body;
figure.walkSettings = { snap: 4 };
const stands: boolean = depth.walk(figure, { jump: true }, 1 / 60);
for (const drawn of depth.drawOrder()) {
  if (drawn instanceof Platform) drawn.screenCorners.length;
  else drawn.position3d.y;
}
for (const event of depth.drainEvents()) {
  if (event.type === 'touchBegin' && event.partner === 'ground') event.geom.body;
}

// @ts-expect-error the methods have names
new Simulator({ methods: 'exact' });
// @ts-expect-error a height is needed
new DepthSimulator({});
// @ts-expect-error bodies are made by simulators
new Platform();
// @ts-expect-error a 2D body has no depth
body.position3d;
// @ts-expect-error a body of the 2D engine does not walk
depth.walk(body, { x: 1 }, 1 / 60);
// @ts-expect-error a geom has a shape
simulator.addBody({}, [{ friction: 1 }]);
// @ts-expect-error filters have names
simulator.castRay({ x: 0, y: 0 }, { x: 1, y: 0 }, { category: 1 });
// @ts-expect-error movers are of the 2D engine
new CharacterMover(depth, { circle: { radius: 9 } }, { x: 0, y: 0 });
// @ts-expect-error slots do not change
body.slot = 1;
// @ts-expect-error settings have names
simulator.createCircleGeom(body, 10, { friction: 0.5 });
// @ts-expect-error write-only properties cannot be read
const motor: { speed: number; greatestEffort: number } = joint.motor as string;

export { geom, landed, motor, parted, same, stands, turned };
