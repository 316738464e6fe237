// Final positions of the goal object: as planned, and in the perturbed replays.

(() => {
  const SIZE = 280;
  const figure = byId('ends');
  // Runs have no perturbed replays, lever-ups have other outcomes, and recordings have no goal. For
  // regions and headings, final positions show no errors.
  const none = Boolean(page.run ?? page.measure) || goals[0]?.tolerance === 0;
  byId('ends-card').hidden = none;
  if (none) return;

  function draw() {
    const [goal] = goals;
    const finals = replays().map((replay) => {
      const [x, y] = replay.object(goal.objects[0], replay.end);
      return { layer: replay.layer, x: x - goal.at[0] * LENGTH, y: y - goal.at[1] * LENGTH };
    });
    const ends = plan().ends.map(({ layer, at, reached }) => ({
      layer, reached, x: (at[0] - goal.at[0]) * LENGTH, y: (at[1] - goal.at[1]) * LENGTH,
    }));
    const tolerance = goal.tolerance * LENGTH;
    const far = Math.max(...[...finals, ...ends].map(({ x, y }) => Math.hypot(x, y)));
    // Outliers are clamped, so that they do not shrink the rest to a dot.
    const most = Math.min(Math.max(tolerance * 1.3, far * 1.1), tolerance * 4);
    const scale = SIZE / 2 / most;
    const map = ({ x, y }) => {
      const away = Math.hypot(x, y);
      const pull = away > most * 0.97 ? (most * 0.97) / away : 1;
      return [+(SIZE / 2 + x * pull * scale).toFixed(1), +(SIZE / 2 - y * pull * scale).toFixed(1)];
    };
    const root = svg('svg', { role: 'img', class: 'plot', viewBox: `0 0 ${SIZE} ${SIZE}` });
    const middle = SIZE / 2;
    root.append(
      svg('title', {}, 'Final positions around the goal'),
      svg('circle', { cx: middle, cy: middle, r: tolerance * scale, class: 'goal' }),
      svg('path', { d: `M${middle - 6} ${middle}h12M${middle} ${middle - 6}v12`, class: 'goal-cross' }),
    );
    for (const end of ends) {
      const [x, y] = map(end);
      const name = `${end.layer} ${end.reached ? 'in' : 'out'}`;
      root.append(end.layer === 'spatial'
        ? svg('circle', { cx: x, cy: y, r: 3.4, class: `end ${name}` })
        : svg('rect', { x: x - 3, y: y - 3, width: 6, height: 6, class: `end ${name}` }));
    }
    for (const end of finals) {
      const [x, y] = map(end);
      root.append(svg('path', { d: `M${x - 6} ${y - 6}l12 12m0-12l-12 12`, class: `final ${end.layer}` }));
    }
    const allowed = `${millimetres(tolerance)} allowed`;
    root.append(svg('text', { x: 8, y: SIZE - 8, class: 'small' }, `circle: ${allowed}`));
    figure.replaceChildren(root);
    const counts = ['planar', 'spatial'].map((layer) => {
      const own = ends.filter((end) => end.layer === layer);
      const count = own.filter((end) => end.reached).length;
      return own.length ? `${count} of ${own.length} ${LAYERS[layer]}` : '';
    }).filter(Boolean);
    byId('ends-words').textContent = counts.length
      ? `Crosses: prediction and nominal replays. Dots: replays with perturbed starts and frictions, of which ${counts.join(' and ')} reach the goal.`
      : 'Crosses: prediction and nominal replays. There are no replays with perturbed starts and frictions.';
  }

  whenPlanChanges.push(draw);
})();
