// Operation of the page: by pointer, by key, by link, on a phone.

const READY = 1000; // milliseconds from opening to ready
/** Time from a move of the goal to its plan, milliseconds, median of the shipped tasks, on two free cores. */
const AGAIN = Number(process.env.PUSHPLAN_AGAIN ?? 300);

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

async function opened(browser, address, size = { width: 1280, height: 900 }) {
  const page = await browser.newPage({ viewport: size });
  const complaints = [];
  page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('request', (request) => { if (!/^(http:\/\/127\.0\.0\.1|blob:|data:|about:)/.test(request.url())) complaints.push(`asks ${request.url()}`); });
  await page.goto(address);
  await page.waitForFunction(() => document.documentElement.dataset.ready || !document.getElementById('trouble').hidden);
  return { page, complaints, ready: Number(await page.evaluate(() => document.documentElement.dataset.ready)) };
}

const text = (page) => page.locator('#text').inputValue();
const shown = (page, id) => page.locator(id).textContent();

/** Drags an item by pixels, and releases it. */
async function drag(page, id, by, steps = 4) {
  const box = await page.locator(`[data-id="${id}"] .body`).boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by[0], y + by[1], { steps });
  await page.mouse.up();
}

/** Returns the message of the page if its file is opened. */
async function openedAsFile(browser, folder) {
  const page = await browser.newPage();
  await page.goto(require('node:url').pathToFileURL(`${folder}/index.html`).href);
  await page.waitForTimeout(500);
  const words = await page.locator('#trouble').textContent();
  await page.close();
  return words;
}

