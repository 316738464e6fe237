// The pushes of a run, each with a button that shows its start.

(() => {
  const { run } = page;
  byId('run-card').hidden = !run?.made.length;
  if (!run) return;
  const rows = run.made.map(({ at, cells }) => {
    const button = html('button', { class: 'open', 'aria-label': `Show push ${cells[0]}` }, cells[0]);
    button.addEventListener('click', () => {
      play(false);
      showTime(at * FINE);
      keepLink();
    });
    const others = cells.slice(1).map((cell, c) => html('td', side(run.numeric[c + 1]), cell));
    return html('tr', {}, html('td', {}, button), ...others);
  });
  byId('run').replaceChildren(headed(run.columns, [false, ...run.numeric.slice(1)]), ...rows);

  whenTimeChanges.push(() => {
    const current = run.made.findLastIndex(({ at }) => at * FINE <= view.time);
    rows.forEach((row, k) => row.setAttribute('aria-current', k === current));
  });
})();
