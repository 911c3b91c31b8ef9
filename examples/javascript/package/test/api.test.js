// Behaviour of the classes: events, errors, ids, memory.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { DepthSimulator, PhysicsError, Simulator, initialize } from '../index.js';

test('nothing works before the module is there, and the message says what to do', () => {
  assert.throws(() => new Simulator(), { name: 'PhysicsError', message: /initialize/ });
});

test('a module that is not there is refused, and may be tried again', async () => {
  await assert.rejects(initialize(new URL('nothing.wasm', import.meta.url)));
  await initialize();
  await initialize();
});

const DT = 1 / 60;
const steps = (simulator, count) => {
  for (let step = 0; step < count; step++) simulator.step(DT);
};

function ballOverFloor(options = {}) {
  const simulator = new Simulator({ gravity: { x: 0, y: 300 }, ...options });
  const ground = simulator.createRectangleBody(400, 20, 1, { isStatic: true, position: { x: 0, y: 100 } });
  const floor = simulator.createRectangleGeom(ground, 400, 20);
  const body = simulator.createCircleBody(10, 1, { position: { x: 0, y: 0 } });
  const ball = simulator.createCircleGeom(body, 10);
  return { simulator, ground, floor, body, ball };
}

for (const methods of ['precise', 'faithful']) {
  test(`${methods}: a touch begins once, ends once, and names the very handles of the game`, () => {
    const { simulator, floor, body, ball } = ballOverFloor({ methods });
    steps(simulator, 120);
    const [begin, ...more] = simulator.drainEvents();
    assert.deepEqual(more, []);
    assert.equal(begin.type, 'touchBegin');
    assert.ok(begin.geom === floor && begin.partner === ball);
    assert.ok(Math.abs(body.position.y - 80) < 0.2);

    body.applyImpulse({ x: 0, y: -200 });
    steps(simulator, 20);
    const ends = simulator.drainEvents();
    assert.deepEqual(ends.map((event) => event.type), ['touchEnd']);
    assert.deepEqual(simulator.drainEvents(), []);
  });

  test(`${methods}: a touch ends with the life of what touches, and with its taking part`, () => {
    for (const part of [(body) => body.dispose(), (body) => (body.enabled = false)]) {
      const { simulator, body } = ballOverFloor({ methods });
      steps(simulator, 120);
      assert.equal(simulator.drainEvents().length, 1);
      part(body);
      steps(simulator, 3);
      assert.deepEqual(simulator.drainEvents().map((event) => event.type), ['touchEnd']);
    }
  });

  test(`${methods}: what touches when it is restored is no news, and its end is`, () => {
    const { simulator, body } = ballOverFloor({ methods });
    steps(simulator, 120);
    const snapshot = simulator.snapshot();
    const other = ballOverFloor({ methods });
    other.simulator.restore(snapshot);
    steps(other.simulator, 5);
    assert.deepEqual(other.simulator.drainEvents(), []);
    other.body.applyImpulse({ x: 0, y: -200 });
    steps(other.simulator, 20);
    assert.deepEqual(other.simulator.drainEvents().map((event) => event.type), ['touchEnd']);
    assert.ok(body.position.y > other.body.position.y);
  });
}

test('sensors tell of touches, push nothing, and list what is in them', () => {
  const { simulator, floor, ball, body } = ballOverFloor();
  floor.isSensor = true;
  steps(simulator, 50);
  assert.deepEqual(simulator.drainEvents().map((event) => event.type), ['touchBegin']);
  assert.deepEqual(floor.overlaps(), [ball]);
  assert.ok(body.position.y > 85);
});

test('categories and groups keep things apart', () => {
  for (const part of [
    ({ ball, floor }) => {
      ball.collisionCategories = 2;
      ball.collidesWith = 2;
      floor.collisionCategories = 1;
      floor.collidesWith = 1;
    },
    ({ ball, floor }) => {
      ball.collisionGroup = 7;
      floor.collisionGroup = 7;
    },
    ({ ball, floor }) => ball.ignoreCollisionWith(floor),
  ]) {
    const scene = ballOverFloor();
    part(scene);
    steps(scene.simulator, 120);
    assert.deepEqual(scene.simulator.drainEvents(), []);
    assert.ok(scene.body.position.y > 150);
  }
});

test('a joint that had to hold too much breaks, and an event tells which', () => {
  const { simulator, body } = ballOverFloor();
  const joint = simulator.createFixedRevoluteJoint(body, { x: 30, y: 0 }, { greatestForce: 50 });
  steps(simulator, 60);
  const broken = simulator.drainEvents().find((event) => event.type === 'jointBroke');
  assert.equal(broken.joint, joint);
  assert.equal(joint.enabled, false);
});

