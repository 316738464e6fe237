// The table from above, with draggable items.

import { task, change, settle } from './task.js';
import { things, movedTo, turnedTo, removed, words } from './things.js';

const MARGIN = 0.12; // metres around everything
const KNOB = 0.035; // metres from an item's rim to the knob that rotates it
const SNAP = 0.005; // metres to which a drag snaps without Shift
const TURN = 5; // degrees per key press

const root = svg('svg', { role: 'group', 'aria-label': 'The table from above', 'aria-describedby': 'keys' });
let width = 800; // pixels
let scale = 1; // pixels per metre
let low = [0, 0];
let high = [1, 1];
let drag = null;
/** The last plan: pushes and final poses of objects. */
let overlay = null;
/** Whether nothing was dragged or pressed since the view was fitted. */
let fresh = false;
let choose = () => {};

export const chosen = { id: 'goal-0' };
export const chosenThing = () => things().find(({ id }) => id === chosen.id);

const px = (metres) => +(metres * scale).toFixed(2);
const map = ([x, y]) => [px(x - low[0]), px(high[1] - y)];
const degrees = (heading) => +((-heading * 180) / Math.PI).toFixed(2);
const placedAt = (pose) => `translate(${map(pose).join(' ')}) rotate(${degrees(pose[2])})`;

/** Returns the position of a pointer on the table, metres. */
function under(event) {
  const box = root.getBoundingClientRect();
  const share = width / box.width;
  return [low[0] + ((event.clientX - box.left) * share) / scale, high[1] - ((event.clientY - box.top) * share) / scale];
}

/** Sets up the table; `whenChosen` is called for every selection of an item. */
export function begin(whenChosen) {
  choose = (id) => {
    chosen.id = id;
    whenChosen();
  };
  byId('table').append(root);
  root.addEventListener('pointerdown', grab);
  root.addEventListener('pointermove', follow);
  for (const end of ['pointerup', 'pointercancel']) root.addEventListener(end, release);
  root.addEventListener('keydown', press);
  root.addEventListener('focusin', (event) => {
    const { id } = event.target.dataset;
    if (id && id !== chosen.id) {
      choose(id);
      draw();
    }
  });
  new ResizeObserver(() => {
    const now = widthOf(byId('table'));
    if (now !== width) requestAnimationFrame(fit);
  }).observe(byId('table'));
}

/** Shows tools, pushes and final poses of a plan, or none. The view of an unchanged task grows to the plan. */
export function show(summary) {
  overlay = summary;
  if (summary && fresh) fit();
  else draw();
}

export function fit() {
  fresh = true;
  low = [0, 0];
  high = [0, 0];
  const add = (at, room) => {
    low = low.map((value, k) => Math.min(value, at[k] - room));
    high = high.map((value, k) => Math.max(value, at[k] + room));
  };
  for (const { kind, pose, body } of things()) {
    const room = body?.shape ? radius(body.shape) : body?.tolerance ? body.tolerance * LENGTH : 0;
    if (kind !== 'reach' || pose[0] <= 1.5) add(pose, room);
  }
  const { tools, strokes = [] } = overlay?.drawn ?? {};
  for (const { tool, from, to } of strokes) for (const end of [posed(from), posed(to)]) {
    for (const { at, shape } of tools[tool].parts) add(placed(end, posed(at)), radius(shape));
  }
  // Room for drags to both sides.
  low = [low[0] - MARGIN, Math.min(low[1] - MARGIN, -0.4)];
  high = [high[0] + MARGIN, Math.max(high[1] + MARGIN, 0.4)];
  width = widthOf(byId('table'));
  scale = Math.min(width / (high[0] - low[0]), Math.min(520, width) / (high[1] - low[1]));
  const spare = (width / scale - (high[0] - low[0])) / 2;
  low[0] -= spare;
  high[0] += spare;
  root.setAttribute('viewBox', `0 0 ${width} ${px(high[1] - low[1])}`);
  draw();
}

export function draw() {
  const focused = root.contains(document.activeElement) ? document.activeElement.dataset.id : null;
  root.replaceChildren();
  if (!task.stage) return;
  grid();
  const all = things();
  for (const thing of all) if (thing.kind === 'goal') root.append(goalShape(thing, all));
  for (const thing of all) if (thing.kind !== 'goal') root.append(shape(thing));
  const own = all.find(({ id }) => id === chosen.id);
  if (own?.turn) root.append(knob(own));
  if (overlay) root.append(planShape());
  if (focused) root.querySelector(`[data-id="${focused}"]`)?.focus({ preventScroll: true });
}

