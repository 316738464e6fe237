// The belief about joints, masses and frictions, synchronized with the replay.

(() => {
  const { run } = page;
  const any = Boolean(run) && run.joints.length + run.numbers.length > 0;
  byId('belief-card').hidden = !any;
  if (!any) return;

  const [HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [96, 44, 26, 6, 6];
  const [NARROW, GAP] = [304, 24]; // smallest width of a figure, and the gap between figures, pixels
  let width = 320;
  const THOUSANDTH = 1e-3;
  const times = run.times.map((time) => time * FINE);
  const x = (time) => +(LEFT + (time / (duration() || 1)) * (width - LEFT - RIGHT)).toFixed(1);
  // The final belief is drawn up to the right margin.
  const until = (k) => (k + 1 < times.length ? x(times[k + 1]) : width);
  const place = (share) => +(HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)).toFixed(1);

  /** Returns a figure with a time cursor; `words` describes the belief after a number of pushes. */
  function figure(name, words, ...drawn) {
    const hand = svg('line', { y1: TOP, y2: HEIGHT - BOTTOM, class: 'hand' });
    const output = html('output', { 'aria-label': name });
    const root = svg('svg', { viewBox: `0 0 ${width} ${HEIGHT}`, class: 'plot', role: 'img' },
      svg('title', {}, `${name} over time`), ...drawn, hand);
    const show = () => {
      hand.setAttribute('x1', x(view.time));
      hand.setAttribute('x2', x(view.time));
      output.textContent = words(Math.max(0, times.findLastIndex((time) => time <= view.time + FINE / 2)));
    };
    return [html('figure', {}, html('figcaption', {}, name), root, output), show];
  }

  function joint({ name, shares, really }) {
    const blocks = shares.flatMap((types, k) => {
      let below = 0;
      return types.map((share, type) => {
        const [bottom, top] = [place(below), place(below + share * THOUSANDTH)];
        below += share * THOUSANDTH;
        const [left, right] = [x(times[k]), until(k)];
        return svg('rect', { x: left, y: top, width: right - left, height: bottom - top, class: `type-${type}` });
      });
    });
    const scale = [0, 1].map((share) => svg('text', { x: LEFT - 5, y: place(share) + (share ? 10 : 0), class: 'small end' }, `${100 * share} %`));
    const words = (k) => {
      const said = shares[k].map((share, type) => `${run.types[type]} ${(share / 10).toFixed(1)} %`).join(', ');
      return really === null ? said : `${said}; true: ${run.types[really]}`;
    };
    return figure(name, words, ...blocks, ...scale);
  }

  function number({ name, unit, values, really }) {
    const ends = values.flatMap(([mean, spread]) => [mean - spread, mean + spread]);
    if (really !== null) ends.push(really);
    const [least, most] = [Math.min(...ends), Math.max(...ends)];
    const y = (value) => place((value - least) / (most - least || 1));
    const bands = values.map(([mean, spread], k) => svg('rect', {
      x: x(times[k]), width: until(k) - x(times[k]), y: y(mean + spread), height: y(mean - spread) - y(mean + spread), class: 'band',
    }));
    const line = values.flatMap(([mean], k) => [`${x(times[k])},${y(mean)}`, `${until(k)},${y(mean)}`]);
    const drawn = [...bands, svg('polyline', { points: line.join(' '), class: 'mean' })];
    if (really !== null) drawn.push(svg('line', { x1: LEFT, x2: width, y1: y(really), y2: y(really), class: 'truth' }));
    for (const [value, shift] of [[least, 0], [most, 10]]) {
      drawn.push(svg('text', { x: LEFT - 5, y: y(value) + shift, class: 'small end' }, fixed(value * THOUSANDTH, 2)));
    }
    const text = (value) => fixed(value * THOUSANDTH, 2);
    const words = (k) => {
      const said = `${text(values[k][0])} ± ${text(values[k][1])}${unit}`;
      return really === null ? said : `${said}; true: ${text(really)}${unit}`;
    };
    return figure(name, words, ...drawn);
  }

  const legend = run.joints.length ? run.types.map((name, type) => html('span', { class: 'key' },
    svg('svg', { viewBox: '0 0 20 20', 'aria-hidden': 'true' },
      svg('rect', { width: 20, height: 20, rx: 3, class: `type-${type}` })), name)) : [];
  byId('belief-legend').replaceChildren(...legend);
  byId('belief-words').textContent = run.words
    + (run.numbers.some(({ really }) => really !== null) ? ' Dashed: ground truth.' : '');

  let shows = [];
  whenPlanChanges.push(() => {
    const [all, count] = [widthOf(byId('belief')), run.joints.length + run.numbers.length];
    const columns = Math.max(1, Math.min(count, Math.floor((all + GAP) / (NARROW + GAP))));
    width = Math.round((all - GAP * (columns - 1)) / columns);
    const figures = [...run.joints.map(joint), ...run.numbers.map(number)];
    byId('belief').replaceChildren(...figures.map(([node]) => node));
    shows = figures.map(([, show]) => show);
  });
  whenTimeChanges.push(() => { for (const show of shows) show(); });
})();
