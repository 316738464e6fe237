// Every shipped task, in the browser and by the command with one thread.

const { execFileSync } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

/** Tolerance of plans with `draft`. */
const SAME = 1e-9;
/** Tolerance of final positions, metres: sines and sums are rounded differently. */
const NEAR = 1e-4;

/** Tasks whose drafts differ by more than `SAME`, but have equal tools and near final positions. */
const ROUNDED = [
  'cover-the-mark', 'diagonal', 'drawer-or-box', 'everything-hidden', 'fork-beside-plate', 'hexagon-any-side',
  'hinged-train', 'narrow-gap', 'one-or-two', 'pull-back-behind-wall', 'reference-chain', 'taken-place',
  'triangle-turned', 'turn-the-box', 'two-places', 'unknown-slide', 'wide-sweep',
];

/**
 * Tasks whose plans or final positions differ, by effort; their answers are equal and both plans are verified.
 * With `standard`, the plans of the last two are equal, and the predicted final poses differ.
 */
const KNOWN = {
  draft: ['around-corner', 'drawer', 'handle-to-the-front', 'push-out-of-reach'],
  standard: [
    'around-corner', 'drawer', 'everything-hidden', 'handle-to-the-front', 'push-out-of-reach', 'drive-board',
    'flip-plate',
  ],
};

/** Returns the command's answer for a shipped task, and its plan. */
function commanded(name, effort, folder) {
  const words = ['solve', '--example', name, '--effort', effort, '--threads', '1', '--json', '--quiet', '--out', folder];
  let text;
  try {
    text = execFileSync(process.env.PUSHPLAN, words, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'ignore'] });
  } catch (error) {
    // The answer may be that there is no plan.
    text = error.stdout;
  }
  const { status, plans, statistics } = JSON.parse(text);
  return { status, steps: plans[0]?.plan.steps ?? [], ends: plans[0]?.predicted, seconds: statistics.timing.total };
}

/** Angles of a step, compared modulo a full rotation. */
const ANGLES = ['direction', 'grip_yaw'];

/** Returns the largest difference of corresponding numbers; infinity if anything else differs. */
function apart(a, b, key = '') {
  if (typeof a === 'number' && typeof b === 'number') {
    const off = Math.abs(a - b);
    return ANGLES.includes(key) ? Math.min(off, Math.abs(2 * Math.PI - off)) : off;
  }
  if (a === null || b === null || typeof a !== 'object' || typeof b !== 'object') return a === b ? 0 : Infinity;
  const keys = new Set([...Object.keys(a), ...Object.keys(b)]);
  return Math.max(0, ...[...keys].map((key) => (key in a && key in b ? apart(a[key], b[key], key) : Infinity)));
}

/** Returns the final positions of an outcome, metres. */
const places = (outcome) => outcome?.state.poses.map(({ position }) => position) ?? [];

const tools = (steps) => steps.map((step) => Object.values(step)[0].tool ?? step.tool).join(' ');

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted.length ? sorted[Math.floor(sorted.length / 2)] : NaN;
};

/** Returns a line for each difference beyond its tolerance; prints every task. */
async function tasks(browser, address, [only, ...efforts]) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'playground-'));
  const page = await browser.newPage();
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  await page.evaluate(async () => {
    const [{ load, library }, { Planner }] = await Promise.all([import('./core.js'), import('./planner.js')]);
    const planner = new Planner(await load(), 1);
    globalThis.names = library.examples();
    globalThis.solved = (name, effort) => new Promise((done) => {
      planner.plan({ text: library.example(name), file: `${name}.yaml`, example: name, effort, whole: true, done });
    });
  });
  const names = (await page.evaluate(() => globalThis.names)).filter((name) => !only || only === 'all' || only.split(',').includes(name));
  const wrong = [];
  for (const effort of efforts.length ? efforts : ['draft', 'standard']) {
    const times = [];
    const count = { answer: 0, plan: 0, end: 0 };
    console.log(`\n${effort}: task, answer, difference of the plan, of its end in mm, seconds here and by the command`);
    for (const name of names) {
      const command = commanded(name, effort, folder);
      const heard = await page.evaluate(([name, effort]) => globalThis.solved(name, effort), [name, effort]);
      if (heard.broken || heard.answer.fault) {
        wrong.push(`${effort} ${name}: ${heard.broken ?? heard.answer.fault}`);
        continue;
      }
      const { summary, plan } = heard.answer;
      const own = plan ? JSON.parse(plan) : { plan: { steps: [] }, predicted: null };
      const { steps } = own.plan;
      const plans = apart(steps, command.steps);
      const ends = apart(places(own.predicted), places(command.ends));
      times.push([summary.seconds, command.seconds]);
      const near = tools(steps) === tools(command.steps) && steps.length === command.steps.length && ends <= NEAR;
      const same = effort === 'draft' ? plans <= SAME || (near && ROUNDED.includes(name)) : near;
      count.answer += summary.status === command.status;
      count.plan += plans <= SAME;
      count.end += near;
      const known = KNOWN[effort]?.includes(name) ?? false;
      const fits = summary.status === command.status && (same || known);
      const mark = !fits ? '!' : !same ? '~' : ' ';
      console.log(`${mark} ${name.padEnd(24)} ${summary.status.padEnd(20)} ${plans.toExponential(1).padStart(9)} `
        + `${(1e3 * ends).toFixed(4).padStart(9)} ${summary.seconds.toFixed(3).padStart(8)} ${command.seconds.toFixed(3).padStart(8)}`);
      if (!fits) wrong.push(`${effort} ${name}: ${summary.status} with ${tools(steps)}, by the command ${command.status} with ${tools(command.steps)}; plans differ by ${plans}, ends by ${ends} m`);
    }
    const [here, there] = [0, 1].map((k) => median(times.map((pair) => pair[k])));
    console.log(`${effort}: of ${names.length} tasks, ${count.answer} same answers, ${count.plan} same plans, ${count.end} same tools and ends`);
    console.log(`${effort}: median ${here.toFixed(3)} s here, ${there.toFixed(3)} s by the command; `
      + `median of the ratios ${median(times.map(([a, b]) => a / b)).toFixed(2)}`);
  }
  await page.close();
  fs.rmSync(folder, { recursive: true });
  return wrong;
}

module.exports = { tasks };
