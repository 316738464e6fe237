// Draggable items: objects, walls, goals, and the robot's reach. Each has its path in the file.

import { task, at } from './task.js';

const degree = Math.PI / 180;
const isPoint = (value) => Array.isArray(value) && value.length >= 2 && value.slice(0, 2).every(Number.isFinite);

/**
 * Returns all items: `id`, `kind`, `name`, `path` in the file, and `pose` from its values, in metres and
 * radians; `body` is the drawing.
 */
export function things() {
  const { stage, values } = task;
  if (!stage || !values) return [];
  const objects = stage.objects.map((body, k) => thing('object', k, ['scene', 'objects', k], body));
  const goals = Array.isArray(values.goal) ? values.goal.map((one, k) => [one, ['goal', k]]) : [[values.goal, ['goal']]];
  const wanted = new Set(goals.map(([goal]) => goal?.object));
  for (const object of objects) if (object) object.own = wanted.has(object.name);
  return [
    ...stage.obstacles.map((body, k) => thing('obstacle', k, ['scene', 'obstacles', k], body)),
    ...goals.map(([goal, path], k) => goalThing(goal, path, k, objects)),
    ...objects,
    ...reaches(stage),
  ].filter(Boolean);
}

function thing(kind, index, path, body) {
  const values = at(path);
  const position = values?.position;
  if (!isPoint(position)) return null;
  const turn = kind === 'goal' ? 'heading_deg' : 'yaw_deg';
  const yaw = values[turn];
  const turns = kind !== 'goal' || yaw !== undefined;
  const pose = [position[0], position[1], Number.isFinite(yaw) ? yaw * degree : 0];
  const name = values.name ?? `${kind} ${index + 1}`;
  return { id: `${kind}-${index}`, kind, index, name: String(name), path, body, pose, turn: turns ? turn : null, own: false };
}

/** Returns a goal with a place, named after its object; it may be in the frame of another object. */
function goalThing(goal, path, index, objects) {
  const place = goal?.coverage ? [...path, 'coverage'] : path;
  const own = thing('goal', index, place, { tolerance: (goal?.tolerance || 0) / LENGTH });
  if (!own) return null;
  own.goal = path;
  const other = goal.relative_to && objects.find((one) => one?.name === goal.relative_to);
  const object = objects.findIndex((one) => one?.name === goal.object);
  own.body.object = object;
  own.name = String(goal.object ?? own.name);
  if (other) {
    own.frame = other.pose;
    own.pose = [...placed(other.pose, own.pose), own.pose[2] + other.pose[2]];
  } else if (goal.heading_deg === undefined && !goal.coverage && object >= 0) {
    // Any heading is accepted, so the present one is drawn.
    own.pose[2] = objects[object].pose[2];
  }
  return own;
}

/** Returns the limits of the reach, and the start of chained pushes. */
function reaches(stage) {
  const robot = at(['robot']);
  const list = ['min', 'max'].map((end, k) => ({
    id: `reach-${end}`, kind: 'reach', index: k, name: end === 'min' ? 'smallest reach' : 'largest reach',
    path: ['robot', 'reach', end], pose: [(stage.reach[k] ?? 0) * 1e-5, 0, 0], turn: null,
  })).filter(({ path }) => Number.isFinite(at(path)));
  for (const one of list) one.pose[0] = at(one.path);
  if (isPoint(robot?.home)) {
    list.push({ id: 'home', kind: 'home', index: 0, name: 'home of the end effector', path: ['robot', 'home'], pose: [...robot.home.slice(0, 2), 0], turn: null });
  }
  return list;
}

const rounded = (value, digits) => +value.toFixed(digits);

/** Returns the edits that move an item to a position in metres. */
export function movedTo(thing, [x, y], digits = 3) {
  if (thing.kind === 'reach') return [{ path: thing.path, value: Math.max(0, rounded(Math.hypot(x, y), digits)) }];
  const path = thing.kind === 'home' ? thing.path : [...thing.path, 'position'];
  const { frame } = thing;
  const at = frame ? placed([0, 0, -frame[2]], [x - frame[0], y - frame[1]]) : [x, y];
  // One at a time, because a third number may follow.
  return at.map((value, k) => ({ path: [...path, k], value: rounded(value, digits) }));
}

/** Returns the edits that rotate an item to a heading in radians. */
export function turnedTo(thing, heading) {
  if (!thing.turn) return [];
  const whole = Math.round((heading - (thing.frame?.[2] ?? 0)) / degree);
  const value = ((((whole + 180) % 360) + 360) % 360) - 180;
  return [{ path: [...thing.path, thing.turn], value }];
}

/** Returns a description for screen readers. */
export function words(thing) {
  const [x, y, heading] = thing.pose;
  const kinds = { object: 'object', obstacle: 'wall', goal: 'goal', reach: '', home: '' };
  if (thing.kind === 'reach') return `${thing.name}, ${x.toFixed(3)} metres`;
  const turned = thing.turn && heading ? `, rotated by ${Math.round(heading / degree)} degrees` : '';
  const name = thing.kind === 'goal' ? `goal of ${thing.name}` : `${thing.name}${kinds[thing.kind] && `, ${kinds[thing.kind]}`}`;
  return `${name}, at x ${fixed(x, 3)}, y ${fixed(y, 3)} metres${turned}`;
}

/** Returns an unused name. */
function free(word) {
  const taken = new Set([...(at(['scene', 'objects']) ?? []), ...(at(['scene', 'obstacles']) ?? [])].map((one) => one?.name));
  let k = 1;
  while (taken.has(`${word}-${k}`)) k++;
  return `${word}-${k}`;
}

/** Returns a position on the table with room around it. */
function room() {
  const taken = things().filter(({ kind }) => kind === 'object' || kind === 'obstacle');
  const clear = (x, y) => taken.every(({ pose, body }) => Math.hypot(pose[0] - x, pose[1] - y) > radius(body.shape) + 0.09);
  for (const x of [0.5, 0.35, 0.65]) {
    for (const y of [-0.2, 0.2, -0.35, 0.35, 0, -0.5, 0.5]) if (clear(x, y)) return [x, y];
  }
  return [0.5, 0];
}

/** Returns the edits that add an object or a wall. */
export function added(kind) {
  const position = room();
  if (kind === 'obstacle') {
    const index = at(['scene', 'obstacles'])?.length ?? 0;
    return [{ path: ['scene', 'obstacles', index], value: { name: free('wall'), size: [0.04, 0.2, 0.1], position } }];
  }
  const shape = task.levers ? { cuboid: { size: [0.12, 0.1, 0.01] } } : { cylinder: { radius: 0.04, height: 0.1 } };
  const more = task.levers ? { clearance: 0.008 } : {};
  const index = at(['scene', 'objects'])?.length ?? 0;
  return [{ path: ['scene', 'objects', index], value: { name: free('object'), shape, mass: 0.4, friction: 0.4, ...more, position } }];
}

/** Returns the edits that remove an item; none if the task needs the item. */
export function removed(thing) {
  const listed = (path) => at(path.slice(0, -1))?.length ?? 0;
  const last = thing.path.at(-1);
  if (!Number.isInteger(last)) return [];
  if (listed(thing.path) > 1) return [{ path: thing.path }];
  return thing.kind === 'obstacle' ? [{ path: thing.path.slice(0, -1) }] : [];
}
