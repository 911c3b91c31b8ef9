// Times of steps: node bench.mjs [FOLDER...] with packages to compare, by turns; the one beside this file if none is named.
// Prints, for each scene and package, the least and the median time per step in microseconds over all rounds.

import { pathToFileURL } from 'node:url';
import { join, resolve } from 'node:path';

const ROUNDS = 15;
const STEPS = 60;
const DT = 1 / 60;

function floored(Simulator, methods) {
  const simulator = new Simulator({ gravity: { x: 0, y: 300 }, methods, isSleepEnabled: false });
  const floor = simulator.createRectangleBody(2000, 40, 1, { isStatic: true, position: { x: 0, y: 20 } });
  simulator.createRectangleGeom(floor, 2000, 40, { frictionCoefficient: 0.5 });
  return simulator;
}

/** A pile of 200 boxes. */
function pile({ Simulator }, methods) {
  const simulator = floored(Simulator, methods);
  for (let number = 0; number < 200; number++) {
    const [column, row] = [number % 20, Math.floor(number / 20)];
    const body = simulator.createRectangleBody(20, 20, 1);
    simulator.createRectangleGeom(body, 20, 20, { frictionCoefficient: 0.4 });
    body.position = { x: column * 24 - 240 + (row % 2) * 7, y: -12 - row * 26 };
  }
  return simulator;
}

/** A thousand crates and balls on a field, in depth. */
function field({ DepthSimulator }) {
  const simulator = new DepthSimulator({ height: 2000, gravity: { x: 0, y: 300 }, isSleepEnabled: false });
  for (let number = 0; number < 1000; number++) {
    const [x, y, z] = [number % 20, 1 + Math.floor(number / 400), Math.floor(number / 20) % 20];
    const position3d = { x: 30 * x + 5 * y, y: 40 * y, z: 30 * z + 4 * y };
    if (number % 2 === 0) simulator.spawnPrism({ width: 20, height: 20, depth: 20 }, { position3d });
    else simulator.spawnBall(10, { position3d });
  }
  return simulator;
}

const SCENES = {
  '200 boxes, precise': (engine) => pile(engine, 'precise'),
  '200 boxes, faithful': (engine) => pile(engine, 'faithful'),
  '1,000 objects in depth': (engine) => ('DepthSimulator' in engine ? field(engine) : undefined),
};

function microsecondsPerStep(simulator) {
  const start = performance.now();
  for (let step = 0; step < STEPS; step++) simulator.step(DT);
  return ((performance.now() - start) * 1000) / STEPS;
}

const folders = process.argv.length > 2 ? process.argv.slice(2) : [join(import.meta.dirname, 'package')];
const packages = [];
for (const folder of folders) {
  const engine = await import(pathToFileURL(join(resolve(folder), 'index.js')));
  await engine.initialize();
  packages.push({ folder, engine });
}
for (const [scene, make] of Object.entries(SCENES)) {
  const runs = packages.map(({ folder, engine }) => ({ folder, simulator: make(engine), times: [], snapshots: [] }));
  const compared = runs.filter(({ simulator }) => simulator !== undefined);
  // A scene at rest, whose code is compiled by then.
  for (const { simulator } of compared) for (let step = 0; step < 300; step++) simulator.step(DT);
  for (let round = 0; round < ROUNDS; round++) {
    for (const { simulator, times, snapshots } of compared) {
      times.push(microsecondsPerStep(simulator));
      const start = performance.now();
      simulator.restore(simulator.snapshot());
      snapshots.push((performance.now() - start) * 1000);
    }
  }
  for (const { folder, times, snapshots } of compared) {
    const [[least, median], [, going]] = [times, snapshots].map((list) => {
      list.sort((a, b) => a - b);
      return [list[0], list[list.length >> 1]];
    });
    const numbers = `${least.toFixed(0)} µs at least, ${median.toFixed(0)} µs median, ${going.toFixed(0)} µs to save and restore`;
    console.log(`${scene}: ${numbers}: ${folder}`);
  }
}
