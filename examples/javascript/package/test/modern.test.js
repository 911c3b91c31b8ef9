// Bodies by options, typed events, queries with filters, movers, joints, recordings: the face that the Rust crate has.

import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import { CharacterMover, FixedStepRunner, Recording, Simulator, initialize } from '../index.js';

const DT = 1 / 60;
const near = (actual, expected, tolerance = 1e-3) =>
  assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected} by ${tolerance}`);

before(() => initialize());

function world(gravity = 300) {
  const simulator = new Simulator({ gravity: { x: 0, y: gravity } });
  const { geoms } = simulator.addBody({ type: 'fixed', position: { x: 0, y: 110 } }, [{ rectangle: { width: 800, height: 20 } }]);
  return { simulator, floor: geoms[0] };
}

function steps(simulator, count) {
  for (let step = 0; step < count; step++) simulator.step(DT);
}

test('a body has the mass of its geoms, and the options that it is given', () => {
  const { simulator } = world();
  const data = { name: 'crate' };
  const { body, geoms } = simulator.addBody({ position: { x: 5, y: 0 }, linearVelocity: { x: 3, y: 0 }, bullet: true, userData: data }, [
    { rectangle: { width: 32, height: 32 }, userData: 'box' },
    { circle: { radius: 4 }, sensor: true, offset: { x: 40, y: 0 } },
  ]);
  assert.equal(body.mass, 1);
  assert.equal(body.isBullet, true);
  assert.equal(body.userData, data);
  assert.equal(geoms[0].userData, 'box');
  near(geoms[0].frictionCoefficient, 0.6, 1e-6);
  assert.equal(geoms[1].isSensor, true);
  assert.equal(body.isStatic, false, 'a sensor leaves its body as it is');
  const { body: heavy } = simulator.addBody({}, [{ circle: { radius: 10 }, density: 2 }]);
  near(heavy.mass, 2 * Math.PI * 100, 0.01);
  heavy.density = 1;
  near(heavy.mass, Math.PI * 100, 0.01);
});

test('options that are not possible are refused, by name, and add nothing', () => {
  const { simulator } = world();
  assert.throws(() => simulator.addBody({ positon: { x: 0, y: 0 } }), { name: 'TypeError', message: /positon/ });
  assert.throws(() => simulator.addBody({}, [{ circle: { radius: -1 } }]), { name: 'PhysicsError', message: /radius is -1/ });
  assert.throws(() => simulator.addBody({ rotation: NaN }, [{ circle: { radius: 1 } }]), { name: 'PhysicsError', message: /rotation/ });
  assert.throws(() => simulator.addBody({}, [{ friction: 1 }]), { name: 'TypeError', message: /rectangle/ });
  assert.throws(() => simulator.addBody({ type: 'solid' }), { name: 'TypeError', message: /dynamic/ });
  assert.throws(() => simulator.addBody({}, [{ circle: { radius: 1 }, events: ['bang'] }]), { name: 'TypeError' });
  simulator.step(DT);
  assert.equal(simulator.positions.length, 3, 'the floor alone');
});

test('touches, hits, sensors and sleep are events, each once', () => {
  const { simulator, floor } = world();
  simulator.hitSpeed = 50;
  const { geoms: gate } = simulator.addBody({ type: 'fixed', position: { x: 0, y: 40 } }, [{ rectangle: { width: 40, height: 10 }, sensor: true }]);
  const { body, geoms } = simulator.addBody({ position: { x: 0, y: 0 } }, [
    { rectangle: { width: 16, height: 16 }, events: ['touch', 'sensor', 'hit'] },
  ]);
  steps(simulator, 240);
  const events = simulator.drainEvents();
  const types = events.map(({ type }) => type);
  for (const type of ['sensorBegin', 'sensorEnd', 'touchBegin', 'hit', 'bodySlept']) {
    assert.equal(types.filter((other) => other === type).length, 1, `${type} among ${types}`);
  }
  const hit = events.find(({ type }) => type === 'hit');
  assert.ok([hit.geom, hit.partner].includes(floor));
  near(hit.speed, Math.sqrt(2 * 300 * 92), 10);
  const { sensor, visitor } = events.find(({ type }) => type === 'sensorBegin');
  assert.deepEqual([sensor, visitor], [gate[0], geoms[0]]);
  body.applyImpulse({ x: 0, y: -200 });
  steps(simulator, 2);
  assert.deepEqual(simulator.drainEvents().map(({ type }) => type).sort(), ['bodyWoke', 'touchEnd']);
});

test('a disposed geom ends its touches once, and a restore has no events', () => {
  const { simulator } = world();
  const { body } = simulator.addBody({ position: { x: 0, y: 90 }, sleepEvents: false }, [{ circle: { radius: 10 } }]);
  steps(simulator, 30);
  assert.deepEqual(simulator.drainEvents().map(({ type }) => type), ['touchBegin']);
  const snapshot = simulator.snapshot();
  simulator.restore(snapshot);
  steps(simulator, 5);
  assert.deepEqual(simulator.drainEvents(), []);
  body.dispose();
  steps(simulator, 2);
  assert.deepEqual(simulator.drainEvents().map(({ type }) => type), ['touchEnd']);
});

test('queries find geoms by filters', () => {
  const { simulator, floor } = world(0);
  const { body: hero, geoms: own } = simulator.addBody({}, [{ circle: { radius: 10 }, categories: 2 }]);
  const { geoms: wall } = simulator.addBody({ type: 'fixed', position: { x: 100, y: 0 } }, [{ circle: { radius: 20 } }]);
  const { geoms: coin } = simulator.addBody({ type: 'kinematic', position: { x: 60, y: 0 } }, [{ circle: { radius: 5 }, sensor: true }]);
  simulator.step(DT);
  const [start, end] = [{ x: -50, y: 0 }, { x: 150, y: 0 }];
  assert.equal(simulator.castRay(start, end).geom, own[0]);
  const hit = simulator.castRay(start, end, { excludeBody: hero });
  assert.equal(hit.geom, wall[0]);
  near(hit.point.x, 80);
  near(hit.normal.x, -1);
  assert.equal(simulator.castRay(start, end, { accepts: (geom) => geom === wall[0] }).geom, wall[0]);
  assert.deepEqual(simulator.castRayAll(start, end, { sensors: true }).map(({ geom }) => geom), [own[0], coin[0], wall[0]]);
  assert.equal(simulator.castRay(start, end, { dynamic: false, fixed: false }), null);
  assert.equal(simulator.castRay(start, end, { categories: 2, excludeGeom: own[0] }).geom, wall[0], 'all has category 2');
  assert.notEqual(simulator.castRayAny(start, end), null);
  const shape = { rectangle: { width: 20, height: 20 } };
  const cast = simulator.castShape(shape, { x: 0, y: 40 }, 0, { x: 0, y: 200 });
  assert.equal(cast.geom, floor);
  near(cast.fraction * 200, 50);
  assert.equal(simulator.castShapeAll(shape, { x: -50, y: 0 }, 0, { x: 200, y: 0 }).length, 2);
  assert.deepEqual(simulator.overlapShape({ circle: { radius: 15 } }, { x: 80, y: 0 }), [wall[0]]);
  assert.equal(simulator.overlapAny({ circle: { radius: 5 } }, { x: 0, y: -200 }), null);
  assert.deepEqual(simulator.geomsAt({ x: 100, y: 5 }), [wall[0]]);
  const nearest = simulator.nearestPoint({ x: 40, y: 0 }, 100, { excludeBody: hero });
  assert.equal(nearest.geom, wall[0]);
  near(nearest.distance, 40);
  assert.equal(simulator.nearestPoint({ x: 40, y: 0 }, 5), null);
  assert.throws(() => simulator.castRay(start, { x: NaN, y: 0 }), { name: 'PhysicsError' });
  assert.throws(() => simulator.castRay(start, end, { category: 2 }), { name: 'TypeError' });
});

test('a mover walks, jumps, is restored, and rides a body that follows it', () => {
  const { simulator, floor } = world(900);
  const mover = new CharacterMover(simulator, { capsule: { height: 60, endRadius: 12 } }, { x: 0, y: 60 }, { jumpHeight: 80 });
  const move = (input, count) => {
    let report;
    for (let step = 0; step < count; step++) {
      simulator.step(DT);
      report = mover.update(input, DT);
    }
    return report;
  };
  const report = move({ x: 150 }, 60);
  assert.equal(report.ground.geom, floor);
  near(mover.velocity.x, 150, 0.01);
  const state = mover.state;
  const snapshot = simulator.snapshot();
  const before = mover.position.y;
  let highest = before;
  for (let step = 0; step < 40; step++) {
    move({ x: 0, jump: true }, 1);
    highest = Math.min(highest, mover.position.y);
  }
  near(before - highest, 80, 2);
  const there = mover.position;
  simulator.restore(snapshot);
  mover.state = state;
  move({ x: 0, jump: true }, 40);
  assert.deepEqual(mover.position, there);
  mover.body = simulator.addBody({ type: 'kinematic' }, [{ capsule: { height: 60, endRadius: 12 } }]).body;
  move({}, 2);
  assert.deepEqual(mover.body.position, mover.position);
  mover.options = { jumpHeight: 10 };
  assert.throws(() => (mover.options = { hop: 1 }), { name: 'TypeError' });
  mover.dispose();
  // The next mover has the number of the disposed one.
  const next = new CharacterMover(simulator, { capsule: { height: 60, endRadius: 12 } }, { x: 200, y: 0 });
  assert.throws(() => mover.position, { name: 'PhysicsError', message: /disposed/ });
  near(next.position.x, 200);
});

test('a point without x or y is refused', () => {
  const { simulator } = world();
  for (const position of [[5, 3], { x: 5 }]) {
    assert.throws(() => simulator.addBody({ position }), { name: 'PhysicsError', message: /position/ });
  }
});

test('joints: wheel, servo, angle spring, motor joint, and joined bodies that pass through each other', () => {
  const { simulator } = world(300);
  const chassis = simulator.addBody({ position: { x: 0, y: 60 } }, [{ rectangle: { width: 80, height: 16 } }]).body;
  const wheels = [-30, 30].map((x) => {
    const wheel = simulator.addBody({ position: { x, y: 84 } }, [{ circle: { radius: 14 }, friction: 1 }]).body;
    simulator.createWheelJoint(chassis, wheel, { x, y: 84 }, { x: 0, y: 1 }, 400, 20, {
      motor: { speed: 8, greatestEffort: 1e6 },
      bodiesCollide: false,
    });
    return wheel;
  });
  steps(simulator, 120);
  near(wheels[0].angularVelocity, 8, 0.5);
  assert.ok(chassis.position.x > 50, `${chassis.position.x}`);

  const arm = simulator.addBody({ position: { x: 0, y: -100 }, gravityScale: 0 }, [{ rectangle: { width: 40, height: 10 } }]).body;
  const shoulder = simulator.createFixedRevoluteJoint(arm, { x: 0, y: -100 });
  const stiffness = arm.momentOfInertia * (4 * Math.PI) ** 2;
  shoulder.servo = { target: 1, stiffness, damping: 2 * Math.sqrt(stiffness * arm.momentOfInertia) };
  const [one, two] = [0, 60].map((x) => simulator.addBody({ position: { x, y: -200 }, gravityScale: 0 }, [{ circle: { radius: 10 } }]).body);
  simulator.createMotorJoint(one, two, { frequency: 4 }, { targetPose: { offset: { x: 40, y: 0 }, angle: 0 } });
  const [left, right] = [0, 60].map((x) => simulator.addBody({ position: { x, y: -300 }, gravityScale: 0 }, [{ circle: { radius: 10 } }]).body);
  left.angularVelocity = 1;
  simulator.createAngleSpringJoint(left, right, 1000, 100);
  steps(simulator, 240);
  near(shoulder.travel, 1, 0.01);
  near(two.position.x - one.position.x, 40, 0.5);
  near(left.totalRotation, right.totalRotation, 0.01);
  shoulder.servo = null;
});

test('explosions, radial forces, the largest speed, sleep and contacts', () => {
  const { simulator, floor } = world(300);
  const { body } = simulator.addBody({ position: { x: 60, y: 84 } }, [{ rectangle: { width: 32, height: 32 } }]);
  steps(simulator, 60);
  const contacts = body.contacts();
  assert.ok(contacts.length === 2 && contacts.every(({ other, normal }) => other === floor && normal.y < -0.9));
  body.sleep();
  simulator.step(DT);
  assert.equal(body.isAsleep, true);
  simulator.largestSpeed = 100;
  assert.equal(simulator.explode({ position: { x: 0, y: 84 }, radius: 100, strength: 50 }), 1);
  simulator.step(DT);
  near(Math.hypot(body.linearVelocity.x, body.linearVelocity.y), 100, 5);
  simulator.largestSpeed = null;
  assert.equal(simulator.applyRadialForce({ position: { x: 0, y: 0 }, strength: 1, filter: { dynamic: false } }), 0);
});

test('a snapshot without geoms is smaller and goes on with the same bits', () => {
  const { simulator } = world();
  for (let at = 0; at < 40; at++) {
    simulator.addBody({ position: { x: (at % 8) * 20, y: -20 * at } }, [at % 2 ? { circle: { radius: 8 } } : { rectangle: { width: 16, height: 14 } }]);
  }
  steps(simulator, 100);
  const [moving, whole] = [simulator.snapshotMoving(), simulator.snapshot()];
  assert.ok(moving.length < 0.8 * whole.length, `${moving.length} of ${whole.length} bytes`);
  steps(simulator, 50);
  const hash = simulator.stateHash();
  for (const restore of [() => simulator.restoreMoving(moving), () => simulator.restore(whole)]) {
    restore();
    assert.notEqual(simulator.stateHash(), hash);
    steps(simulator, 50);
    assert.equal(simulator.stateHash(), hash);
  }
  simulator.addBody({}, [{ circle: { radius: 1 } }]);
  assert.throws(() => simulator.restoreMoving(moving), { name: 'PhysicsError', message: /other geoms/ });
});

test('a runner makes fixed steps, with poses between them', () => {
  const simulator = new Simulator();
  const { body } = simulator.addBody({ linearVelocity: { x: 60, y: 0 }, angularVelocity: -60 * 0.2 }, [{ circle: { radius: 5 } }]);
  const runner = new FixedStepRunner(simulator, { updatesPerSecond: 60 });
  assert.equal(runner.pose(body), null);
  assert.equal(runner.advance(2 / 60), 2);
  assert.equal(runner.advance(0.5 / 60), 0);
  near(runner.interpolation, 0.5, 1e-6);
  near(runner.pose(body).position.x, 1.5, 1e-3);
  near(Math.cos(runner.pose(body).rotation), Math.cos(-0.3), 1e-3);
  assert.equal(runner.advance(10), 5, 'the rest is dropped');
  body.position = { x: 500, y: 0 };
  runner.markTeleport(body);
  runner.advance(1 / 60);
  near(runner.pose(body).position.x, 501, 0.01);
  runner.reset();
  assert.equal(runner.pose(body), null);
  assert.throws(() => runner.advance(NaN), { name: 'RangeError' });
});

test('a recording is replayed with the same bits, and says where runs part', () => {
  const record = (pushAt) => {
    const { simulator } = world();
    const { body } = simulator.addBody({}, [{ rectangle: { width: 16, height: 16 } }]);
    const recording = new Recording(simulator, 30);
    const play = (played, [push = 0], dt) => {
      if (push > 0) played.bodyOf(body.id).applyImpulse({ x: push, y: 0 });
      played.step(dt);
    };
    for (let step = 0; step < 100; step++) {
      const input = step === pushAt ? new Uint8Array([20]) : new Uint8Array();
      play(simulator, input, DT);
      recording.record(simulator, DT, input);
    }
    return { simulator, recording, play, end: simulator.stateHash(), body };
  };
  const { simulator, recording, play, end } = record(40);
  const file = recording.toBytes();
  const loaded = Recording.fromBytes(file);
  assert.equal(loaded.length, 100);
  assert.equal(loaded.keyframeInterval, 30);
  assert.deepEqual([...loaded.input(40)], [20]);
  assert.equal(loaded.firstDivergence(simulator, play), null);
  loaded.restore(simulator, 100, play);
  assert.equal(simulator.stateHash(), end);
  assert.equal(loaded.firstDivergence(simulator, (played, _, dt) => played.step(dt)), 40);
  assert.throws(() => loaded.restore(simulator, 55, (played, _, dt) => played.step(dt)), { name: 'PhysicsError', message: /other bits/ });
  assert.equal(loaded.firstDifference(record(40).recording), null);
  assert.equal(loaded.firstDifference(record(70).recording), 40);
  assert.throws(() => loaded.restore(simulator, 101, play), { name: 'PhysicsError' });
  assert.throws(() => Recording.fromBytes(file.subarray(0, 50)), { name: 'PhysicsError' });
  recording.free();
  assert.throws(() => recording.length, { name: 'PhysicsError', message: /freed/ });
});
