// Pushes considered by the search: their scores, or the reasons why they are infeasible.

(() => {
  const { candidates } = page;
  byId('candidates-card').hidden = !candidates;
  if (!candidates) return;

  const [CELL, GAP] = [20, 2];
  const [NOT_TRIED, BLOCKED, REFUSED] = [-1, -2, -10];
  const STEPS = [0.25, 0.5, 1, 2, 4, 8];
  const [tools, levels] = [byId('candidates-tool'), byId('candidates-level')];

  const { considered, shown: kept } = candidates;
  byId('candidates-words').textContent = 'Rows: push direction. Columns: the part of the tool in contact, and the '
    + 'offset of the object to the left of its middle. Colour: the best predicted score, which is the final '
    + 'error divided by the tolerance. Scores up to 1 reach the goal.'
    + (kept < considered ? ` ${kept} of ${considered} pushes are shown.` : '');

  const unique = (list) => [...new Set(list)];
  const order = page.choice.map(({ tool }) => tool);
  const named = unique(candidates.grids.map(({ tool }) => tool));
  named.sort((a, b) => order.indexOf(a) - order.indexOf(b));
  tools.replaceChildren(...named.map((name) => html('option', { value: name }, name)));
  const counts = unique(candidates.grids.map(({ pushes }) => pushes));
  levels.replaceChildren(...counts.map((count) => html('option', { value: count }, `${count}`)));
  byId('candidates-level-label').hidden = counts.length < 2;

  /** Returns the name of the colour of a cell. */
  function shade(cell) {
    if (cell <= REFUSED) return 'refused';
    if (cell === BLOCKED) return 'blocked';
    if (cell === NOT_TRIED) return 'untried';
    const step = STEPS.findIndex((most) => cell / 100 <= most);
    return `score-${step < 0 ? STEPS.length : step}`;
  }

  /** Returns the description of a cell. */
  function words(cell) {
    if (cell <= REFUSED) return candidates.reasons[REFUSED - cell];
    if (cell === BLOCKED) return 'blocked by an immovable body';
    if (cell === NOT_TRIED) return 'not tried: duplicate, beyond the budget, or never at rest';
    return `score ${(cell / 100).toFixed(2)}, ${cell <= 100 ? 'reaches' : 'misses'} the goal`;
  }

  function grid({ yaw, faces, directions, offsets, cells }) {
    const columns = faces.reduce((sum, [, count]) => sum + count, 0) || 1;
    const rows = Math.ceil(cells.length / columns);
    const [left, top, pitch] = [64, 20, CELL + GAP];
    // Columns of different parts are separated.
    const spaces = [];
    faces.forEach(([, count], k) => { for (let c = 0; c < count; c++) spaces.push(k * 8); });
    const width = left + columns * pitch + faces.length * 8;
    const root = svg('svg', {
      class: 'cells', width, height: top + rows * pitch + 4, role: 'img', 'aria-label': `Grip yaw ${yaw} degrees`,
    });
    let column = 0;
    faces.forEach(([name, count], k) => {
      const x = left + column * pitch + k * 8;
      root.append(svg('text', { x, y: 13, class: 'small' }, name, svg('title', {}, name)));
      column += count;
    });
    for (let row = 0; row < rows; row++) {
      const y = top + row * pitch;
      const heading = directions[row] ?? directions.at(-1);
      root.append(
        svg('path', { d: 'M-7 0h12m-4-4l4 4-4 4', class: 'arrow', transform: `translate(10 ${y + CELL / 2}) rotate(${-heading})` }),
        svg('text', { x: left - 6, y: y + 14, class: 'small end' }, `${heading}°`),
      );
    }
    cells.forEach((cell, k) => {
      const [row, c] = [Math.floor(k / columns), k % columns];
      const [x, y] = [left + c * pitch + (spaces[c] ?? 0), top + row * pitch];
      const name = `${directions[row] ?? directions.at(-1)}°${faces.length && faces[0][0] ? `, offset ${offsets[k]} mm` : ''}: ${words(cell)}`;
      root.append(svg('rect', {
        x, y, width: CELL, height: CELL, rx: 3, class: `cell ${shade(cell)}`, 'data-words': name,
      }, svg('title', {}, name)));
      if (cell <= REFUSED) {
        root.append(svg('text', { x: x + CELL / 2, y: y + 14, class: 'reason' }, `${REFUSED - cell + 1}`));
      }
    });
    return html('figure', {}, html('figcaption', {}, `grip yaw ${yaw}°`), root);
  }

  function draw() {
    const wanted = candidates.grids.filter(({ tool, pushes }) => tool === tools.value && `${pushes}` === levels.value);
    byId('grids').replaceChildren(...wanted.map(grid));
    byId('cell').textContent = 'Point at a cell to see its score or reason.';
    const drawn = wanted.flatMap(({ cells }) => cells);
    const counts = candidates.reasons.map((_, k) => drawn.filter((cell) => cell === REFUSED - k).length);
    const key = (name, text, mark = '') => html('span', { class: 'key' },
      svg('svg', { viewBox: '0 0 20 20', 'aria-hidden': 'true' },
        svg('rect', { width: 20, height: 20, rx: 3, class: `cell ${name}` }),
        svg('text', { x: 10, y: 14, class: 'reason' }, mark)), text);
    const scores = STEPS.map((most, k) => key(`score-${k}`, `≤ ${most}`));
    byId('legend').replaceChildren(
      ...scores, key(`score-${STEPS.length}`, `> ${STEPS.at(-1)}`), key('blocked', 'blocked'), key('untried', 'not tried'),
      ...candidates.reasons.map((reason, k) => (counts[k] ? key('refused', `${reason} (${counts[k]})`, `${k + 1}`) : '')));
  }

  const point = (event) => {
    const said = event.target.closest?.('[data-words]');
    if (said) byId('cell').textContent = said.dataset.words;
  };
  byId('grids').addEventListener('pointerover', point);
  byId('grids').addEventListener('click', point);
  tools.addEventListener('change', draw);
  levels.addEventListener('change', draw);
  let tool = null;
  whenPlanChanges.push(() => {
    const now = page.tools[plan().tool].name;
    if (now === tool) return;
    tool = now;
    const pushes = plan().strokes.length;
    if (counts.includes(pushes)) levels.value = `${pushes}`;
    if (named.includes(now)) tools.value = now;
    draw();
  });
})();
