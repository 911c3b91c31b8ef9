// A character that walks, jumps and falls.

import { bytes, call, leaveBytes, list, vector } from './module.js';
import { Body } from './objects.js';
import { geomNumbers, leave, moverNumbers, pointNumbers } from './options.js';

const registry = new FinalizationRegistry(([simulator, mover]) => {
  try {
    call('mover_dispose', simulator.handle, mover);
  } catch {
    // The simulator was freed before.
  }
});
const SIDES = ['ground', 'left', 'right', 'ceiling'];

export class CharacterMover {
  #simulator;
  #id;
  #body = null;

  constructor(simulator, shape, position, options = {}) {
    leave([...pointNumbers(position), ...moverNumbers(options), ...geomNumbers(shape)]);
    this.#simulator = simulator;
    this.#id = call('mover_new', simulator.handle);
    // The simulator, not its number: after `free` that belongs to the next one.
    registry.register(this, [simulator, this.#id], this);
  }

  set options(options) {
    leave(moverNumbers(options));
    call('mover_set_options', this.#simulator.handle, this.#id);
  }

  update({ x = 0, jump = false, drop = false }, dt) {
    const numbers = list('mover_update', this.#simulator.handle, this.#id, x, jump, drop, dt);
    const report = { jumped: numbers[21] === 1, landed: numbers[22] === 1, landingSpeed: numbers[23] };
    SIDES.forEach((side, at) => {
      const [geom, x, y, normalX, normalY] = numbers.slice(5 * at, 5 * at + 5);
      report[side] = Number.isNaN(geom)
        ? null
        : { geom: this.#simulator.geomOf(geom), point: { x, y }, normal: { x: normalX, y: normalY } };
    });
    report.crushedBy = Number.isNaN(numbers[20]) ? null : this.#simulator.bodyOf(numbers[20]);
    return report;
  }

  get position() {
    return vector('mover_position', this.#simulator.handle, this.#id);
  }

  set position({ x, y }) {
    call('mover_set_position', this.#simulator.handle, this.#id, x, y);
  }

  get velocity() {
    return vector('mover_velocity', this.#simulator.handle, this.#id);
  }

  launch({ x, y }) {
    call('mover_launch', this.#simulator.handle, this.#id, x, y);
  }

  get isGrounded() {
    return call('mover_is_grounded', this.#simulator.handle, this.#id) === 1;
  }

  get body() {
    return this.#body;
  }

  set body(body) {
    if (body === null) call('mover_remove_body', this.#simulator.handle, this.#id);
    else call('mover_set_body', this.#simulator.handle, this.#id, this.#simulator.idOf(body, Body));
    this.#body = body;
  }

  get state() {
    return bytes('mover_state', this.#simulator.handle, this.#id);
  }

  set state(state) {
    leaveBytes(state);
    call('mover_set_state', this.#simulator.handle, this.#id);
  }

  dispose() {
    registry.unregister(this);
    call('mover_dispose', this.#simulator.handle, this.#id);
    // The number goes to the next mover.
    this.#id = 2 ** 32 - 1;
  }
}
