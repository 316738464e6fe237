// The page: a task, shown as a table, as fields and as a file, and its plans.

import { library, load } from './core.js';
import { Planner } from './planner.js';
import { task, change, fileName, onChange, undo, redo, canUndo, canRedo, write } from './task.js';
import { packed, unpacked } from './link.js';

const FIRST = 'pull-back-behind-wall';
/** Pause in editing after which the link is updated, milliseconds. */
const PAUSE = 300;

/** Texts of the shipped tasks by name. */
const shipped = new Map();
let whole = null; // the request for a plan with its report
let drafting = null; // the request for a draft with the usual budgets
let paged = null; // the answer whose report is shown
let version = 0;
let cancelled = -1; // the version of the task whose plan was cancelled last

async function main() {
  const module = await load();
  // These modules call the library when they are loaded.
  const [table, form, text, things] = await Promise.all(['table', 'form', 'text', 'things'].map((name) => import(`./${name}.js`)));
  const planner = new Planner(module, 2);
  for (const name of library.examples()) shipped.set(name, library.example(name));
  shipped.set('bare table', library.bare());
  byId('example').append(...[...shipped.keys()].map((name) => html('option', { value: name }, name)),
    html('option', { value: '', hidden: '' }, 'your own'));

  table.begin(() => form.drawForm());
  text.begin();
  onChange((from) => {
    version += 1;
    text.drawText(from);
    table.draw();
    form.drawForm();
    form.drawTools();
    byId('undo').disabled = !canUndo();
    byId('redo').disabled = !canRedo();
    byId('plan').disabled = !task.sound;
    byId('example').value = exampleOf(task.text) ?? '';
    keepLink();
    forget();
    if (byId('live').checked && task.sound) draft();
  });

  /** Returns a request for the present task. */
  const wish = (more) => {
    const example = exampleOf(task.text, true) ?? '';
    const file = example ? `${example}.yaml` : fileName();
    return { text: task.text, file, example, version, since: performance.now(), ...more };
  };

  /** Plans with few budgets, and then with the usual ones of a draft. */
  function draft(effort = 'first look') {
    const own = wish({ effort, whole: false });
    const first = effort !== 'draft';
    if (!first) drafting = own;
    own.done = ({ answer, broken }) => {
      if (!first) drafting = null;
      // Only the answer for the present task is shown, and none after it was cancelled.
      if (own.version !== version || version === cancelled) return;
      const found = !broken && !answer.fault;
      // A first look that finds nothing proves nothing.
      if (found && (!first || answer.summary.status === 'solved')) {
        take({ ...answer, version: own.version, effort, took: performance.now() - own.since });
      } else if (!first) headline(answer?.fault ?? `the draft failed: ${broken}`, 'bad');
      if (first && !whole) draft('draft');
    };
    if (first) headline('planning …', 'waiting');
    planner.planLive(own);
  }

  function plan() {
    if (whole) planner.cancel(whole);
    const own = wish({ effort: byId('effort').value, whole: true });
    whole = own;
    own.progress = ({ stage, done, total, soFar }) => {
      const count = total > 0 ? `, ${done} of ${total}` : '';
      byId('stage-of-work').textContent = stage + count + (soFar ? ` (so far ${soFar})` : '');
      const bar = byId('progress');
      if (total > 0) bar.value = done / total;
      else bar.removeAttribute('value');
    };
    own.done = ({ answer, broken }) => {
      ended();
      if (broken || answer.fault) headline('');
      if (broken) trouble(`The planner crashed: ${broken}. This is a bug; please report it with the link in the address bar.`);
      else if (answer.fault) trouble(answer.fault);
      else take({ ...answer, version: own.version, effort: own.effort, took: performance.now() - own.since, whole: true });
    };
    trouble('');
    headline('planning …', 'waiting');
    for (const id of ['cancel', 'progress']) byId(id).hidden = false;
    byId('progress').removeAttribute('value');
    byId('stage-of-work').textContent = 'planning';
    planner.plan(own);
  }

  function ended() {
    whole = null;
    for (const id of ['cancel', 'progress']) byId(id).hidden = true;
    byId('stage-of-work').textContent = '';
  }

  function headline(text, className = '') {
    byId('answer').textContent = text;
    byId('answer').className = className;
  }

  /** Shows an answer; one for an older task only as a report. */
  function take(answer) {
    const { summary } = answer;
    if (answer.version === version) {
      table.show(summary);
      headline(`${summary.headline} (${answer.effort}, ${(answer.took / 1000).toFixed(2)} s)`, summary.status === 'solved' ? '' : 'bad');
    }
    if (answer.whole) {
      paged = answer;
      byId('words').hidden = false;
      byId('words-text').textContent = answer.words;
      byId('save-plan').hidden = !answer.plan;
      const frame = byId('page');
      frame.hidden = !answer.page;
      frame.srcdoc = answer.page;
    }
    age();
  }

  /** Removes the answer for an older task, and ends a draft for it. */
  function forget() {
    if (drafting) planner.cancel(drafting);
    drafting = null;
    table.show(null);
    headline('');
    age();
  }

  /** Marks a report of an older task. */
  function age() {
    byId('page').classList.toggle('stale', Boolean(paged) && paged.version !== version);
  }

  byId('page').addEventListener('load', () => {
    const { body } = byId('page').contentDocument;
    new ResizeObserver(() => { byId('page').style.height = `${body.scrollHeight + 30}px`; }).observe(body);
  });
  byId('plan').addEventListener('click', plan);
  byId('cancel').addEventListener('click', () => {
    planner.cancel(whole);
    if (drafting) planner.cancel(drafting);
    drafting = null;
    cancelled = version;
    ended();
    headline('cancelled');
  });
  byId('example').addEventListener('change', ({ target }) => {
    write(shipped.get(target.value), 'load');
    table.chosen.id = 'goal-0';
    table.fit();
    form.drawForm();
  });
  const add = (kind) => () => {
    change(things.added(kind), 'form');
    const own = things.things().filter((thing) => thing.kind === kind).at(-1);
    if (own) table.chosen.id = own.id;
    table.draw();
    form.drawForm();
  };
  byId('add-object').addEventListener('click', add('object'));
  byId('add-obstacle').addEventListener('click', add('obstacle'));
  byId('fit').addEventListener('click', table.fit);
  byId('undo').addEventListener('click', undo);
  byId('redo').addEventListener('click', redo);
  byId('save-task').addEventListener('click', () => save(fileName(), task.text, 'text/yaml'));
  byId('save-plan').addEventListener('click', () => save(fileName().replace('.yaml', '.plan.json'), paged.plan, 'application/json'));
  byId('form').addEventListener('submit', (event) => event.preventDefault());
  byId('copy-link').addEventListener('click', copyLink);
  document.addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z') return;
    if (['INPUT', 'TEXTAREA'].includes(event.target.tagName)) return;
    event.preventDefault();
    if (event.shiftKey) redo();
    else undo();
  });
  addEventListener('hashchange', () => open(table, form));

  await open(table, form);
  byId('foot').textContent = 'The planner runs in your browser.';
  document.documentElement.dataset.ready = Math.round(performance.now());
}

