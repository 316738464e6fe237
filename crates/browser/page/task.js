// The task: its text, its content, and its changes. Everything else is derived from it.

import { library } from './core.js';

/** Content of the text: `values` as written, `stage` as drawn by the library, and `faults`. */
export const task = { text: '', values: null, stage: null, faults: [], levers: false, sound: false };

const whenChanged = [];
const past = [];
const future = [];
/** Name of a continuous change, which is undone in one step. */
let group = null;

/** Registers `hear(from)`, which is called after every change; `from` names its source. */
export const onChange = (hear) => whenChanged.push(hear);

export const fileName = () => `${name()}.yaml`;

function name() {
  const own = task.values?.name;
  return typeof own === 'string' && /^[\w-]{1,64}$/u.test(own) ? own : 'my-task';
}

/** Sets a new text. Changes with an equal name `steady` are undone in one step. */
export function write(text, from, steady = null) {
  if (text === task.text) return;
  if (task.text && !(steady && steady === group)) past.push(task.text);
  group = steady;
  future.length = 0;
  take(text, from);
}

/** Changes values; the library edits the text. */
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

/** Ends a continuous change, such as a drag. */
export const settle = () => { group = null; };

/** Returns the value at the end of a path, if any. */
export const at = (path) => path.reduce((value, step) => value?.[step], task.values);

function take(text, from) {
  const seen = JSON.parse(library.look(text, fileName()));
  // A text that cannot be drawn keeps the last drawing.
  const stage = seen.stage ?? task.stage;
  Object.assign(task, seen, { text, stage, sound: seen.faults.length === 0 });
  for (const hear of whenChanged) hear(from);
}