function grid() {
  const step = [0.05, 0.1, 0.2, 0.5, 1].find((size) => size * scale >= 45) ?? 2;
  const [right, bottom] = map([high[0], low[1]]);
  for (let k = Math.ceil(low[0] / step); k * step <= high[0]; k++) {
    const [x] = map([k * step, 0]);
    root.append(svg('line', { x1: x, x2: x, y1: 0, y2: bottom, class: 'grid' }));
  }
  for (let k = Math.ceil(low[1] / step); k * step <= high[1]; k++) {
    const [, y] = map([0, k * step]);
    root.append(svg('line', { x1: 0, x2: right, y1: y, y2: y, class: 'grid' }));
  }
  const [end, height] = [right - 14, bottom - 14];
  root.append(
    svg('path', { d: `M${end - px(step)} ${height - 4}v8m0-4H${end}m0-4v8`, class: 'bar' }),
    svg('text', { x: end - px(step) / 2, y: height - 7, class: 'small middle' }, step < 1 ? `${step * 100} cm` : `${step} m`),
  );
  const { table } = task.stage;
  if (table) {
    const [[x, y], [w, h]] = table.map((pair) => pair.map((value) => value * LENGTH));
    const [left, top] = map([x - w / 2, y + h / 2]);
    root.append(svg('rect', { x: left, y: top, width: px(w), height: px(h), class: 'table' }));
  }
  const [x, y] = map(baseOf(task.stage));
  for (const body of task.stage.obstacles.filter((one) => one.base)) still(body.shape, body.at, 'base', body.name);
  root.append(...robotMark(task.stage, px, map));
  for (const region of task.stage.regions ?? []) still(region.shape, region.at, 'keep-out', region.name);
  for (const goal of task.stage.goals) {
    for (const area of goal.areas) still(area.shape, area.at, area.leave ? 'leave' : 'goal', goal.words);
    const { objects } = task.stage;
    const ends = goal.arc ? solidsAt(objects, goal.objects[0], swung(goal.arc, posed(objects[goal.objects[0]].at))) : [];
    for (const [body, pose] of ends) root.append(outlined(body.shape, px, { transform: placedAt(pose), class: 'wanted' }));
    for (const mark of goalMarks(goal, px, map)) {
      mark.append(svg('title', {}, goal.words));
      root.append(mark);
    }
  }
  for (const { kind, pose } of things()) {
    if (kind === 'reach') root.append(svg('circle', { cx: x, cy: y, r: px(pose[0]), class: 'reach' }));
  }
}

/** Draws a shape that can only be edited in the file. */
function still(form, at, className, name) {
  root.append(outlined(form, px, { transform: placedAt(posed(at)), class: className }));
  root.lastChild.append(svg('title', {}, name));
}

/** Returns the group of an item, which has a label and accepts pointer and keyboard. */
function group(thing, ...children) {
  const own = thing.own ? ' own' : '';
  const mark = thing.id === chosen.id ? ' chosen' : '';
  return svg('g', {
    class: `thing ${thing.kind}-thing${own}${mark}`, 'data-id': thing.id, tabindex: 0, role: 'button',
    'aria-label': words(thing), 'aria-pressed': thing.id === chosen.id,
  }, svg('title', {}, thing.kind === 'goal' ? `goal of ${thing.name}` : thing.name), ...children);
}

function shape(thing) {
  if (thing.kind === 'reach' || thing.kind === 'home') {
    const [cx, cy] = map(thing.pose);
    const mark = thing.kind === 'home' ? svg('rect', { x: cx - 6, y: cy - 6, width: 12, height: 12, class: 'knob body' })
      : svg('circle', { cx, cy, r: 6, class: 'knob body' });
    return group(thing, svg('circle', { cx, cy, r: 15, class: 'target' }), mark);
  }
  const { body, kind, name, pose } = thing;
  const look = { obstacle: body.under ? 'overhead body' : 'obstacle body' }[kind] ?? 'body';
  const [cx, cy] = map(pose);
  const parts = [
    svg('circle', { cx, cy, r: 16, class: 'target' }),
    outlined(body.shape, px, { transform: placedAt(pose), class: look }),
  ];
  for (const more of body.more ?? []) parts.push(outlined(more.shape, px, { transform: placedAt(pose), class: 'start' }));
  if (px(radius(body.shape)) >= 4 * name.length) parts.push(svg('text', { x: cx, y: cy + 4, class: 'label middle' }, name));
  return group(thing, ...parts);
}

function goalShape(thing, all) {
  const [x, y] = map(thing.pose);
  const own = all.find(({ kind, index }) => kind === 'object' && index === thing.body.object);
  const parts = [];
  if (own) {
    parts.push(outlined(own.body.shape, px, { transform: placedAt(thing.pose), class: 'wanted' }));
  }
  parts.push(
    svg('circle', { cx: x, cy: y, r: 16, class: 'target' }),
    svg('circle', { cx: x, cy: y, r: Math.max(4, px(thing.body.tolerance * LENGTH)), class: 'goal body' }),
    svg('path', { d: `M${x - 7} ${y}h14M${x} ${y - 7}v14`, class: 'goal-cross' }),
  );
  return group(thing, ...parts);
}

