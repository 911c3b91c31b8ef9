// A hundred crates on a floor. Density, mass, moment of inertia and friction have defaults; the pile falls asleep.

import { Simulator, initialize } from '../index.js';

await initialize();
const world = new Simulator({ gravity: { x: 0, y: 900 } });
world.addBody({ type: 'fixed', position: { x: 0, y: 20 } }, [{ rectangle: { width: 2000, height: 40 } }]);
const crates = Array.from({ length: 100 }, (_, at) => {
  const position = { x: 40 * (at % 10) - 180, y: -16 - 32 * Math.floor(at / 10) };
  return world.addBody({ position }, [{ rectangle: { width: 32, height: 32 } }]).body;
});
for (let step = 0; step < 300; step++) world.step(1 / 60);
console.log(`${crates.filter((crate) => crate.isAsleep).length} of ${crates.length} crates sleep`);
