// The 2.5D engine.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { DepthSimulator, Simulator, initialize } from '../index.js';

await initialize();

const DT = 1 / 60;
const CRATE = { width: 30, height: 30, depth: 30 };
const FIGURE = { width: 30, height: 60, depth: 20 };
const steps = (simulator, count) => {
  for (let step = 0; step < count; step++) simulator.step(DT);
};
const street = () => new DepthSimulator({ height: 480, angle: 60, gravity: { x: 0, y: 900 } });

test('things fall on the ground and on platforms, and events tell on which', () => {
  const simulator = street();
  const platform = simulator.createPlatform({ width: 100, height: 40, depth: 60 }, { x: 200, y: 0, z: 80 });
  const high = simulator.spawnPrism(CRATE, { position3d: { x: 200, y: 100, z: 80 } });
  const low = simulator.spawnBall(10, { position3d: { x: 50, y: 50, z: 80 } });
  steps(simulator, 120);
  assert.ok(Math.abs(high.body.position3d.y - 40) < 0.1);
  assert.ok(Math.abs(low.body.position3d.y) < 0.1);
  assert.ok(high.body.isGrounded);
  assert.ok(Math.abs(high.body.heightBeneath - 40) < 0.1);
  const partners = new Map(simulator.drainEvents().map((event) => [event.geom, event.partner]));
  assert.equal(partners.get(high.geom), platform);
  assert.equal(partners.get(low.geom), 'ground');
  platform.dispose();
  assert.ok(platform.isDisposed);
  steps(simulator, 60);
  assert.ok(simulator.drainEvents().some((event) => event.type === 'touchEnd' && event.geom === high.geom));
  assert.ok(Math.abs(high.body.position3d.y) < 0.1);
});

test('a figure walks as fast as it is told, jumps as high, and does not cross the walls of its lane', () => {
  const simulator = street();
  simulator.spawnLane({ left: 0, right: 300, front: 0, back: 160, height: 1000 });
  const { body } = simulator.spawnFigure(FIGURE, { position3d: { x: 50, y: 0, z: 80 }, walk: { jumpHeight: 80 } });
  assert.equal(body.walkSettings.jumpHeight, 80);
  assert.equal(body.walkSettings.stepUp, 8);
  let highest = 0;
  for (let step = 0; step < 60; step++) {
    assert.equal(typeof simulator.walk(body, { x: 100, jump: step === 20 }, DT), 'boolean');
    simulator.step(DT);
    highest = Math.max(highest, body.position3d.y);
  }
  assert.ok(Math.abs(body.velocity3d.x - 100) < 1);
  assert.ok(Math.abs(highest - 80) < 2, `${highest}`);
  for (let step = 0; step < 240; step++) {
    simulator.walk(body, { x: 100 }, DT);
    simulator.step(DT);
  }
  // It is a cylinder, whose diameter is the mean of width and depth.
  assert.ok(Math.abs(body.position3d.x - 287.5) < 0.5, `${body.position3d.x}`);
});

test('a walk that is restored goes on, jump and all', () => {
  const simulator = street();
  const { body } = simulator.spawnFigure(FIGURE, { walk: { jumpHeight: 90 } });
  const run = () => {
    for (let step = 0; step < 40; step++) {
      simulator.walk(body, { x: 70, jump: step === 5 }, DT);
      simulator.step(DT);
    }
    return body.position3d;
  };
  run();
  const snapshot = simulator.snapshot();
  const once = run();
  simulator.restore(snapshot);
  assert.deepEqual(run(), once);
  assert.equal(body.walkSettings.jumpHeight, 90);
});

test('what is nearer is drawn later, and picked first', () => {
  const simulator = street();
  const back = simulator.spawnPrism(CRATE, { position3d: { x: 100, y: 0, z: 100 } });
  const front = simulator.spawnPrism(CRATE, { position3d: { x: 100, y: 0, z: 60 } });
  const platform = simulator.createPlatform(CRATE, { x: 300, y: 0, z: 80 });
  steps(simulator, 2);
  const order = simulator.drawOrder();
  assert.equal(order.length, 3);
  assert.ok(order.indexOf(back.body) < order.indexOf(front.body));
  assert.equal(simulator.pickFront(front.body.screenPosition), front.body);
  assert.equal(simulator.pickFront(simulator.toScreen({ x: 300, y: 15, z: 70 })), platform);
  assert.equal(simulator.pickFront({ x: 600, y: 10 }), null);
});

test('a point of the ground is where it appears', () => {
  const simulator = street();
  const ground = simulator.screenToGround(simulator.toScreen({ x: 40, y: 0, z: 90 }));
  assert.ok(Math.hypot(ground.x - 40, ground.y, ground.z - 90) < 0.01);
});

