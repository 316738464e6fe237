// The top view of the table at the current time.

(() => {
  // Pages that measure another quantity show a drawing instead.
  if (page.measure) return;
  const MARGIN = 0.05; // metres around everything
  const root = svg('svg', { role: 'img', class: 'plot' });
  const still = svg('g');
  const moving = svg('g');
  const over = svg('g'); // bodies above the table
  const pushes = svg('g');
  const graph = svg('g');
  const RELATIONS = ['contact', 'fixed', 'revolute', 'prismatic'];
  root.append(svg('title', {}, 'The table from above'), still, moving, over, pushes, graph);
  byId('stage').append(root);

  let width = 800; // pixels
  let scale = 1; // pixels a metre
  let low = [0, 0];
  let high = [0, 0];
  let bodies = [];

  const px = (metres) => +(metres * scale).toFixed(2);
  const map = ([x, y]) => [px(x - low[0]), px(high[1] - y)];
  const at = (pose) => {
    const [x, y] = map(pose);
    return `translate(${x} ${y}) rotate(${((-pose[2] * 180) / Math.PI).toFixed(2)})`;
  };

  const outline = (shape, attributes) => outlined(shape, px, attributes);

  function line(points, attributes) {
    return svg('polyline', { points: points.map((p) => map(p).join(',')).join(' '), ...attributes });
  }

  function fit() {
    low = [Infinity, Infinity];
    high = [-Infinity, -Infinity];
    const add = ([x, y], room = 0) => {
      low = [Math.min(low[0], x - room), Math.min(low[1], y - room)];
      high = [Math.max(high[0], x + room), Math.max(high[1], y + room)];
    };
    const { objects, obstacles, regions = [] } = page.stage;
    for (const goal of goals) {
      add(posed([...goal.at, 0]), goal.tolerance * LENGTH);
      for (const area of goal.areas) add(posed(area.at), radius(area.shape));
      if (goal.arc) add(onArc(goal.arc, goal.arc.to));
    }
    for (const body of [...objects, ...obstacles, ...regions]) add(posed(body.at), radius(body.shape));
    // If nothing moves, the robot is shown as well.
    if (!plan().strokes.length) add([0, 0]);
    for (const stroke of plan().strokes) {
      const tool = page.tools[stroke.tool];
      for (const end of [posed(stroke.from), posed(stroke.to)]) {
        add(placed(end, posed(tool.grip)));
        for (const part of tool.parts) add(placed(end, posed(part.at)), radius(part.shape));
      }
    }
    for (const replay of replays()) {
      replay.objects.forEach((object, k) => add(replay.object(k, replay.end), radius(objects[k].shape)));
    }
    low = low.map((value) => value - MARGIN);
    high = high.map((value) => value + MARGIN);
    width = widthOf(byId('stage'));
    const [across, along] = [high[0] - low[0], high[1] - low[1]];
    scale = Math.min(width / across, Math.min(440, width * 0.9) / along);
    const spare = (width / scale - across) / 2;
    low[0] -= spare;
    high[0] += spare;
    root.setAttribute('viewBox', `0 0 ${width} ${Math.max(1, px(high[1] - low[1]))}`);
  }

  function drawGrid() {
    const step = [0.05, 0.1, 0.2, 0.5, 1, 2, 5].find((size) => size * scale >= 45) ?? 10;
    const [right, bottom] = map([high[0], low[1]]);
    for (let k = Math.ceil(low[0] / step); k * step <= high[0]; k++) {
      const [x] = map([k * step, 0]);
      still.append(svg('line', { x1: x, x2: x, y1: 0, y2: bottom, class: 'grid' }));
    }
    for (let k = Math.ceil(low[1] / step); k * step <= high[1]; k++) {
      const [, y] = map([0, k * step]);
      still.append(svg('line', { x1: 0, x2: right, y1: y, y2: y, class: 'grid' }));
    }
    const [end, height] = [right - 14, bottom - 14];
    still.append(
      svg('path', { d: `M${end - px(step)} ${height - 4}v8m0-4H${end}m0-4v8`, class: 'bar' }),
      svg('text', { x: end - px(step) / 2, y: height - 7, class: 'small middle' },
        step < 1 ? `${step * 100} cm` : `${step} m`),
    );
  }

  function drawStill() {
    still.replaceChildren();
    const { objects, obstacles, reach, table, regions = [] } = page.stage;
    if (table) {
      const [[x, y], [w, h]] = table.map((pair) => pair.map((value) => value * LENGTH));
      const [left, top] = map([x - w / 2, y + h / 2]);
      still.append(svg('rect', { x: left, y: top, width: px(w), height: px(h), class: 'table' }));
    }
    drawGrid();
    const [baseX, baseY] = map(baseOf(page.stage));
    for (const ring of reach) {
      still.append(svg('circle', { cx: baseX, cy: baseY, r: px(ring * LENGTH), class: 'reach' }));
    }
    over.replaceChildren();
    const fixed = [[regions, 'keep-out'], [obstacles, 'obstacle']];
    for (const [bodies, className] of fixed) for (const body of bodies) {
      const name = body.under ? 'overhead' : body.base ? 'base' : className;
      const shape = outline(body.shape, { transform: at(posed(body.at)), class: name });
      const height = (body.under * LENGTH).toFixed(3);
      shape.append(svg('title', {}, body.under ? `${body.name}, ${height} m above the table` : body.name));
      (body.under ? over : still).append(shape);
    }
    still.append(...robotMark(page.stage, px, map));
    objects.forEach((body, k) => {
      const className = wants(k) ? 'start own' : 'start';
      still.append(outline(body.shape, { transform: at(posed(body.at)), class: className }));
    });
    goals.forEach(drawGoal);
  }

  function drawGoal(goal) {
    const { objects } = page.stage;
    const wanted = [...posed([...goal.at, 0])];
    const own = objects[goal.objects[0]];
    wanted[2] = goal.heading ? goal.heading[0] * FINE : posed(own.at)[2];
    const [x, y] = map(wanted);
    const turned = goal.heading && !(goal.bands || goal.edges);
    if (goal.arc) wanted.splice(0, 3, ...swung(goal.arc, posed(own.at)));
    if (turned || (!goal.unplaced && (goal.heading || 'disc' in own.shape))) {
      for (const [body, pose] of solidsAt(objects, goal.objects[0], wanted)) {
        still.append(outline(body.shape, { transform: at(pose), class: 'wanted' }));
      }
    }
    for (const area of goal.areas) {
      still.append(outline(area.shape, { transform: at(posed(area.at)), class: area.leave ? 'leave' : 'goal' }));
    }
    if (!goal.areas.length && goal.tolerance) still.append(svg('circle', { cx: x, cy: y, r: px(goal.tolerance * LENGTH), class: 'goal' }));
    still.append(...goalMarks(goal, px, map));
    if (!goal.unplaced) still.append(svg('path', { d: `M${x - 7} ${y}h14M${x} ${y - 7}v14`, class: 'goal-cross' }));
    for (const object of goal.objects) for (const replay of shown()) {
      const columns = replay.objects[object];
      const points = Array.from(replay.time, (_, k) => [columns[0][k], columns[1][k]]);
      still.append(line(points, { class: `way ${replay.layer}` }));
    }
  }

  /** Draws the path of the end effector above all bodies. */
  function drawPushes() {
    pushes.replaceChildren(...plan().strokes.flatMap((stroke, k) => strokeShapes(stroke, k, page.tools, map)));
  }

  function drawMoving() {
    moving.replaceChildren();
    bodies = [];
    const { objects } = page.stage;
    const lead = leading();
    if (!lead) return;
    const add = (shape, place) => {
      moving.append(shape);
      bodies.push([shape, place]);
    };
    // Only the tool in use is shown.
    for (const index of new Set(plan().strokes.map((stroke) => stroke.tool))) {
      const place = (time) => (lead.stroke(time).tool === index ? at(lead.toolPose(time)) : 'scale(0)');
      add(toolShape(page.tools[index], plan().hand, px, { class: 'tool' }), place);
    }
    for (const replay of shown()) {
      objects.forEach((body, k) => {
        const own = wants(k) ? ' own' : '';
        const className = replay === lead ? `object${own}` : `ghost ${replay.layer}`;
        const shape = svg('g', { class: className },
          outline(body.shape, {}), svg('title', {}, `${body.name}, ${LAYERS[replay.layer]}`));
        if (!('disc' in body.shape)) shape.append(svg('path', { d: `M0 0h${px(radius(body.shape) * 0.45)}` }));
        add(shape, (time) => at(replay.object(k, time)));
      });
    }
    objects.forEach((body, k) => {
      if (body.whole !== undefined || px(radius(body.shape)) < 4 * body.name.length) return;
      const label = svg('text', { class: 'label middle', y: 4 }, body.name);
      add(label, (time) => {
        const [x, y] = map(lead.object(k, time));
        return `translate(${x} ${y + (('disc' in body.shape) ? 0 : 14)})`;
      });
    });
  }

  /** Draws nodes and relations of the network graph in the current predicted frame. */
  function drawGraph() {
    graph.replaceChildren();
    const replay = view.graph && graphed();
    if (!replay) return;
    const [frame] = replay.place(view.time);
    const relations = replay.graph[Math.min(frame, replay.graph.length - 1)] ?? [];
    const time = replay.time[frame];
    const tool = replay.toolPose(time);
    const { objects, obstacles } = page.stage;
    const parts = page.tools[replay.stroke(time).tool].parts;
    const nodes = [
      ...objects.map((_, k) => replay.object(k, time)),
      ...parts.map((part) => placed(tool, posed(part.at))),
      ...obstacles.map((body) => posed(body.at)),
    ].map(map);
    for (const [a, b, kind] of relations) {
      const [[x1, y1], [x2, y2]] = [nodes[a], nodes[b]];
      graph.append(svg('line', { x1, y1, x2, y2, class: `relation ${RELATIONS[kind]}` }));
    }
    const names = [...objects, ...parts, ...obstacles].map((body) => body.name);
    nodes.forEach(([cx, cy], k) => {
      graph.append(svg('circle', { cx, cy, r: 4, class: 'node' }, svg('title', {}, names[k])));
    });
  }

  whenPlanChanges.push(() => {
    fit();
    drawStill();
    drawMoving();
    drawPushes();
  });
  whenTimeChanges.push(() => {
    for (const [shape, place] of bodies) shape.setAttribute('transform', place(view.time));
    drawGraph();
  });
})();
