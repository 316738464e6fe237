// Input fields of the selected item, and the tools that the task allows.

import { task, at, change } from './task.js';
import { chosenThing } from './table.js';
import { library } from './core.js';

const SHAPES = {
  cylinder: { cylinder: { radius: 0.05, height: 0.1 } },
  cuboid: { cuboid: { size: [0.1, 0.08, 0.08] } },
  prism: { prism: { corners: [[0.06, 0], [-0.03, 0.052], [-0.03, -0.052]], height: 0.06 } },
};
const AXES = ['length x', 'width y', 'height z'];

let shown = '';
const known = JSON.parse(library.tools());

const numeric = (label, path, { unit = 'm', step = 0.005, may = false } = {}) => ({ label, path, unit, step, may });

/** Returns the fields of an item: label, path in the file, unit. */
function fieldsOf({ kind, path, goal }) {
  const own = (...steps) => [...path, ...steps];
  const place = [numeric('x', own('position', 0)), numeric('y', own('position', 1))];
  const turned = numeric('rotation', own('yaw_deg'), { unit: '°', step: 5, may: true });
  const sizes = (...steps) => AXES.map((axis, k) => numeric(axis, own(...steps, k)));
  switch (kind) {
    case 'object': {
      const shape = at(own('shape')) ?? {};
      const word = Object.keys(shape)[0];
      const dimensions = {
        cylinder: [numeric('radius', own('shape', 'cylinder', 'radius')), numeric('height', own('shape', 'cylinder', 'height'))],
        cuboid: sizes('shape', 'cuboid', 'size'),
        prism: [numeric('height', own('shape', 'prism', 'height'))],
      }[word] ?? [];
      const words = task.levers ? ['cuboid', 'prism'] : Object.keys(SHAPES);
      return [
        { label: 'name', path: own('name'), word: true }, { label: 'shape', path: own('shape'), words, now: word }, ...dimensions,
        numeric('mass', own('mass'), { unit: 'kg', step: 0.05 }), numeric('friction', own('friction'), { unit: '', step: 0.05 }), ...place, turned,
      ];
    }
    case 'obstacle':
      return [{ label: 'name', path: own('name'), word: true }, ...sizes('size'), ...place, turned];
    case 'goal':
      return [
        { label: 'object', path: [...goal, 'object'], words: (at(['scene', 'objects']) ?? []).map((one) => one?.name), now: at([...goal, 'object']), plain: true },
        ...place,
        ...(goal === path
          ? [numeric('tolerance', own('tolerance'), { step: 0.001 })]
          : [numeric('share', own('share'), { unit: '', step: 0.01, may: true })]),
        numeric('heading', own('heading_deg'), { unit: '°', step: 5, may: true }),
        ...(goal === path ? [numeric('heading tolerance', own('heading_tolerance_deg'), { unit: '°', step: 1, may: true })] : []),
      ];
    case 'reach':
      return ['min', 'max'].map((end) => numeric(`${end === 'min' ? 'smallest' : 'largest'} reach`, ['robot', 'reach', end], { may: end === 'min' }));
    case 'home':
      return [numeric('x', own(0)), numeric('y', own(1))];
    default:
      return [];
  }
}

/** Updates the values of the fields, and rebuilds the fields if another item is selected. */
export function drawForm() {
  const form = byId('form');
  const thing = chosenThing();
  const fields = thing && task.values ? fieldsOf(thing) : [];
  const now = JSON.stringify([thing?.id, fields.map(({ path, words }) => [path, words])]);
  if (now !== shown) {
    shown = now;
    form.replaceChildren();
    if (thing) {
      const title = { goal: `Goal of ${thing.name}`, reach: 'Robot', home: 'Home of the end effector' }[thing.kind] ?? thing.name;
      form.append(html('h3', {}, title), ...fields.map(fieldShape));
    }
  }
  fields.forEach((field, k) => {
    const input = form.querySelectorAll('input, select')[k];
    // A field that is being edited is not overwritten.
    if (input !== document.activeElement || input.tagName === 'SELECT') input.value = field.now ?? at(field.path) ?? '';
  });
}

function fieldShape(field) {
  const { label, path, unit, words } = field;
  const input = words
    ? html('select', {}, ...words.map((word) => html('option', { value: word }, word)))
    : html('input', field.word ? { type: 'text' } : { type: 'number', step: 'any', inputmode: 'decimal' });
  input.addEventListener('change', () => write(field, input));
  if (!words && !field.word) {
    // Arrow keys step by a size that suits the quantity.
    input.addEventListener('keydown', (event) => {
      const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!sign) return;
      event.preventDefault();
      input.value = +(Number(input.value) + sign * field.step).toFixed(4);
      write(field, input, `step ${path.join('.')}`);
    });
  }
  return html('label', {}, unit ? `${label}, ${unit}` : label, input);
}

function write(field, input, steady = null) {
  const { value } = input;
  if (field.words && !field.plain) change([{ path: field.path, value: SHAPES[value] }], 'form');
  else if (field.label === 'name') rename(field.path, value);
  else if (field.words || field.word) change([{ path: field.path, value }], 'form');
  else if (value !== '' && Number.isFinite(Number(value))) change([{ path: field.path, value: Number(value) }], 'form', steady);
  else if (field.may && at(field.path) !== undefined) change([{ path: field.path }], 'form');
  else drawForm();
}

/** Renames an object and all references to it. */
function rename(path, name) {
  const before = at(path);
  const edits = [{ path, value: name }];
  const goals = at(['goal']);
  const named = (value, where) => { if (value === before) edits.push({ path: where, value: name }); };
  if (Array.isArray(goals)) goals.forEach((goal, k) => named(goal?.object, ['goal', k, 'object']));
  else named(goals?.object, ['goal', 'object']);
  (at(['scene', 'joints']) ?? []).forEach((joint, k) => (joint?.between ?? []).forEach((one, side) => named(one, ['scene', 'joints', k, 'between', side])));
  change(edits, 'form');
}

/** Draws a checkbox for each tool that the task could allow. */
export function drawTools() {
  const allowed = at(['tools']);
  const all = allowed === 'all';
  const names = task.levers ? [...known.lever, ...known.push] : known.push;
  const box = (name, checked, wanted) => {
    const input = html('input', { type: 'checkbox', 'data-tool': name });
    input.checked = checked;
    input.addEventListener('change', () => change([{ path: ['tools'], value: wanted(input.checked) }], 'tools'));
    return html('label', {}, input, ` ${name}`);
  };
  const list = Array.isArray(allowed) ? allowed : [];
  const focused = document.activeElement?.dataset?.tool;
  byId('tools').replaceChildren(
    box('all', all, (on) => (on ? 'all' : names.slice(0, 1))),
    ...[...new Set([...names, ...list])].map((name) => box(name, all || list.includes(name), (on) => {
      const before = all ? names : list;
      return on ? [...before, name] : before.filter((one) => one !== name);
    })),
  );
  if (focused) byId('tools').querySelector(`[data-tool="${CSS.escape(focused)}"]`)?.focus();
}