test('rays find geoms, platforms and the ground', () => {
  const simulator = street();
  const { geom } = simulator.spawnPrism(CRATE, { position3d: { x: 100, y: 0, z: 80 } });
  const platform = simulator.createPlatform(CRATE, { x: 200, y: 0, z: 80 });
  steps(simulator, 2);
  const down = (x) => simulator.rayCast3d({ x, y: 100, z: 80 }, { x, y: -10, z: 80 });
  assert.equal(down(100).partner, geom);
  assert.ok(Math.abs(down(100).point.y - 30) < 0.1);
  assert.equal(down(200).partner, platform);
  assert.equal(down(300).partner, 'ground');
  assert.deepEqual(down(300).normal, { x: 0, y: 1, z: 0 });
  assert.equal(simulator.rayCast3d({ x: 0, y: 100, z: 80 }, { x: 300, y: 100, z: 80 }), null);
});

test('lifts carry, belts carry, and one-way platforms are open from below', () => {
  const simulator = street();
  const lift = simulator.createPlatform({ width: 80, height: 10, depth: 80 }, { x: 100, y: 0, z: 80 });
  lift.velocity = { x: 0, y: 30, z: 0 };
  const lifted = simulator.spawnPrism(CRATE, { position3d: { x: 100, y: 10, z: 80 } });
  const surfaceSpeed = { along: 50, depth: 0 };
  const belt = simulator.createPlatform({ width: 400, height: 10, depth: 80 }, { x: 500, y: 0, z: 80 }, { surfaceSpeed });
  belt.setSurface({ frictionCoefficient: 0.8 });
  const carried = simulator.spawnPrism(CRATE, { position3d: { x: 400, y: 10, z: 80 } });
  const place = { x: 800, y: 75, z: 80 };
  simulator.createPlatform({ width: 100, height: 10, depth: 80 }, place, { isOneWay: true });
  const jumper = simulator.spawnPrism(CRATE, { position3d: { x: 800, y: 0, z: 80 } });
  jumper.body.velocity3d = { x: 0, y: 500, z: 0 };
  steps(simulator, 120);
  assert.ok(Math.abs(lifted.body.position3d.y - 70) < 1, `${lifted.body.position3d.y}`);
  assert.ok(carried.body.position3d.x > 470, `${carried.body.position3d.x}`);
  assert.ok(Math.abs(jumper.body.position3d.y - 85) < 0.1, `${jumper.body.position3d.y}`);
});

test('joints tie what has depth', () => {
  const simulator = street();
  const one = simulator.spawnPrism(CRATE, { position3d: { x: 100, y: 0, z: 80 }, frictionCoefficient: 0 });
  const other = simulator.spawnPrism(CRATE, { position3d: { x: 140, y: 0, z: 80 }, frictionCoefficient: 0 });
  simulator.createWeldJoint(one.body, other.body, { x: 120, y: -15 });
  one.body.velocity3d = { x: 0, y: 0, z: 60 };
  steps(simulator, 60);
  assert.ok(Math.abs(other.body.velocity3d.z - 30) < 0.5, `${other.body.velocity3d.z}`);
});

test('positions are rows of four', () => {
  const simulator = street();
  const { body } = simulator.spawnBall(10, { position3d: { x: 1, y: 2, z: 3 } });
  assert.deepEqual([...simulator.positions], [1, 2, 3, 0]);
  assert.equal(body.slot, 0);
});

test('what only one of the engines can do is refused by the other, in words', () => {
  const simulator = street();
  assert.throws(() => Simulator.prototype.queryAabb.call(simulator, { x: 0, y: 0 }, { x: 1, y: 1 }), /DepthSimulator/);
  const faithful = new DepthSimulator({ height: 480, methods: 'faithful' });
  assert.throws(() => faithful.spawnFigure(FIGURE), { name: 'PhysicsError', message: /no upright footprints/ });
  const { body } = faithful.spawnPrism(FIGURE, { isUpright: true });
  assert.throws(() => faithful.walk(body, { x: 1 }, DT), { name: 'PhysicsError', message: /no figures that walk/ });
  assert.throws(() => new DepthSimulator({ height: 0 }), { name: 'PhysicsError', message: /height/ });
});

test('what is no longer finite is told, whichever engine finds it, once', () => {
  const simulator = street();
  const [along, flat] = [0, 1].map((number) => simulator.spawnBall(10, { position3d: { x: 100 * number, y: 200, z: 80 } }).body);
  along.velocity3d = { x: 0, y: 0, z: 3e38 };
  along.applyImpulse3d({ x: 0, y: 0, z: 3e38 });
  flat.linearVelocity = { x: 3e38, y: 0 };
  flat.applyForce({ x: 3e38, y: 0 });
  flat.applyForce({ x: 3e37, y: 0 });
  steps(simulator, 2);
  const told = simulator.drainEvents().filter(({ type }) => type === 'notFinite').map(({ body }) => body);
  assert.deepEqual(new Set(told), new Set([along, flat]));
  assert.equal(told.length, 2);
  assert.ok([along, flat].every(({ enabled }) => !enabled));
});
