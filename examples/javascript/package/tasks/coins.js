// A sensor tells once that somebody is in it. Hits have the speed for the volume of a sound.

import { Simulator, initialize } from '../index.js';

await initialize();
const world = new Simulator({ gravity: { x: 0, y: 900 } });
world.addBody({ type: 'fixed', position: { x: 0, y: 20 } }, [{ rectangle: { width: 2000, height: 40 }, restitution: 0.5 }]);
world.addBody({ type: 'fixed', position: { x: 0, y: -150 } }, [{ circle: { radius: 10 }, sensor: true, userData: 'coin' }]);
world.addBody({ position: { x: 0, y: -300 } }, [{ circle: { radius: 12 }, restitution: 0.5, events: ['sensor', 'hit'] }]);
let coins = 0;
const volumes = [];
for (let step = 0; step < 180; step++) {
  world.step(1 / 60);
  for (const event of world.drainEvents()) {
    if (event.type === 'sensorBegin' && event.sensor.userData === 'coin') coins += 1;
    if (event.type === 'hit') volumes.push(event.speed / 1000);
  }
}
console.log(`${coins} coin, sounds: ${volumes.map((volume) => volume.toFixed(2)).join(' ')}`);
