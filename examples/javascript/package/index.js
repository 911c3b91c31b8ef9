export { DepthBody, DepthSimulator, Platform } from './depth.js';
export { PhysicsError, initialize } from './module.js';
export { Body, Geom, Joint, Spring } from './objects.js';
export { Simulator } from './simulator.js';
