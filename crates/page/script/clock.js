// View state: the plan, the visible layers, and the time that all drawings share.

const view = { plan: 0, time: 0, playing: false, speed: 1, hidden: new Set(), graph: false };
const whenPlanChanges = [];
const whenTimeChanges = [];
/** Actions of keys, by key name. */
const keys = {};

const plan = () => page.plans[view.plan];
const replays = () => replaysOf(plan());
const shown = () => replays().filter((replay) => !view.hidden.has(replay.layer));
/** The replay that is drawn solid: the one closest to reality. */
const leading = () => shown().at(-1) ?? replays().at(-1);
const duration = () => Math.max(0, ...replays().map((replay) => replay.end));

function showTime(time) {
  view.time = Math.min(Math.max(time, 0), duration());
  for (const draw of whenTimeChanges) draw();
}

function showPlan(index) {
  view.plan = index;
  for (const draw of whenPlanChanges) draw();
  showTime(view.time);
}

function play(playing) {
  view.playing = playing && duration() > 0;
  if (view.playing && view.time >= duration()) showTime(0);
  let before = performance.now();
  const tick = (now) => {
    if (!view.playing) return;
    const next = view.time + ((now - before) / 1000) * view.speed;
    before = now;
    if (next >= duration()) view.playing = false;
    showTime(next);
    if (view.playing) requestAnimationFrame(tick);
    else keepLink();
  };
  if (view.playing) requestAnimationFrame(tick);
  showTime(view.time);
  keepLink();
}

/** Moves by a number of frames of the leading replay. */
function step(frames) {
  play(false);
  const replay = leading();
  if (!replay) return;
  const [frame, share] = replay.place(view.time);
  // Between two frames, a step back leads to the start of the current one.
  let next = frame + frames + (frames < 0 && share > 1e-9 ? 1 : 0);
  // Two successive pushes of a run share a frame time.
  while (next > 0 && frames < 0 && replay.time[next] >= view.time) next--;
  const last = replay.time.length - 1;
  showTime(next > last ? duration() : replay.time[Math.max(0, next)]);
  keepLink();
}

function toggle(layer) {
  if (!replays().some((replay) => replay.layer === layer)) return;
  if (!view.hidden.delete(layer)) view.hidden.add(layer);
  showPlan(view.plan);
  keepLink();
}

/** The prediction with a graph, if any. */
const graphed = () => replays().find((replay) => replay.graph);

function toggleGraph() {
  if (!graphed()) return;
  view.graph = !view.graph;
  showPlan(view.plan);
  keepLink();
}
keys.g = toggleGraph;

/** The part of a link behind `#`: `t=1.5&plan=2&hide=planar`. */
function linkPart() {
  const parts = [`t=${+view.time.toFixed(3)}`];
  if (page.plans.length > 1) parts.push(`plan=${view.plan + 1}`);
  if (view.hidden.size) parts.push(`hide=${[...view.hidden].join(',')}`);
  if (view.graph) parts.push('graph=1');
  return parts.join('&');
}

function keepLink() {
  try {
    history.replaceState(null, '', `#${linkPart()}`);
  } catch {
    // Some embedding frames do not allow changes of the address; only the link is lost.
  }
}

function followLink() {
  const parts = new URLSearchParams(location.hash.slice(1));
  const index = Number.parseInt(parts.get('plan') ?? '1', 10) - 1;
  const time = Number.parseFloat(parts.get('t') ?? '0');
  const hidden = (parts.get('hide') ?? '').split(',').filter((layer) => layer in LAYERS);
  view.playing = false;
  view.hidden = new Set(hidden);
  view.graph = parts.get('graph') === '1';
  view.time = Number.isFinite(time) ? time : 0;
  showPlan(index >= 0 && index < page.plans.length ? index : 0);
}
