// The task: its text, what that says, and its changes. Everything else follows it.

import { library } from './core.js';

/** What the text says: `values` as they stand there, `stage` as the library draws it, `faults`. */
export const task = { text: '', values: null, stage: null, faults: [], levers: false, sound: false };

const whenChanged = [];
const past = [];
const future = [];
/** A number or position that goes on changing is one step back. */
let group = null;

/** `hear(from)` is called after every change; `from` says who made it. */
export const onChange = (hear) => whenChanged.push(hear);

export const fileName = () => `${name()}.yaml`;

function name() {
  const own = task.values?.name;
  return typeof own === 'string' && /^[\w-]{1,64}$/u.test(own) ? own : 'my-task';
}

/** A new text; `steady` says of what it is the same change as the last one. */
export function write(text, from, steady = null) {
  if (text === task.text) return;
  if (task.text && !(steady && steady === group)) past.push(task.text);
  group = steady;
  future.length = 0;
  take(text, from);
}

/** Changes of values, as the library makes them in the text. */
export function change(edits, from, steady = null) {
  write(library.edit(task.text, fileName(), JSON.stringify(edits)), from, steady);
}

export const canUndo = () => past.length > 0;
export const canRedo = () => future.length > 0;

export function undo() {
  if (!canUndo()) return;
  future.push(task.text);
  group = null;
  take(past.pop(), 'undo');
}

export function redo() {
  if (!canRedo()) return;
  past.push(task.text);
  group = null;
  take(future.pop(), 'undo');
}

/** Ends a change that goes on, such as a drag. */
export const settle = () => { group = null; };

/** The value at the end of a path, if there is one. */
export const at = (path) => path.reduce((value, step) => value?.[step], task.values);

function take(text, from) {
  const seen = JSON.parse(library.look(text, fileName()));
  // Where a text says nothing that can be drawn, the last that could stands still.
  const stage = seen.stage ?? task.stage;
  Object.assign(task, seen, { text, stage, sound: seen.faults.length === 0 });
  for (const hear of whenChanged) hear(from);
}
