// Code for the entry in 2D alone that `tsc` must accept, and code that it must refuse.

import * as plane from '../plane.js';

await plane.initialize();
const simulator = new plane.Simulator({ gravity: { x: 0, y: 300 } });
const body: plane.Body = simulator.createCircleBody(10, 1);
simulator.drainEvents().forEach((event: plane.Event) => event.type);

// @ts-expect-error it has no depth
new plane.DepthSimulator({ height: 480 });

export { body };
