// A character jumps through one-way ledges from below, stands on them, and drops through.

import { CharacterMover, Simulator, initialize } from '../index.js';

await initialize();
const world = new Simulator({ gravity: { x: 0, y: 900 } });
world.addBody({ type: 'fixed' }, [{ chain: [{ x: -500, y: 0 }, { x: 200, y: 0 }, { x: 500, y: -80 }] }]);
for (const floor of [1, 2, 3]) {
  const ledge = { rectangle: { width: 200, height: 10 }, oneWay: { x: 0, y: -1 } };
  world.addBody({ type: 'fixed', position: { x: 0, y: 5 - 50 * floor } }, [ledge]);
}
const hero = new CharacterMover(world, { rectangle: { width: 24, height: 60 } }, { x: 0, y: -31 });
const play = (input, steps) => {
  for (let step = 0; step < steps; step++) {
    world.step(1 / 60);
    hero.update(input, 1 / 60);
  }
  return Math.round(-(hero.position.y + 30)); // height of the soles
};
const heights = [1, 2, 3].map(() => (play({ jump: true }, 50), play({}, 10)));
play({ drop: true }, 1);
console.log(`heights ${heights.join(' ')}, then ${play({}, 40)}`);
