// The header, and the tables of layers, results, plans and tools.

(() => {
  const WORDS = {
    passed: 'works', fragile: 'fragile', failed: 'fails', open: 'not verified',
    reached: 'reached', given_up: 'not reached', inferred: 'inferred',
  };

  byId('measure').textContent = measured;
  byId('task').textContent = page.task;
  const [goal] = goals;
  byId('goal').textContent = [page.description, goal && `Goal: ${goal.words}.`, page.models].filter(Boolean).join(' ');

  function head() {
    const { standing, verdict } = plan();
    const badge = byId('badge');
    badge.textContent = WORDS[standing];
    badge.className = `badge ${standing}`;
    const kind = page.run?.kind ?? 'Plan';
    byId('plan').textContent = `${kind}${page.plans.length > 1 ? ` ${view.plan + 1}` : ''}: ${plan().name}.`;
    byId('verdict').textContent = `${verdict[0].toUpperCase()}${verdict.slice(1)}.`;
  }

  function layers() {
    const rows = replays().map((replay, k) => {
      const name = LAYERS[replay.layer];
      const box = html('input', { type: 'checkbox', id: `show-${replay.layer}` });
      box.checked = !view.hidden.has(replay.layer);
      box.addEventListener('change', () => {
        toggle(replay.layer);
        byId(`show-${replay.layer}`).focus();
      });
      return html('div', { class: 'layer' },
        html('label', { title: `${replay.by}; key ${k + 1}` }, box,
          svg('svg', { viewBox: '0 0 26 10', class: 'sample', 'aria-hidden': 'true' },
            svg('path', { d: 'M1 5h24', class: `line ${replay.layer}` })),
          html('span', {}, name)),
        html('output', { id: `error-${replay.layer}`, 'aria-label': `${name}, ${measured.toLowerCase()}` }),
        html('span', { class: 'faint' }, `ends at ${errorWords(replay.error(replay.end))}`));
    });
    if (graphed()) {
      const box = html('input', { type: 'checkbox', id: 'show-graph' });
      box.checked = view.graph;
      box.addEventListener('change', () => {
        toggleGraph();
        byId('show-graph').focus();
      });
      const title = 'Bodies and relations in the network graph. Thick lines: fixed joints; thin lines: hinges; '
        + 'dashed lines: slides; dotted lines: contacts. Key g';
      rows.push(html('div', { class: 'layer' }, html('label', { title }, box, html('span', {}, 'graph'))));
    }
    byId('layers').replaceChildren(...rows);
  }

  function errors() {
    for (const replay of replays()) {
      byId(`error-${replay.layer}`).textContent = errorWords(replay.error(view.time));
    }
    if (goal.heading && !angular) {
      const turned = replays().map((replay) => `${LAYERS[replay.layer]} ${degrees(replay.headingError(view.time))}`);
      const allowed = degrees(goal.heading[1] * FINE);
      byId('heading').textContent = `Heading error: ${turned.join(', ')}; ${allowed} allowed.`;
    }
  }

  /** Marks the columns of numbers: all except the first two and the last one. */
  const numeric = (columns) => Array.from({ length: columns }, (_, c) => c > 1 && c < columns - 1);

  /** Returns a button that opens a plan. */
  function opener(index, text) {
    const button = html('button', { class: 'open', 'aria-label': `Show plan ${index + 1}` }, text);
    button.addEventListener('click', () => {
      play(false);
      showPlan(index);
      keepLink();
    });
    return button;
  }

  function plans() {
    byId('plans-card').hidden = page.plans.length < 2;
    const rows = page.plans.map((one, k) => {
      const cells = one.cells.map((cell, c) => html('td', side(numeric(one.cells.length + 1)[c + 1]), cell));
      return html('tr', {}, html('td', {}, opener(k, `${k + 1}`)), ...cells);
    });
    byId('plans').replaceChildren(headed(['', ...page.columns], numeric(page.columns.length + 1)), ...rows);
  }

  function current() {
    const rows = byId('plans').querySelectorAll('tr:not(:first-child)');
    rows.forEach((row, k) => row.setAttribute('aria-current', k === view.plan));
  }

  function tools() {
    byId('tools-card').hidden = page.choice.length === 0;
    const rows = page.choice.map(({ tool, considered, refused, best, why, plan: index }) => html('tr', {},
      html('td', {}, index === null ? '' : opener(index, `${index + 1}`)),
      html('td', {}, tool),
      html('td', { class: 'number' }, `${considered}`),
      html('td', { class: 'number' }, `${refused}`),
      html('td', { class: 'number' }, best),
      html('td', {}, why)));
    const names = ['', 'tool', 'pushes considered', 'infeasible', 'best score in the search', 'result'];
    byId('tools').replaceChildren(headed(names, numeric(names.length)), ...rows);
  }

  byId('found').replaceChildren(...page.found.map(({ title, columns, numeric: sides, rows }) => html('section', { class: 'card' },
    html('h2', {}, title),
    html('div', { class: 'wide' }, html('table', {}, headed(columns, sides),
      ...rows.map((cells) => html('tr', {}, ...cells.map((cell, c) => html('td', side(sides[c]), cell)))))))));
  byId('warnings-card').hidden = page.warnings.length === 0;
  byId('warnings').replaceChildren(...page.warnings.map((line) => html('li', {}, line)));
  plans();
  tools();
  whenPlanChanges.push(head, current);
  if (!goal) {
    document.querySelector('aside').remove();
    return;
  }
  whenPlanChanges.push(layers);
  whenTimeChanges.push(errors);
})();
