// A platform that the game moves to and fro carries a character, who jumps from it.

import { CharacterMover, Simulator, initialize } from '../index.js';

await initialize();
const world = new Simulator({ gravity: { x: 0, y: 900 } });
world.addBody({ type: 'fixed', position: { x: 0, y: 20 } }, [{ rectangle: { width: 2000, height: 40 } }]);
const shape = { rectangle: { width: 120, height: 16 } };
const platform = world.addBody({ type: 'kinematic', position: { x: 0, y: -100 } }, [shape]).body;
const hero = new CharacterMover(world, { capsule: { height: 60, endRadius: 12 } }, { x: 0, y: -140 });
let jumps = 0;
for (let step = 0; step < 480; step++) {
  platform.linearVelocity = { x: step % 240 < 120 ? 80 : -80, y: 0 };
  world.step(1 / 60);
  const { jumped, crushedBy } = hero.update({ jump: step % 100 === 99 }, 1 / 60);
  jumps += jumped;
  if (crushedBy !== null) console.log('a life less');
}
const isAboard = hero.isGrounded && Math.abs(hero.position.x - platform.position.x) < 60;
console.log(`${jumps} jumps, ${isAboard ? 'and aboard' : 'and lost'}`);
