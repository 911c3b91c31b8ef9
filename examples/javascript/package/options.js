// Objects of options as rows of numbers, in the order of `fields.rs`. NaN stands for an option that is not given.

import { call, memory } from './module.js';
import { Body, Geom } from './objects.js';

const TYPES = ['dynamic', 'kinematic', 'fixed'];
const EVENTS = ['touch', 'sensor', 'hit'];

/** A number for the module; a NaN of the game becomes infinite, which is refused. */
function number(value) {
  if (value === undefined || value === null) return NaN;
  const converted = Number(value);
  return Number.isNaN(converted) ? Infinity : converted;
}

function checked(what, options, names) {
  for (const name of Object.keys(options)) {
    if (!names.includes(name)) throw new TypeError(`${what} has no ${name}`);
  }
}

function numbersOf(options, names) {
  return names.flatMap((name) => (POINTS.has(name) ? pointOf(options[name]) : [number(options[name])]));
}

// A point without x or y gets Infinity there, which no option takes.
function pointOf(point) {
  return point === undefined || point === null ? [NaN, NaN] : [number(point.x ?? Infinity), number(point.y ?? Infinity)];
}

const POINTS = new Set(['position', 'linearVelocity', 'offset', 'oneWay']);

const BODY = [
  'position',
  'rotation',
  'linearVelocity',
  'angularVelocity',
  'linearDamping',
  'angularDamping',
  'gravityScale',
  'mass',
  'momentOfInertia',
  'lockRotation',
  'bullet',
  'sleepAllowed',
  'startsAsleep',
  'sleepEvents',
  'enabled',
];
const BODY_NAMES = [...BODY, 'type', 'userData'];

export function bodyNumbers(options) {
  checked('the body', options, BODY_NAMES);
  const type = TYPES.indexOf(options.type ?? 'dynamic');
  if (type < 0) throw new TypeError(`type is one of ${TYPES.join(', ')}`);
  return [type, ...numbersOf(options, BODY)];
}

const points = (list) => list.flatMap(({ x, y }) => [x, y]);
const SHAPES = {
  rectangle: ({ width, height }) => [width, height],
  circle: ({ radius }) => [radius],
  capsule: ({ height, endRadius }) => [height, endRadius],
  polygon: points,
  chain: points,
};
const SHAPE_NAMES = Object.keys(SHAPES);
const GEOM = [
  'offset',
  'rotationOffset',
  'density',
  'mass',
  'friction',
  'restitution',
  'categories',
  'collidesWith',
  'group',
  'sensor',
  'events',
  'oneWay',
];
const GEOM_NAMES = [...SHAPE_NAMES, ...GEOM, 'userData'];

function eventBits(events) {
  if (!Array.isArray(events) || events.some((name) => !EVENTS.includes(name))) {
    throw new TypeError(`events is a list of ${EVENTS.join(', ')}`);
  }
  return EVENTS.reduce((bits, name, at) => (events.includes(name) ? bits | (1 << at) : bits), 0);
}

export function geomNumbers(options) {
  checked('the geom', options, GEOM_NAMES);
  const shapes = SHAPE_NAMES.filter((name) => options[name] !== undefined);
  if (shapes.length !== 1) throw new TypeError(`a geom has one of ${SHAPE_NAMES.join(', ')}`);
  const shape = SHAPES[shapes[0]](options[shapes[0]]).map(number);
  const events = options.events && eventBits(options.events);
  return [SHAPE_NAMES.indexOf(shapes[0]), shape.length, ...shape, ...numbersOf({ ...options, events }, GEOM)];
}

const FILTER = ['categories', 'asCategories', 'fixed', 'kinematic', 'dynamic', 'sensors'];

export function filterNumbers(simulator, filter) {
  checked('the filter', filter, [...FILTER, 'excludeBody', 'excludeGeom', 'accepts']);
  const { excludeBody, excludeGeom } = filter;
  return [
    ...numbersOf(filter, FILTER),
    excludeBody ? simulator.idOf(excludeBody, Body) : NaN,
    excludeGeom ? simulator.idOf(excludeGeom, Geom) : NaN,
  ];
}

const MOVER = [
  'acceleration',
  'airAcceleration',
  'gravityScale',
  'jumpHeight',
  'jumpCut',
  'coyoteTime',
  'jumpBuffer',
  'maxSlope',
  'stepUp',
  'snap',
  'pushForce',
  'mass',
  'categories',
  'asCategories',
];

export function moverNumbers(options) {
  checked('the mover', options, MOVER);
  return numbersOf(options, MOVER);
}

export function explosionNumbers(simulator, { position, radius = 0, falloff = 0, strength, filter = {} }) {
  return [position.x, position.y, radius, falloff, strength].map(number).concat(filterNumbers(simulator, filter));
}

export const pointNumbers = ({ x, y }) => [number(x), number(y)];

/** Leaves numbers for the next function. */
export function leave(numbers) {
  const start = call('reserve_numbers', numbers.length) / 8;
  memory().set(numbers, start);
}
