// Steps of a fixed length for frames of any length, with poses between two steps.

const TURN = 2 * Math.PI;
/** Columns of a row of `positions`: x, y, rotation. */
const COLUMNS = 3;

export class FixedStepRunner {
  #simulator;
  #waiting = 0;
  #before = new Float32Array();
  #after = new Float32Array();
  #teleported = new Set();

  constructor(simulator, { updatesPerSecond = 60, maxUpdates = 5 } = {}) {
    if (!(updatesPerSecond > 0)) throw new RangeError('updatesPerSecond must be greater than 0');
    if (!(maxUpdates >= 1)) throw new RangeError('maxUpdates must be at least 1');
    this.#simulator = simulator;
    this.dt = 1 / updatesPerSecond;
    this.maxUpdates = maxUpdates;
  }

  advance(elapsed, update = (simulator, dt) => simulator.step(dt)) {
    if (!(elapsed >= 0 && elapsed < Infinity)) throw new RangeError('elapsed must be finite and 0 or more');
    const total = this.#waiting + elapsed;
    // A frame of one step whose time is rounded down is one step.
    const due = Math.floor(total / this.dt + 1e-9);
    this.#waiting = Math.max(0, total - due * this.dt);
    const updates = Math.min(due, this.maxUpdates);
    for (let at = 0; at < updates; at++) {
      update(this.#simulator, this.dt);
      this.#remember();
    }
    return updates;
  }

  #remember() {
    const before = this.#after;
    this.#after = this.#simulator.positions.slice();
    for (const slot of this.#teleported) before.fill(NaN, COLUMNS * slot, COLUMNS * (slot + 1));
    this.#teleported.clear();
    this.#before = before;
  }

  get interpolation() {
    return Math.min(1, this.#waiting / this.dt);
  }

  pose(body) {
    const row = COLUMNS * body.slot;
    const [x, y, rotation] = this.#after.subarray(row, row + COLUMNS);
    if (!(x === x && rotation !== undefined)) return null;
    const [beforeX, beforeY, beforeRotation] = this.#before.subarray(row, row + COLUMNS);
    if (!(beforeX === beforeX && beforeRotation !== undefined)) return { position: { x, y }, rotation };
    const fraction = this.interpolation;
    const turn = rotation - beforeRotation;
    const shortTurn = turn - Math.round(turn / TURN) * TURN;
    return {
      position: { x: beforeX + (x - beforeX) * fraction, y: beforeY + (y - beforeY) * fraction },
      rotation: beforeRotation + shortTurn * fraction,
    };
  }

  markTeleport(body) {
    this.#teleported.add(body.slot);
  }

  reset() {
    this.#waiting = 0;
    this.#before = new Float32Array();
    this.#after = new Float32Array();
    this.#teleported.clear();
  }
}