const knobAt = ({ pose, body }) => placed(pose, [(body.shape ? radius(body.shape) : 0.04) + KNOB, 0]);

function knob(thing) {
  const [[x1, y1], [x2, y2]] = [map(thing.pose), map(knobAt(thing))];
  return svg('g', { class: 'turner' },
    svg('line', { x1, y1, x2, y2, class: 'stem' }),
    svg('circle', { cx: x2, cy: y2, r: 14, class: 'target knob-target', 'data-turn': thing.id }),
    svg('circle', { cx: x2, cy: y2, r: 6, class: 'knob', 'data-turn': thing.id }));
}

/** Draws tool and hand before and after every push, the final poses of objects, and the pushes. */
function planShape() {
  const layer = svg('g', { class: 'overlay' });
  const { tools = [], strokes = [], hand } = overlay.drawn ?? {};
  strokes.forEach((stroke, k) => {
    const tool = (pose, when) => toolShape(tools[stroke.tool], hand, px, { class: `tool ${when}`, transform: placedAt(posed(pose)) });
    if (stroke.lowered) layer.append(tool(stroke.from, 'before'));
    if (strokes[k + 1]?.lowered ?? true) layer.append(tool(stroke.to, 'after'));
  });
  (overlay.ends?.poses ?? []).forEach((end, k) => {
    const body = task.stage.objects[k];
    if (!body) return;
    const transform = placedAt([...end.position, end.heading]);
    for (const { shape } of [body, ...(body.more ?? [])]) layer.append(outlined(shape, px, { transform, class: 'end-of-plan' }));
  });
  layer.append(...strokes.flatMap((stroke, k) => strokeShapes(stroke, k, tools, map)));
  return layer;
}

function grab(event) {
  fresh = false;
  const turning = event.target.closest('[data-turn]')?.dataset.turn;
  const id = turning ?? event.target.closest('[data-id]')?.dataset.id;
  const thing = id && things().find((one) => one.id === id);
  if (!thing || event.button !== 0) return;
  event.preventDefault();
  const [x, y] = under(event);
  drag = { id, turning: Boolean(turning), off: [thing.pose[0] - x, thing.pose[1] - y] };
  root.setPointerCapture(event.pointerId);
  choose(id);
  draw();
  root.querySelector(`[data-id="${id}"]`)?.focus({ preventScroll: true });
}

function follow(event) {
  const thing = drag && things().find(({ id }) => id === drag.id);
  if (!thing) return;
  const at = under(event);
  const steady = `drag ${drag.id}`;
  if (drag.turning) {
    let heading = Math.atan2(at[1] - thing.pose[1], at[0] - thing.pose[0]);
    if (!event.shiftKey) heading = (Math.round((heading * 180) / Math.PI / TURN) * TURN * Math.PI) / 180;
    attempt(turnedTo(thing, heading), steady);
    return;
  }
  const snap = event.shiftKey ? 0.001 : SNAP;
  const wanted = at.map((value, k) => Math.round((value + drag.off[k]) / snap) * snap);
  attempt(movedTo(thing, wanted), steady);
}

function release() {
  if (!drag) return;
  drag = null;
  settle();
  byId('where').textContent = said();
}

const said = () => {
  const thing = chosenThing();
  return thing ? words(thing) : '';
};

function attempt(edits, steady) {
  if (!edits.length) return;
  change(edits, 'table', steady);
}

function press(event) {
  fresh = false;
  const thing = things().find(({ id }) => id === event.target.dataset?.id);
  if (!thing || event.ctrlKey || event.metaKey || event.altKey) return;
  const far = event.shiftKey ? 0.001 : 0.01;
  const ways = { ArrowUp: [0, far], ArrowDown: [0, -far], ArrowLeft: [-far, 0], ArrowRight: [far, 0] };
  const turn = { '[': TURN, ']': -TURN, '{': 1, '}': -1 }[event.key];
  let edits = [];
  if (ways[event.key]) edits = movedTo(thing, thing.pose.slice(0, 2).map((value, k) => value + ways[event.key][k]));
  else if (turn) edits = turnedTo(thing, thing.pose[2] + (turn * Math.PI) / 180);
  else if (event.key === 'Delete' || event.key === 'Backspace') edits = removed(thing);
  else return;
  event.preventDefault();
  attempt(edits, `keys ${thing.id}`);
  byId('where').textContent = said();
}
