// The goal error over time, synchronized with the replay.

(() => {
  byId('chart').hidden = !goals.length;
  if (!goals.length) return;
  const [HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [190, 40, 12, 12, 26];
  let width = 800;
  const root = svg('svg', { role: 'img', class: 'plot' });
  const still = svg('g');
  const hand = svg('line', { y1: TOP, y2: HEIGHT - BOTTOM, class: 'hand' });
  const dots = svg('g');
  root.append(svg('title', {}, `${measured} over time`), still, hand, dots);
  byId('chart').append(root);

  let [least, most] = [0, 1]; // metres
  const x = (time) => +(LEFT + (time / (duration() || 1)) * (width - LEFT - RIGHT)).toFixed(1);
  const y = (error) => +(HEIGHT - BOTTOM - ((error - least) / (most - least)) * (HEIGHT - TOP - BOTTOM)).toFixed(1);

  /** Returns a round step that divides `span` into at most `count` intervals. */
  function roundStep(span, count) {
    const power = 10 ** Math.floor(Math.log10(span / count));
    return [1, 2, 5, 10].map((m) => m * power).find((size) => size * count >= span);
  }

  whenPlanChanges.push(() => {
    still.replaceChildren();
    width = widthOf(byId('chart'));
    root.setAttribute('viewBox', `0 0 ${width} ${HEIGHT}`);
    const tolerance = allowedError();
    const errors = replays().flatMap((replay) => Array.from(replay.time, (t) => replay.error(t)));
    // Other quantities than distances may become negative.
    least = Math.min(0, ...errors) * 1.06;
    most = Math.max(tolerance * 1.2, ...errors) * 1.06 || 1;
    const bottom = HEIGHT - BOTTOM;
    still.append(svg('rect', {
      x: LEFT, y: y(tolerance), width: width - LEFT - RIGHT, height: y(0) - y(tolerance), class: 'allowed',
    }));
    const rise = roundStep(most - least, 4);
    for (let k = Math.ceil(least / rise); k * rise <= most; k++) {
      const height = y(k * rise);
      still.append(
        svg('line', { x1: LEFT, x2: width - RIGHT, y1: height, y2: height, class: 'grid' }),
        svg('text', { x: LEFT - 7, y: height + 4, class: 'small end' }, `${+(k * rise * 1000).toPrecision(6)}`),
      );
    }
    still.append(svg('text', { x: width - RIGHT - 4, y: TOP + 10, class: 'small end' }, page.measure?.axis ?? (angular ? 'heading error, °' : 'goal error, mm')));
    const pace = roundStep(duration() || 1, Math.min(8, width / 60));
    for (let k = 0; k * pace <= duration() + 1e-9; k++) {
      const name = `${+(k * pace).toPrecision(6)}${k ? '' : ' s'}`;
      still.append(svg('text', { x: x(k * pace), y: HEIGHT - 8, class: 'small middle' }, name));
    }
    const lead = leading();
    for (const first of lead ? lead.firsts.slice(1) : []) {
      const place = x(lead.time[Math.max(0, first - 1)]);
      still.append(svg('line', { x1: place, x2: place, y1: TOP, y2: bottom, class: 'stroke-start' }));
    }
    for (const replay of shown()) {
      const points = Array.from(replay.time, (t) => `${x(t)},${y(replay.error(t))}`);
      still.append(svg('polyline', { points: points.join(' '), class: `line ${replay.layer}` }));
    }
  });
  whenTimeChanges.push(() => {
    const place = x(view.time);
    hand.setAttribute('x1', place);
    hand.setAttribute('x2', place);
    dots.replaceChildren(...shown().map((replay) => svg('circle', {
      cx: place, cy: y(replay.error(view.time)), r: 4, class: `dot ${replay.layer}`,
    })));
  });

  const scrub = (event) => {
    const box = root.getBoundingClientRect();
    const across = ((event.clientX - box.left) / box.width) * width;
    showTime(((across - LEFT) / (width - LEFT - RIGHT)) * duration());
  };
  root.addEventListener('pointerdown', (event) => {
    play(false);
    root.setPointerCapture(event.pointerId);
    scrub(event);
  });
  root.addEventListener('pointermove', (event) => {
    if (root.hasPointerCapture(event.pointerId)) scrub(event);
  });
  root.addEventListener('pointerup', keepLink);
})();