test('a motor turns within its limits', () => {
  const simulator = new Simulator();
  const body = simulator.createRectangleBody(40, 10, 1);
  const motor = { speed: 2, greatestEffort: 1e6 };
  const joint = simulator.createFixedRevoluteJoint(body, { x: 0, y: 0 }, { motor });
  steps(simulator, 30);
  assert.ok(Math.abs(joint.travel - 1) < 0.05, `${joint.travel}`);
  joint.limits = { lower: -0.5, upper: 1.25 };
  steps(simulator, 120);
  assert.ok(Math.abs(joint.travel - 1.25) < 0.01, `${joint.travel}`);
});

test('a spring drags a body to the point that it is told', () => {
  const simulator = new Simulator();
  const body = simulator.createCircleBody(10, 1);
  const spring = simulator.createFixedLinearSpring(body, { x: 0, y: 0 }, { x: 0, y: 0 }, 50, 10);
  spring.worldAttachPoint = { x: 60, y: -20 };
  steps(simulator, 300);
  assert.ok(Math.hypot(body.position.x - 60, body.position.y + 20) < 0.5);
});

test('rays and points find what is there, and pass through other categories', () => {
  const { simulator, floor, ball } = ballOverFloor();
  simulator.step(DT);
  const [start, end] = [{ x: 0, y: -100 }, { x: 0, y: 200 }];
  const hit = simulator.rayCast(start, end);
  assert.equal(hit.geom, ball);
  assert.ok(Math.abs(hit.point.y + 10) < 0.2 && hit.normal.y < -0.9);
  assert.ok(Math.abs(hit.fraction - 0.3) < 0.001);
  floor.collisionCategories = 4;
  ball.collisionCategories = 1;
  assert.equal(simulator.rayCast(start, end, { categories: 4 }).geom, floor);
  assert.equal(simulator.rayCast(start, { x: 300, y: -100 }), null);
  assert.deepEqual(simulator.collideAll({ x: 0, y: 0 }), [ball]);
  assert.deepEqual(simulator.collideAll({ x: 150, y: 0 }), []);
  assert.deepEqual(simulator.queryAabb({ x: -5, y: 95 }, { x: 5, y: 105 }), [floor]);
});

test('bad arguments are exceptions in the words of the engine, and change nothing', () => {
  const { simulator, body, ball } = ballOverFloor();
  const before = simulator.snapshot();
  const refused = [
    [() => simulator.createCircleBody(-1, 1), /radius is -1.*greater than 0/],
    [() => simulator.createRectangleBody(10, NaN, 1), /height is NaN.*finite/],
    [() => simulator.createCircleBody(1), /mass is NaN/],
    [() => (body.position = { x: 1 }), /y is NaN/],
    [() => (body.mass = 0), /mass is 0/],
    [() => (body.isStatic = 3), /value is 3.*true or false/],
    [() => (ball.frictionCoefficient = 1e300), /friction_coefficient/],
    [() => (ball.collisionGroup = 0.5), /collision_group is 0.5.*whole/],
    [() => body.applyForce({ x: Infinity, y: 0 }), /x is inf/],
    [() => simulator.step(0), /dt is 0.*greater than 0/],
    [() => simulator.step(NaN), /dt is NaN/],
    [() => simulator.createPolygonBody([{ x: 0, y: 0 }], 1), /vertices/],
    [() => simulator.createPolygonBody([{ x: 0, y: 0 }, { x: 1 }, { x: 0, y: 1 }], 1), /points is NaN/],
    [() => (simulator.gravity = { x: NaN, y: 0 }), /x is NaN/],
    [() => body.moveTo({ x: 0, y: 0 }, 0), /kinematic/],
  ];
  for (const [call, message] of refused) assert.throws(call, { name: 'PhysicsError', message });
  assert.deepEqual(simulator.snapshot(), before);
});

test('what belongs to nobody or to somebody else is refused', () => {
  const { simulator } = ballOverFloor();
  const { body } = ballOverFloor();
  assert.throws(() => simulator.createCircleGeom(body, 5), { name: 'TypeError', message: /another simulator/ });
  assert.throws(() => simulator.createCircleGeom({ id: 0 }, 5), { name: 'TypeError', message: /Body is needed/ });
  assert.throws(() => new Simulator({ methods: 'exact' }), TypeError);
  assert.throws(() => new Simulator({ gravitation: 1 }), { name: 'TypeError', message: /gravitation/ });
  assert.throws(() => simulator.createCircleBody(5, 1, { colour: 1 }), { name: 'TypeError', message: /colour/ });
});