async function usedAsPeopleDo(browser, address, folder) {
  const wrong = [];
  const check = (holds, what) => {
    console.log(`${holds ? ' ' : '!'} ${what}`);
    if (!holds) wrong.push(what);
  };

  const { page, complaints, ready } = await opened(browser, address);
  const times = [ready];
  for (let k = 0; k < 4; k++) {
    const again = await opened(browser, address);
    times.push(again.ready);
    await again.page.close();
  }
  check(median(times) <= READY, `ready in ${median(times)} ms, median of ${times.length}`);

  // On opening, the first task is drafted, with tool, hand, final poses and base.
  const drafted = (own) => own.waitForFunction(() => /\(draft, /.test(document.getElementById('answer').textContent), null, { timeout: 60000 });
  await drafted(page);
  for (const part of ['.tool.before .fill', '.tool.after .hand', '.end-of-plan', '.base']) {
    check((await page.locator(`#table ${part}`).count()) > 0, `the first draft shows ${part}`);
  }
  const told = await page.evaluate(() => {
    const goal = document.querySelector('[data-id="goal-0"]');
    goal.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowUp', bubbles: true }));
    return [document.getElementById('answer').textContent, document.querySelectorAll('#table .push').length];
  });
  check(told[0] === 'planning …' && told[1] === 0, `an edit removes the old answer: ${told}`);
  await page.locator('#undo').click();

  // Pointer: the file is updated, its comments are kept, and a draft is planned.
  const before = await text(page);
  await drag(page, 'goal-0', [40, 20]);
  const after = await text(page);
  check(after !== before && after.split('\n').length === before.split('\n').length, 'a drag changes numbers alone');
  check(before.split('\n').filter((line, k) => line !== after.split('\n')[k]).length === 1, 'a drag changes one line');
  await drafted(page);
  check((await page.locator('#table .push').count()) > 0, 'a draft is drawn on the table');
  await page.locator('#undo').click();
  check((await text(page)) === before, 'undo brings the text back');

  check(/python3 -m http.server/.test(await openedAsFile(browser, folder)), 'opened as a file, the page states how to serve it');

  // Keyboard, and the description of the item.
  await page.locator('[data-id="goal-0"]').focus();
  await page.keyboard.press('ArrowUp');
  check((await text(page)) !== before, 'an arrow key moves the focused item');
  check(/goal of .* at x/.test(await shown(page, '#where')), `description: ${await shown(page, '#where')}`);
  await page.locator('#undo').click();

  // A fault at its line.
  await page.locator('#text').fill(before.replace('friction', 'fricton'));
  check((await page.locator('#faults li').count()) > 0 && (await page.locator('#lines .faulty').count()) > 0, 'an error is marked at its line');
  check(await page.locator('#plan').isDisabled(), 'a faulty task cannot be planned');
  await page.locator('#text').fill(before);

  // A plan with its report.
  await page.locator('#plan').click();
  await page.waitForFunction(() => /standard, /.test(document.getElementById('answer').textContent), null, { timeout: 60000 });
  check(/solved/.test(await shown(page, '#answer')), `planned: ${await shown(page, '#answer')}`);
  const frame = page.frameLocator('#page');
  await frame.locator('#play').waitFor();
  check(/pushplan predict/.test(await frame.locator('#command').textContent()), 'the page offers a command');
  check((await frame.locator('#tools tr').count()) > 2, 'the page explains why other tools were rejected');

  // Fields, additions and removals.
  await page.locator('#add-obstacle').click();
  check(/wall-1/.test(await text(page)), 'a wall is added');
  await page.locator('#form label', { hasText: 'width y' }).locator('input').fill('0.31');
  await page.keyboard.press('Enter');
  check(/size: \[0.04, 0.31, 0.1\]/.test(await text(page)), 'a field changes the file');
  await page.locator('[data-id^="obstacle"].chosen').focus();
  await page.keyboard.press('Delete');
  check(!/wall-1/.test(await text(page)), 'Delete removes it');

  // A link holds the task.
  await drag(page, 'goal-0', [15, 15]);
  await page.waitForTimeout(600);
  const [link, own] = [page.url(), await text(page)];
  const second = await opened(browser, link);
  check((await text(second.page)) === own && /#task=/.test(link), `a link of ${link.length} letters holds the task`);
  await second.page.close();
  const cut = await opened(browser, link.slice(0, -9));
  check(/damaged/.test(await shown(cut.page, '#trouble')), 'a truncated link is reported');
  await cut.page.close();
  // The first is refused by its length, the second while it is unpacked.
  const unpacks = require('node:zlib').deflateRawSync(Buffer.alloc(150e6)).toString('base64url');
  for (const [part, what] of [['A'.repeat(800000), 'a long link'], [unpacks, 'a link that unpacks to 150 MB']]) {
    const long = await opened(browser, `${address}#task=${part}`);
    check(/too long/.test(await shown(long.page, '#trouble')), `${what} is refused`);
    await long.page.close();
  }

  // Cancelled.
  await page.locator('#example').selectOption('crowd');
  await page.locator('#plan').click();
  await page.locator('#cancel').click();
  check((await shown(page, '#answer')) === 'cancelled', 'it can be cancelled');
  await page.waitForTimeout(500);
  check((await shown(page, '#answer')) === 'cancelled', 'and stays so');

  // All shipped tasks: the goal is moved by 1 cm, as by key, and a plan follows.
  await page.locator('#tools-of-task').evaluate((details) => { details.open = true; });
  const latencies = [];
  for (const name of await page.locator('#example option').evaluateAll((all) => all.map((one) => one.value).filter(Boolean))) {
    await page.locator('#example').selectOption(name);
    // The draft of the task itself comes first.
    await drafted(page);
    const goal = page.locator('[data-id="goal-0"]');
    if (!(await goal.count())) continue;
    await goal.focus();
    const took = await page.evaluate(() => new Promise((resolve) => {
      const since = performance.now();
      const answer = document.getElementById('answer');
      const observer = new MutationObserver(() => {
        if (!/\((first look|draft), /.test(answer.textContent)) return;
        observer.disconnect();
        resolve(performance.now() - since);
      });
      answer.textContent = '';
      observer.observe(answer, { childList: true, attributes: true });
      document.activeElement.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowDown', bubbles: true }));
      setTimeout(() => { observer.disconnect(); resolve(Infinity); }, 20000);
    }));
    latencies.push([name, took]);
    await drafted(page);
  }
  console.log(latencies.map(([name, took]) => `    ${name.padEnd(24)} ${took.toFixed(0).padStart(6)} ms`).join('\n'));
  check(median(latencies.map(([, took]) => took)) <= AGAIN, `a plan after each move: median ${median(latencies.map(([, took]) => took)).toFixed(0)} ms of ${latencies.length} tasks`);
  check(complaints.length === 0, `no complaints ${[...new Set(complaints)].slice(0, 5).join('; ')}`);
  await page.close();

  // On a phone nothing overflows, and every control has a name.
  const phone = await opened(browser, address, { width: 360, height: 700 });
  const wide = await phone.page.evaluate(() => document.documentElement.scrollWidth);
  check(wide <= 360, `on a phone the page is ${wide} px wide`);
  const nameless = await phone.page.evaluate(() => [...document.querySelectorAll('button, input, select, textarea, iframe, [role=button]')]
    .filter((one) => !(one.ariaLabel || one.title || one.textContent.trim() || one.labels?.length)).map((one) => one.outerHTML));
  check(nameless.length === 0, `everything has a name ${nameless.join(' ')}`);
  await phone.page.close();
  return wrong;
}

module.exports = { usedAsPeopleDo };
