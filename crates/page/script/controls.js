// Buttons, slider and keys; finally the page shows the state of its link.

(() => {
  const [scrub, button] = [byId('scrub'), byId('play')];
  const [PLAY, PAUSE] = ['M4 2l10 6-10 6z', 'M3 2h4v12H3zM9 2h4v12H9z'];

  button.addEventListener('click', () => play(!view.playing));
  byId('back').addEventListener('click', () => step(-1));
  byId('forward').addEventListener('click', () => step(1));
  byId('speed').addEventListener('change', (event) => { view.speed = Number(event.target.value); });
  scrub.addEventListener('input', () => {
    // The value is read before the clock resets the slider.
    const wanted = Number(scrub.value);
    play(false);
    showTime(wanted);
  });
  scrub.addEventListener('change', keepLink);

  whenPlanChanges.push(() => { scrub.max = duration(); });
  whenTimeChanges.push(() => {
    scrub.value = view.time;
    const [now, all] = [view.time.toFixed(2), duration().toFixed(2)];
    byId('clock').textContent = `${now} / ${all} s`;
    scrub.setAttribute('aria-valuetext', `${now} seconds of ${all}`);
    byId('play-shape').setAttribute('d', view.playing ? PAUSE : PLAY);
    button.setAttribute('aria-label', view.playing ? 'Pause' : 'Play');
  });

  Object.assign(keys, {
    ' ': () => play(!view.playing),
    ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
    Home: () => { play(false); showTime(0); keepLink(); },
    End: () => { play(false); showTime(duration()); keepLink(); },
  });
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    // Lists have their own keys; space presses buttons, checkboxes and summaries.
    if (tagName === 'SELECT') return;
    if (event.key === ' ' && (['BUTTON', 'SUMMARY'].includes(tagName) || type === 'checkbox')) return;
    const layer = replays()[Number(event.key) - 1]?.layer;
    const act = layer ? () => toggle(layer) : keys[event.key];
    if (!act) return;
    event.preventDefault();
    act(event);
  });

  // A clicked button must not capture the space key; a button reached by keyboard does.
  document.addEventListener('click', (event) => {
    if (event.detail > 0) event.target.closest?.('button')?.blur();
  });

  let width = 0;
  new ResizeObserver(() => {
    // Figures are drawn for their width; changes of height alone are ignored.
    const now = widthOf(byId('stage'));
    // Deferred, because drawing may change the width again.
    if (now !== width) requestAnimationFrame(() => showPlan(view.plan));
    width = now;
  }).observe(byId('stage'));
  addEventListener('hashchange', followLink);
  followLink();
})();