test('what was made with settings that are refused goes again', () => {
  const simulator = new Simulator();
  const refused = [{ mass: 0 }, { rotation: NaN }, { colour: 1 }];
  for (const options of refused) assert.throws(() => simulator.createCircleBody(10, 1, options));
  simulator.step(DT);
  assert.equal(simulator.positions.length, 0);
});

test('handles of what is gone are noticed, also when its slot is used again', () => {
  const { simulator, body, ball } = ballOverFloor();
  steps(simulator, 2);
  assert.equal(ball.body, body);
  body.dispose();
  assert.ok(body.isDisposed && ball.isDisposed);
  simulator.step(DT);
  const other = simulator.createCircleBody(10, 1);
  assert.equal(other.slot, body.slot);
  assert.throws(() => body.position, { name: 'PhysicsError', message: /stale/ });
  assert.throws(() => (ball.isSensor = true), { name: 'PhysicsError', message: /stale/ });
});

test('handles of what is not in a restored simulator are disposed, the others are good', () => {
  const { simulator, body } = ballOverFloor();
  body.userData = 'ball';
  simulator.step(DT);
  const snapshot = simulator.snapshot();
  const late = simulator.createCircleBody(10, 1);
  const { slot } = late;
  simulator.restore(snapshot);
  assert.ok(late.isDisposed && !body.isDisposed);
  assert.throws(() => late.position, PhysicsError);
  const next = simulator.createCircleBody(10, 1);
  assert.notEqual(next, late);
  assert.equal(next.slot, slot);
  assert.ok(late.isDisposed && !next.isDisposed);
  assert.equal(simulator.collideAll(body.position)[0].body.userData, 'ball');
});

test('bytes that are no snapshot are refused, and the simulator goes on', () => {
  const { simulator, body } = ballOverFloor();
  steps(simulator, 10);
  const snapshot = simulator.snapshot();
  const altered = snapshot.slice();
  altered[40] ^= 1;
  const depth = new DepthSimulator({ height: 480 }).snapshot();
  for (const bytes of [new Uint8Array(0), snapshot.slice(0, 100), altered, depth]) {
    assert.throws(() => simulator.restore(bytes), { name: 'PhysicsError', message: /damaged/ });
  }
  assert.throws(() => simulator.restore('text'), TypeError);
  assert.deepEqual(simulator.snapshot(), snapshot);
  assert.ok(body.position.y > 0);
});

test('positions are a view of memory in rows of slots, and survive its growth', () => {
  const simulator = new Simulator({ gravity: { x: 0, y: 300 } });
  const first = simulator.createCircleBody(1, 1, { position: { x: 5, y: 6 } });
  const small = simulator.positions;
  assert.deepEqual([...small], [5, 6, 0]);
  const { byteLength } = small.buffer;
  const bodies = [first];
  for (let number = 1; number < 20_000; number++) {
    bodies.push(simulator.createCircleBody(1, 1, { position: { x: number, y: -number } }));
  }
  const grown = simulator.positions;
  assert.ok(grown.buffer.byteLength > byteLength, 'memory has grown');
  assert.equal(grown.length, 60_000);
  for (const body of [bodies[0], bodies[1234], bodies[19_999]]) {
    const { x, y } = body.position;
    assert.deepEqual([...grown.subarray(3 * body.slot, 3 * body.slot + 2)], [x, y]);
  }
  assert.equal(simulator.positions, grown, 'nothing is made anew while memory stays where it is');
  bodies[1].dispose();
  simulator.step(DT);
  assert.ok(Number.isNaN(simulator.positions[3]));
});

test('a game that fires for hours uses the same slots again', () => {
  const simulator = new Simulator();
  for (let shot = 0; shot < 5000; shot++) {
    const bullet = simulator.createCircleBody(1, 1);
    simulator.createCircleGeom(bullet, 1);
    simulator.step(DT);
    bullet.dispose();
    assert.ok(bullet.slot < 2);
  }
  simulator.step(DT);
  assert.equal(simulator.positions.length, 0);
});

test('a simulator that was freed refuses every call', () => {
  const { simulator, body } = ballOverFloor();
  simulator.free();
  assert.throws(() => simulator.step(DT), { name: 'PhysicsError', message: /freed/ });
  assert.throws(() => body.position, { name: 'PhysicsError', message: /freed/ });
  assert.throws(() => simulator.free(), { name: 'PhysicsError', message: /freed/ });
});
