// Code that `tsc` must accept, and code that it must refuse.

import { type DepthBody, DepthSimulator, type Event, type Geom, Platform, Simulator, initialize } from '../index.js';

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
    case 'notFinite':
      return event.body.mass;
  }
}
simulator.drainEvents().forEach(tell);

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
// @ts-expect-error slots do not change
body.slot = 1;
// @ts-expect-error settings have names
simulator.createCircleGeom(body, 10, { friction: 0.5 });
// @ts-expect-error write-only properties cannot be read
const motor: { speed: number; greatestEffort: number } = joint.motor as string;

export { geom, motor, stands };
