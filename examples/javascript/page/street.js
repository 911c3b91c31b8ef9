// A street in 2.5D: a figure that walks, crates, balls, a slope, a lift and a belt.

import { DepthSimulator, Platform } from '../package/index.js';

const WIDTH = 800;
const HEIGHT = 420;
const LEVEL = { left: 0, right: 730, front: 10, back: 190 };
const FIGURE = { width: 28, height: 56, depth: 18 };

export class Street {
  constructor(canvas) {
    this.context = canvas.getContext('2d');
    this.simulator = new DepthSimulator({ height: HEIGHT, angle: 70, gravity: { x: 0, y: 900 } });
    this.keys = new Set();
    this.isJumping = false;
    this.time = 0;
    this.simulator.spawnLane({ ...LEVEL, height: 1000 }).forEach((wall) => (wall.userData = { isHidden: true }));
    this.#platforms();
    this.#things();
    this.figure = this.#spawn('spawnFigure', FIGURE, { position3d: { x: 60, y: 0, z: 90 } }, '#c8553d');
    this.#listen();
  }

  #platform(size, position3d, options, colour) {
    const platform = this.simulator.createPlatform(size, position3d, options);
    platform.setSurface({ frictionCoefficient: 0.6 });
    platform.userData = { colour };
    return platform;
  }

  #platforms() {
    const step = { width: 110, height: 36, depth: 90 };
    this.#platform(step, { x: 330, y: 0, z: 130 }, {}, '#8a9a5b');
    const slope = { width: 120, height: 10, depth: 90 };
    this.#platform(slope, { x: 222, y: 11, z: 130 }, { rotation: -0.31 }, '#a3b18a');
    this.lift = this.#platform({ width: 90, height: 12, depth: 80 }, { x: 470, y: 0, z: 130 }, {}, '#f28f3b');
    const belt = { surfaceSpeed: { along: 70, depth: 0 } };
    this.#platform({ width: 230, height: 12, depth: 60 }, { x: 600, y: 0, z: 60 }, belt, '#588b8b');
  }

  #things() {
    for (let number = 0; number < 6; number++) {
      const size = { width: 30, height: 30, depth: 30 };
      const position3d = { x: 330 + 45 * (number % 3), y: 60 + 40 * number, z: 45 + 12 * (number % 4) };
      this.#spawn('spawnPrism', size, { position3d, mass: 6 }, '#9c6b3f');
    }
    for (let number = 0; number < 5; number++) {
      const position3d = { x: 120 + 60 * number, y: 120, z: 40 + 25 * number };
      const options = { position3d, mass: 2, restitutionCoefficient: 0.6 };
      this.#spawn('spawnBall', 12, options, '#7d5ba6');
    }
  }

  #spawn(kind, size, options, colour) {
    const { body } = this.simulator[kind](size, options);
    body.userData = { colour, ...(typeof size === 'number' ? { radius: size } : size) };
    return body;
  }

  #listen() {
    addEventListener('keydown', (event) => {
      if (!event.key.startsWith('Arrow') && event.key !== ' ') return;
      event.preventDefault();
      if (event.key === ' ' && !event.repeat) this.isJumping = true;
      this.keys.add(event.key);
    });
    addEventListener('keyup', (event) => this.keys.delete(event.key));
    addEventListener('blur', () => this.keys.clear());
  }

  step(dt) {
    this.time += dt;
    this.lift.velocity = { x: 0, y: 40 * Math.sign(Math.sin(this.time)), z: 0 };
    const pressed = (key) => (this.keys.has(key) ? 1 : 0);
    const x = 170 * (pressed('ArrowRight') - pressed('ArrowLeft'));
    const z = 120 * (pressed('ArrowUp') - pressed('ArrowDown'));
    this.simulator.walk(this.figure, { x, z, jump: this.isJumping }, dt);
    this.isJumping = false;
    this.simulator.step(dt);
    this.simulator.drainEvents();
  }

  draw() {
    const { context, simulator } = this;
    context.fillStyle = '#dfe8ec';
    context.fillRect(0, 0, WIDTH, HEIGHT);
    const { left, right, front, back } = LEVEL;
    const corners = [[left, front], [right, front], [right, back], [left, back]];
    this.#face(corners.map(([x, z]) => simulator.toScreen({ x, y: 0, z })), '#cfc7b8');
    for (const drawn of simulator.drawOrder()) {
      if (drawn.userData.isHidden) continue;
      if (drawn instanceof Platform) this.#box(drawn.screenCorners, drawn.userData.colour);
      else this.#body(drawn);
    }
  }

  #face(points, colour) {
    const { context } = this;
    context.beginPath();
    points.forEach(({ x, y }) => context.lineTo(x, y));
    context.closePath();
    context.fillStyle = colour;
    context.fill();
    context.strokeStyle = 'rgba(0, 0, 0, 0.3)';
    context.stroke();
  }

  /** The visible faces of a box: top, front and, as the z axis leans, the right side. */
  #box(at, colour) {
    this.#face([at[1], at[5], at[6], at[2]], shade(colour, -30));
    this.#face([at[0], at[4], at[5], at[1]], shade(colour, 25));
    this.#face([at[0], at[1], at[2], at[3]], colour);
  }

  #body(body) {
    const { context, simulator } = this;
    const { x, y, z } = body.position3d;
    const { colour, radius, width, height, depth } = body.userData;
    const shadow = simulator.toScreen({ x, y: body.heightBeneath ?? y, z });
    context.beginPath();
    context.ellipse(shadow.x, shadow.y, radius ?? width / 2, (radius ?? depth / 2) * 0.7, 0, 0, 2 * Math.PI);
    context.fillStyle = 'rgba(0, 0, 0, 0.25)';
    context.fill();
    const middle = body.screenPosition;
    if (radius !== undefined) {
      context.beginPath();
      context.arc(middle.x, middle.y, radius, 0, 2 * Math.PI);
      context.fillStyle = colour;
      context.fill();
      context.stroke();
      return;
    }
    const [cos, sin] = [Math.cos(body.rotation), Math.sin(body.rotation)];
    const back = simulator.toScreen({ x: 0, y: 0, z: depth / 2 });
    const origin = simulator.toScreen({ x: 0, y: 0, z: 0 });
    const corner = (across, down, side) => ({
      x: middle.x + across * cos - down * sin + side * (back.x - origin.x),
      y: middle.y + across * sin + down * cos + side * (back.y - origin.y),
    });
    const [w, h] = [width / 2, height / 2];
    const corners = [[-w, -h], [w, -h], [w, h], [-w, h]];
    this.#box([-1, 1].flatMap((side) => corners.map(([across, down]) => corner(across, down, side))), colour);
  }
}

/** A colour made lighter or darker. */
function shade(colour, by) {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) + by);
  return `rgb(${parts.map((part) => Math.max(0, Math.min(255, part))).join(', ')})`;
}