/** Shows the task in the URL. */
async function open(table, form) {
  let found = {};
  try {
    found = await unpacked(location.hash.slice(1));
    if (found.example && !shipped.has(found.example)) throw new Error(`no shipped task is called ${found.example}`);
  } catch (error) {
    trouble(error.message);
  }
  const text = found.text ?? shipped.get(found.example ?? FIRST) ?? shipped.get(FIRST);
  if (text === task.text) return;
  write(text, 'load');
  table.fit();
  form.drawForm();
}

/** Returns the name of the shipped task that equals a text; with `known`, only a task of the command. */
function exampleOf(text, known = false) {
  for (const [name, own] of shipped) if (own === text) return known && name.includes(' ') ? undefined : name;
  return undefined;
}

const linkPart = async () => {
  const example = exampleOf(task.text);
  return example ? `example=${encodeURIComponent(example)}` : packed(task.text);
};

let linking = 0;
function keepLink() {
  clearTimeout(linking);
  linking = setTimeout(async () => history.replaceState(null, '', `#${await linkPart()}`), PAUSE);
}

async function copyLink() {
  const link = `${location.href.split('#')[0]}#${await linkPart()}`;
  history.replaceState(null, '', link);
  try {
    await navigator.clipboard.writeText(link);
    byId('copy-link').textContent = 'Copied';
  } catch {
    byId('copy-link').textContent = 'Copy it from the address bar';
  }
  setTimeout(() => { byId('copy-link').textContent = 'Copy link'; }, 2000);
}

function save(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  html('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

function trouble(message) {
  byId('trouble').textContent = message;
  byId('trouble').hidden = !message;
}

main().catch((error) => {
  trouble(`This browser cannot run the planner (${error.message}). It needs WebAssembly with relaxed SIMD: Chrome or Edge 114 or newer, or Firefox 145 or newer.`);
  byId('foot').textContent = '';
});
