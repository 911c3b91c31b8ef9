// Recordings of runs in one file, to be replayed and compared.

import { PhysicsError, bytes, call, hash, leaveBytes } from './module.js';

const registry = new FinalizationRegistry((handle) => call('recording_free', handle));
const NO_INPUT = new Uint8Array();
const FILE = Symbol('file');

export class Recording {
  #handle;

  constructor(simulator, keyframeInterval = 60) {
    if (simulator === FILE) this.#handle = call('recording_from_bytes');
    else this.#handle = call('recording_new', simulator.handle, keyframeInterval);
    registry.register(this, this.#handle, this);
  }

  static fromBytes(file) {
    leaveBytes(file);
    return new Recording(FILE);
  }

  toBytes() {
    return bytes('recording_to_bytes', this.#handle);
  }

  record(simulator, dt, input = NO_INPUT) {
    leaveBytes(input);
    call('recording_record', this.#handle, simulator.handle, dt);
  }

  get length() {
    return call('recording_length', this.#handle);
  }

  get keyframeInterval() {
    return call('recording_keyframe_interval', this.#handle);
  }

  dt(update) {
    return call('recording_dt', this.#handle, update);
  }

  input(update) {
    return bytes('recording_input', this.#handle, update);
  }

  stateHash(update) {
    return hash('recording_hash', this.#handle, update);
  }

  restore(simulator, updates, play) {
    const interval = this.keyframeInterval;
    const keyframe = Math.floor(updates / interval);
    if (!(updates <= this.length)) throw new PhysicsError('so many updates were not recorded');
    simulator.restore(bytes('recording_keyframe', this.#handle, keyframe));
    for (let update = keyframe * interval; update < updates; update++) {
      if (!this.#replay(simulator, update, play)) {
        throw new PhysicsError('the replay has other bits than the recorded run');
      }
    }
  }

  firstDivergence(simulator, play) {
    simulator.restore(bytes('recording_keyframe', this.#handle, 0));
    for (let update = 0; update < this.length; update++) {
      if (!this.#replay(simulator, update, play)) return update;
    }
    return null;
  }

  #replay(simulator, update, play) {
    play(simulator, this.input(update), this.dt(update));
    return simulator.stateHash() === this.stateHash(update);
  }

  firstDifference(other) {
    const update = call('recording_first_difference', this.#handle, other.#handle);
    return update < 0 ? null : update;
  }

  free() {
    registry.unregister(this);
    call('recording_free', this.#handle);
    this.#handle = 2 ** 32 - 1;
  }
}
