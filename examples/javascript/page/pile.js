// Crates, balls, triangles and capsules, a swinging chain, and a mouse that drags.

import { Simulator } from '../package/index.js';

const COLOURS = ['#c8553d', '#588b8b', '#f28f3b', '#7d5ba6', '#4f772d'];
const SURFACE = { frictionCoefficient: 0.5, restitutionCoefficient: 0.1 };
const WIDTH = 800;
const HEIGHT = 420;

export class Pile {
  constructor(canvas, says) {
    this.canvas = canvas;
    this.says = says;
    this.context = canvas.getContext('2d');
    this.simulator = new Simulator({ gravity: { x: 0, y: 600 } });
    this.shapes = [];
    this.touches = 0;
    this.spring = null;
    this.#room();
    for (let number = 0; number < 90; number++) this.#thing(number);
    this.#chain();
    this.#listen();
  }

  #room() {
    const wall = (x, y, width, height) => {
      const body = this.simulator.createRectangleBody(width, height, 1, { isStatic: true, position: { x, y } });
      this.simulator.createRectangleGeom(body, width, height, SURFACE);
    };
    wall(WIDTH / 2, HEIGHT + 10, WIDTH + 80, 60);
    wall(-20, HEIGHT / 2 - 400, 40, HEIGHT + 800);
    wall(WIDTH + 20, HEIGHT / 2 - 400, 40, HEIGHT + 800);
  }

  #thing(number) {
    const { simulator } = this;
    const position = { x: 80 + (number % 12) * 55 + (number % 5), y: 330 - Math.floor(number / 12) * 60 };
    const options = { position, rotation: number };
    const colour = COLOURS[number % COLOURS.length];
    if (number % 4 === 0) {
      const body = simulator.createRectangleBody(36, 26, 2, options);
      simulator.createRectangleGeom(body, 36, 26, SURFACE);
      this.shapes.push({ body, colour, path: rectangle(36, 26) });
    } else if (number % 4 === 1) {
      const body = simulator.createCircleBody(15, 1.5, options);
      simulator.createCircleGeom(body, 15, SURFACE);
      this.shapes.push({ body, colour, path: circle(15) });
    } else if (number % 4 === 2) {
      const corners = [{ x: -20, y: 12 }, { x: 20, y: 12 }, { x: 0, y: -24 }];
      const body = simulator.createPolygonBody(corners, 1.5, options);
      simulator.createPolygonGeom(body, corners, SURFACE);
      this.shapes.push({ body, colour, path: polygon(corners) });
    } else {
      const body = simulator.createCapsuleBody(44, 10, 1.5, options);
      simulator.createCapsuleGeom(body, 44, 10, SURFACE);
      this.shapes.push({ body, colour, path: capsule(44, 10) });
    }
  }

  #chain() {
    const { simulator } = this;
    let last = null;
    for (let link = 0; link < 8; link++) {
      const body = simulator.createRectangleBody(26, 8, 1, { position: { x: 413 + link * 24, y: 40 } });
      simulator.createRectangleGeom(body, 26, 8, { collisionGroup: 1 });
      const anchor = { x: 401 + link * 24, y: 40 };
      if (last === null) simulator.createFixedRevoluteJoint(body, anchor);
      else simulator.createRevoluteJoint(last, body, anchor);
      this.shapes.push({ body, colour: '#3d4f5d', path: rectangle(26, 8) });
      last = body;
    }
  }

  #listen() {
    const at = ({ offsetX, offsetY }) => {
      const scale = WIDTH / this.canvas.clientWidth;
      return { x: offsetX * scale, y: offsetY * scale };
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      const point = at(event);
      const body = this.simulator.collideAll(point).find((geom) => !geom.body.isStatic)?.body;
      if (body === undefined) return;
      this.canvas.setPointerCapture(event.pointerId);
      const held = body.getLocalPosition(point);
      this.spring = this.simulator.createFixedLinearSpring(body, held, point, 60 * body.mass, 8 * body.mass);
      this.held = { body, held, point };
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.spring === null) return;
      this.held.point = at(event);
      this.spring.worldAttachPoint = this.held.point;
      this.held.body.wake();
    });
    const release = () => {
      this.spring?.dispose();
      this.spring = null;
    };
    this.canvas.addEventListener('pointerup', release);
    this.canvas.addEventListener('pointercancel', release);
  }

  step(dt) {
    this.simulator.step(dt);
    this.touches += this.simulator.drainEvents().filter((event) => event.type === 'touchBegin').length;
  }

  draw() {
    const { context, simulator } = this;
    context.clearRect(0, 0, WIDTH, HEIGHT);
    context.fillStyle = '#b9c4c9';
    context.fillRect(0, HEIGHT - 20, WIDTH, 20);
    const { positions } = simulator;
    context.strokeStyle = 'rgba(0, 0, 0, 0.35)';
    for (const { body, colour, path } of this.shapes) {
      const row = 3 * body.slot;
      context.setTransform(1, 0, 0, 1, positions[row], positions[row + 1]);
      context.rotate(positions[row + 2]);
      context.fillStyle = colour;
      context.fill(path);
      context.stroke(path);
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (this.spring !== null) {
      const end = this.held.body.getWorldPosition(this.held.held);
      context.beginPath();
      context.moveTo(end.x, end.y);
      context.lineTo(this.held.point.x, this.held.point.y);
      context.strokeStyle = '#111';
      context.stroke();
    }
    const asleep = this.shapes.filter(({ body }) => body.isAsleep).length;
    this.says.textContent = `${this.shapes.length} bodies, ${asleep} asleep, ${this.touches} touches so far.`;
  }
}

function rectangle(width, height) {
  const path = new Path2D();
  path.rect(-width / 2, -height / 2, width, height);
  return path;
}

function circle(radius) {
  const path = new Path2D();
  path.arc(0, 0, radius, 0, 2 * Math.PI);
  path.moveTo(0, 0);
  path.lineTo(radius, 0);
  return path;
}

/** About its centroid, where its body is. */
function polygon(corners) {
  const middle = (along) => corners.reduce((sum, corner) => sum + corner[along], 0) / corners.length;
  const [x, y] = [middle('x'), middle('y')];
  const path = new Path2D();
  corners.forEach((corner) => path.lineTo(corner.x - x, corner.y - y));
  path.closePath();
  return path;
}

function capsule(height, radius) {
  const path = new Path2D();
  path.roundRect(-radius, -height / 2, 2 * radius, height, radius);
  return path;
}
