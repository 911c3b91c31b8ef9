// A figure of limbs on hinges with limits and brakes; a servo holds an arm at an angle.

import { Simulator, initialize } from '../index.js';

await initialize();
const world = new Simulator({ gravity: { x: 0, y: 900 } });
world.addBody({ type: 'fixed', position: { x: 0, y: 40 } }, [{ rectangle: { width: 800, height: 40 } }]);
const limb = (height) => ({ capsule: { height, endRadius: 6 }, group: 1 }); // parts of one group do not collide
const torso = world.addBody({ position: { x: 0, y: -60 } }, [limb(60)]).body;
const limbs = [
  [24, { x: 0, y: -104 }, { x: 0, y: -92 }], // head: height, place, joint
  [44, { x: -6, y: -66 }, { x: -6, y: -84 }], // arms
  [44, { x: 6, y: -66 }, { x: 6, y: -84 }],
  [56, { x: -6, y: -8 }, { x: -6, y: -32 }], // legs
  [56, { x: 6, y: -8 }, { x: 6, y: -32 }],
];
const joints = limbs.map(([height, position, anchor]) => {
  const { body } = world.addBody({ position }, [limb(height)]);
  const options = { limits: { lower: -1.5, upper: 1.5 }, motor: { speed: 0, greatestEffort: 5e3 } };
  return world.createRevoluteJoint(torso, body, anchor, options);
});
joints[2].motor = null;
joints[2].servo = { target: -1, stiffness: 1e5, damping: 1e4 };
for (let step = 0; step < 180; step++) world.step(1 / 60);
console.log(`the arm is at ${joints[2].travel.toFixed(1)} rad`);
