// The scenes of `src/bin/javascript_scenes.rs`, word for word; each is made with the exports of an entry of the package.

export const STEPS = 600;
export const DT = Math.fround(1 / 60);

/** FNV-1a, word by word. */
export class Hash {
  value = 0x811c9dc5;

  words(words) {
    for (const word of words) this.value = Math.imul(this.value ^ word, 0x01000193) >>> 0;
  }
}

function floor(simulator) {
  const body = simulator.createRectangleBody(800, 40, 1, { isStatic: true, position: { x: 0, y: 220 } });
  simulator.createRectangleGeom(body, 800, 40, { frictionCoefficient: 0.5 });
  return body;
}

function pile({ Simulator }, methods) {
  const simulator = new Simulator({ gravity: { x: 0, y: 300 }, methods });
  floor(simulator);
  const surface = { frictionCoefficient: 0.4, restitutionCoefficient: 0.2 };
  for (let number = 0; number < 60; number++) {
    const [column, row] = [number % 10, Math.floor(number / 10)];
    const settings = {
      position: { x: column * 31 - 140 + row * 3, y: 150 - row * 40 },
      rotation: Math.fround(Math.fround(0.1) * number),
    };
    // The outline is placed before the body is: under the distance grid its cells follow from how it lies then.
    if (number % 4 === 0) {
      const body = simulator.createRectangleBody(24, 16, 2);
      simulator.createRectangleGeom(body, 24, 16, surface);
      Object.assign(body, settings);
    } else if (number % 4 === 1) {
      const body = simulator.createCircleBody(9, 1);
      simulator.createCircleGeom(body, 9, surface);
      Object.assign(body, settings);
    } else if (number % 4 === 2) {
      const corners = [{ x: -12, y: 8 }, { x: 12, y: 8 }, { x: 0, y: -14 }];
      const body = simulator.createPolygonBody(corners, 1.5);
      simulator.createPolygonGeom(body, corners, surface);
      Object.assign(body, settings);
    } else {
      const body = simulator.createCapsuleBody(30, 7, 1.25);
      simulator.createCapsuleGeom(body, 30, 7, surface);
      Object.assign(body, settings);
    }
  }
  return { simulator };
}

function machines({ Simulator }) {
  const simulator = new Simulator({ gravity: { x: 0, y: 300 } });
  const ground = floor(simulator);
  const bodies = [];
  for (let column = 0; column < 10; column++) {
    for (let row = 0; row < 2; row++) {
      const body = simulator.createRectangleBody(20, 20, 1, { position: { x: column * 70 - 315, y: row * 30 } });
      simulator.createRectangleGeom(body, 20, 20);
      bodies.push(body);
    }
  }
  const zero = { x: 0, y: 0 };
  const motor = { speed: 3, greatestEffort: 100000 };
  simulator.createFixedRevoluteJoint(bodies[0], { x: -315, y: -20 }, { motor });
  simulator.createRevoluteJoint(bodies[0], bodies[1], { x: -315, y: 15 });
  simulator.createPinJoint(bodies[2], zero, bodies[3], { x: 5, y: 0 });
  simulator.createSliderJoint(bodies[4], zero, bodies[5], zero, 20, 45);
  simulator.createWeldJoint(bodies[6], bodies[7], { x: -105, y: 15 });
  const limits = { lower: -10, upper: 60 };
  simulator.createPrismaticJoint(ground, bodies[8], { x: -35, y: 0 }, { x: 1, y: 0.5 }, { limits });
  simulator.createAngleJoint(bodies[10], bodies[11]);
  simulator.createAngleLimitJoint(bodies[12], bodies[13], -0.5, 0.5);
  simulator.createFixedLinearSpring(bodies[14], { x: 10, y: 0 }, { x: 175, y: -120 }, 20, 0.5);
  simulator.createLinearSpring(bodies[14], zero, bodies[15], zero, 15, 0.2);
  simulator.createAngleSpring(bodies[16], bodies[17], 500, 5);
  const hanging = simulator.createFixedRevoluteJoint(bodies[18], { x: 315, y: -40 }, { greatestForce: 1000 });
  simulator.createFixedAngleJoint(bodies[19]);
  bodies[3].applyImpulse({ x: 150, y: -20 });
  bodies[16].angularVelocity = 4;
  return { simulator, hanging };
}

function street({ DepthSimulator }) {
  const simulator = new DepthSimulator({ height: 480, angle: 60, gravity: { x: 0, y: 900 } });
  simulator.spawnLane({ left: 0, right: 800, front: 0, back: 160, height: 1000 });
  simulator.createPlatform({ width: 120, height: 30, depth: 160 }, { x: 400, y: 15, z: 80 });
  simulator.createPlatform({ width: 120, height: 20, depth: 90 }, { x: 600, y: 20, z: 80 }, { rotation: 0.3 });
  const size = { width: 30, height: 60, depth: 20 };
  const figure = simulator.spawnFigure(size, { position3d: { x: 40, y: 0, z: 80 }, walk: { jumpHeight: 80 } });
  for (let number = 0; number < 12; number++) {
    const position3d = { x: 60 * number + 80, y: 40, z: 12 * number + 15 };
    if (number % 2 === 0) {
      simulator.spawnPrism({ width: 26, height: 26, depth: 26 }, { mass: 4, position3d });
    } else {
      simulator.spawnBall(12, { mass: 2, restitutionCoefficient: 0.5, position3d });
    }
  }
  const act = (step) => {
    const wish = { x: step < 400 ? 120 : -90, z: step % 200 < 100 ? 30 : -30, jump: step % 90 === 60 };
    simulator.walk(figure.body, wish, DT);
  };
  return { simulator, figure, act };
}

export const SCENES = {
  pile: (engine) => pile(engine, 'precise'),
  'faithful pile': (engine) => pile(engine, 'faithful'),
  machines,
  street,
};

/** Plays steps of a scene; a hash of all positions. */
export function play({ simulator, act }, from = 0, to = STEPS) {
  const motion = new Hash();
  for (let step = from; step < to; step++) {
    act?.(step);
    simulator.step(DT);
    const { buffer, byteOffset, length } = simulator.positions;
    motion.words(new Uint32Array(buffer, byteOffset, length));
  }
  return motion.value;
}
