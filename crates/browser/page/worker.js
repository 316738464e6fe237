// Worker that plans one task after the other. The page cancels it by terminating it.

import init, { solve } from './library.js';

let reported = 0;
let stage = '';
let soFar = '';
globalThis.pushplanProgress = (what, done, total) => {
  stage = what || stage;
  // The page shows at most 20 updates per second.
  const now = performance.now();
  if (!what && now - reported < 50) return;
  reported = now;
  postMessage({ stage, done, total, soFar });
};
globalThis.pushplanSoFar = (plan) => { soFar = plan; };
let defect = '';
globalThis.pushplanFailed = (message) => { defect = message; };

addEventListener('message', async ({ data }) => {
  if (data.module) {
    await init({ module_or_path: data.module });
    postMessage({ ready: true });
    return;
  }
  soFar = '';
  try {
    const solved = solve(data.text, data.file, data.example, data.effort);
    const answer = { summary: JSON.parse(solved.summary()) };
    if (data.whole) Object.assign(answer, { words: solved.text(), page: solved.page(), plan: solved.plan() });
    solved.free();
    postMessage({ answer });
  } catch (error) {
    // Faults of a task are strings; anything else is a defect, after which the state is undefined.
    if (typeof error === 'string') postMessage({ answer: { fault: error } });
    else postMessage({ broken: defect || String(error) });
  }
});
