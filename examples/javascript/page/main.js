// Loads the module, and plays both scenes at 60 steps per second, for any frame rate.

import { initialize } from '../package/index.js';
import { Pile } from './pile.js';
import { Street } from './street.js';

const DT = 1 / 60;
/** Greatest number of steps per frame: the time of a hidden tab is skipped. */
const MOST_STEPS = 5;

await initialize();
const scenes = [
  new Pile(document.querySelector('#pile'), document.querySelector('#pile-says')),
  new Street(document.querySelector('#street')),
];

let last = performance.now();
let due = 0;
function frame(now) {
  due = Math.min(due + (now - last) / 1000, MOST_STEPS * DT);
  last = now;
  for (; due >= DT; due -= DT) scenes.forEach((scene) => scene.step(DT));
  scenes.forEach((scene) => scene.draw());
  requestAnimationFrame(frame);
}
requestAnimationFrame(frame);
