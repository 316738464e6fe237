// Text editor of the task file, with errors marked at their lines.

import { task, write } from './task.js';

const area = byId('text');
const lines = byId('lines');

export function begin() {
  area.addEventListener('input', () => write(area.value, 'text', 'typing'));
  area.addEventListener('scroll', () => { lines.scrollTop = area.scrollTop; });
}

export function drawText(from) {
  if (from !== 'text' && area.value !== task.text) {
    const { scrollTop, scrollLeft } = area;
    area.value = task.text;
    Object.assign(area, { scrollTop, scrollLeft });
  }
  const faulty = new Set(task.faults.map(({ line }) => line));
  const count = task.text.split('\n').length;
  lines.replaceChildren(...Array.from({ length: count }, (_, k) => {
    const mark = html('span', faulty.has(k + 1) ? { class: 'faulty' } : {}, `${k + 1}`);
    return k ? html('span', {}, '\n', mark) : mark;
  }));
  lines.scrollTop = area.scrollTop;
  area.setAttribute('aria-invalid', task.faults.length > 0);
  byId('faults').replaceChildren(...task.faults.map(faultShape));
}

function faultShape({ line, column, message, advice }) {
  const item = html('li');
  if (line) {
    const button = html('button', { type: 'button' }, `line ${line}`);
    button.addEventListener('click', () => jump(line, column ?? 1));
    item.append(button);
  }
  item.append(message, ...(advice ? [html('span', { class: 'faint' }, `: ${advice}`)] : []));
  return item;
}

/** Selects the rest of a line from a column on. */
function jump(line, column) {
  const before = task.text.split('\n').slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
  const rest = task.text.slice(before).split('\n')[0];
  // Columns count characters, and some characters have two UTF-16 units.
  const ahead = [...rest].slice(0, column - 1).join('').length;
  area.focus();
  area.setSelectionRange(before + ahead, before + rest.length);
  area.scrollTop = Math.max(0, (line - 4) * 19.5);
}
