// The table in 3-D, with the same time and layers. three.js draws it. The page holds three.js compressed,
// and the browser runs it only if its hash is in the content security policy.

const solid = (() => {
  const flat = byId('stage');
  const canvas = html('canvas', { tabindex: 0, 'aria-label': 'The table in 3-D', role: 'img' });
  const names = namesOver(canvas);
  const figure = html('figure', { class: 'solid', id: 'solid' }, canvas, names.layer);
  const words = html('p', { class: 'faint', id: 'solid-words' });
  const choices = [['3-D', true], [page.measure ? 'Drawing' : 'From above', false]].map(([name, inDepth]) => {
    const button = html('button', { id: inDepth ? 'show-solid' : 'show-flat' }, name);
    button.addEventListener('click', () => show(inDepth));
    return [button, inDepth];
  });
  const buttons = html('div', { class: 'views', role: 'group', 'aria-label': 'View' },
    ...choices.map(([button]) => button));

  const [THIN, EDGE] = [0.0015, 25]; // metres above the table; degrees between faces
  const FOOT = 0.12; // metres of the robot's base that are drawn; the rest would hide the table
  let renderer;
  let scene;
  let camera;
  let controls;
  let moved = []; // moving nodes, and their poses as functions of time
  let ready = false;

  function show(inDepth) {
    figure.hidden = !inDepth;
    flat.hidden = inDepth;
    words.hidden = !inDepth;
    for (const [button, own] of choices) button.setAttribute('aria-pressed', own === inDepth);
    if (inDepth) draw();
    else showPlan(view.plan);
  }

  const colour = (name) => new THREE.Color(
    getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  const layerColour = (layer) => colour({ seen: 'planar', real: 'spatial' }[layer] ?? layer);

  /** Returns the solid of a body, in its own frame. */
  function geometry({ shape, height, under = 0 }) {
    const [tall, low] = [height * LENGTH, under * LENGTH];
    if ('disc' in shape) {
      const radius = shape.disc * LENGTH;
      return new THREE.CylinderGeometry(radius, radius, tall, 48).rotateX(Math.PI / 2).translate(0, 0, low + tall / 2);
    }
    const corners = shape.polygon.map(([x, y]) => new THREE.Vector2(x * LENGTH, y * LENGTH));
    return new THREE.ExtrudeGeometry(new THREE.Shape(corners), { depth: tall, bevelEnabled: false }).translate(0, 0, low);
  }

  /** Returns a body with its edges; a ghost is transparent. */
  function piece(body, fill, rim, ghost = false) {
    const form = geometry(body);
    const material = new THREE.MeshLambertMaterial({ color: fill });
    // Drawn behind coincident solids, because they would flicker otherwise.
    if (ghost) {
      Object.assign(material, {
        transparent: true, opacity: 0.14, depthWrite: false, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2,
      });
    }
    const mesh = new THREE.Mesh(form, material);
    mesh.castShadow = !ghost;
    mesh.receiveShadow = !ghost;
    const edges = new THREE.LineSegments(
      new THREE.EdgesGeometry(form, EDGE), new THREE.LineBasicMaterial({ color: rim }));
    const whole = new THREE.Group().add(mesh, edges);
    for (const part of body.more ?? []) whole.add(piece(part, fill, rim, ghost));
    return whole;
  }

  /** Returns the hand about a grip: palm and two fingers that hold a part of this height (units of the data). */
  function gripper(hand, held) {
    const palm = piece({ ...hand, height: hand.height / 2 }, colour('hatch'), colour('other-rim'));
    const [half, tip] = [0.6 * hand.shape.disc, 0.16 * hand.shape.disc];
    for (const side of [-1, 1]) {
      const finger = { shape: { disc: tip }, height: Math.max(1, hand.under - held / 2), under: held / 2 };
      palm.add(placed(piece(finger, colour('hatch'), colour('other-rim')), [0, side * half * LENGTH, 0]));
    }
    return palm;
  }

  /** Moves a node to a pose; poses in space include height and rotation. */
  function placed(node, [x, y, heading, z, ...turn], height = 0) {
    node.position.set(x, y, z ?? height);
    if (turn.length) node.quaternion.set(...turn).normalize();
    else node.rotation.z = heading;
    return node;
  }

  function line(points, color, closed = false) {
    const form = new THREE.BufferGeometry().setFromPoints(points.map((p) => new THREE.Vector3(...p)));
    const Kind = closed ? THREE.LineLoop : THREE.Line;
    return new Kind(form, new THREE.LineBasicMaterial({ color }));
  }

  const ring = ([x, y], radius, color, height = THIN) => line(Array.from({ length: 96 }, (_, k) => {
    const turn = (k / 48) * Math.PI;
    return [x + radius * Math.cos(turn), y + radius * Math.sin(turn), height];
  }), color, true);

  const reachOf = (shape) => LENGTH * ('disc' in shape ? shape.disc
    : Math.max(...shape.polygon.map(([x, y]) => Math.hypot(x, y))));

  /** Returns centre and half width of the visible content. */
  function extent() {
    let [low, high] = [[Infinity, Infinity], [-Infinity, -Infinity]];
    const add = ([x, y], room) => {
      low = [Math.min(low[0], x - room), Math.min(low[1], y - room)];
      high = [Math.max(high[0], x + room), Math.max(high[1], y + room)];
    };
    const { objects, obstacles } = page.stage;
    for (const body of [...objects, ...obstacles]) add(posed(body.at), reachOf(body.shape));
    for (const goal of page.measure ? [] : goals) {
      add(posed([...goal.at, 0]), goal.tolerance * LENGTH);
      for (const area of goal.areas) add(posed(area.at), reachOf(area.shape));
    }
    for (const stroke of page.measure ? [] : plan().strokes) {
      const room = Math.max(...page.tools[stroke.tool].parts.map(
        (part) => Math.hypot(...posed(part.at).slice(0, 2)) + reachOf(part.shape)));
      for (const end of [stroke.from, stroke.to]) add(posed(end), 0.5 * room);
    }
    return [[(low[0] + high[0]) / 2, (low[1] + high[1]) / 2], Math.hypot(high[0] - low[0], high[1] - low[1]) / 2];
  }

  function drawTable([x, y], half) {
    const { table } = page.stage;
    const [[left, top], [width, depth]] = table
      ? table.map((pair) => pair.map((value) => value * LENGTH)) : [[x, y], [3 * half, 3 * half]];
    const ground = new THREE.Mesh(new THREE.PlaneGeometry(width, depth),
      new THREE.MeshLambertMaterial({ color: colour('grid') }));
    ground.receiveShadow = true;
    // Slightly lower, so that bodies on it do not flicker.
    scene.add(placed(ground, [left, top, 0], -THIN / 3));
    const [right, far] = [left + width / 2, top + depth / 2];
    const grid = [];
    for (let k = Math.ceil((left - width / 2) / 0.1); k * 0.1 <= right; k++) {
      grid.push([k * 0.1, top - depth / 2, 0], [k * 0.1, far, 0]);
    }
    for (let k = Math.ceil((top - depth / 2) / 0.1); k * 0.1 <= far; k++) {
      grid.push([left - width / 2, k * 0.1, 0], [right, k * 0.1, 0]);
    }
    const form = new THREE.BufferGeometry().setFromPoints(grid.map((p) => new THREE.Vector3(...p)));
    scene.add(new THREE.LineSegments(form, new THREE.LineBasicMaterial({ color: colour('rim') })));
  }

  function drawGoal(goal, objects) {
    const at = posed([...goal.at, 0]);
    const flat = ([x, y]) => [x * LENGTH, y * LENGTH, 2 * THIN];
    const rounds = [...(goal.covers ?? []), ...(goal.bands ?? []).flatMap(({ pieces }) => pieces)];
    for (const corners of rounds) scene.add(line([...corners, corners[0]].map(flat), colour('goal')));
    for (const edge of goal.edges ?? []) scene.add(line(edge.map(flat), colour('goal')));
    if (goal.arc) {
      const { from, to, tolerance } = goal.arc;
      const on = (list) => list.map((point) => [...point, 2 * THIN]);
      const sector = [onArc(goal.arc, 0, 0), ...arcPoints(goal.arc, to - tolerance, to + tolerance)];
      scene.add(line(on(sector), colour('goal'), true), line(on(arcPoints(goal.arc, from, to)), colour('goal')));
    }
    const disc = { shape: { disc: goal.tolerance }, at: [...goal.at, 0] };
    for (const area of goal.areas.length || !goal.tolerance ? goal.areas : [disc]) {
      const place = posed(area.at);
      const corners = area.shape.polygon?.map(([x, y]) => new THREE.Vector2(x * LENGTH, y * LENGTH));
      const rim = area.shape.disc * LENGTH;
      const form = corners ? new THREE.ShapeGeometry(new THREE.Shape(corners)) : new THREE.CircleGeometry(rim, 64);
      const mesh = new THREE.Mesh(form,
        new THREE.MeshBasicMaterial({ color: colour(area.leave ? 'bad' : 'goal'), transparent: true, opacity: 0.25, depthWrite: false }));
      scene.add(placed(mesh, place, THIN));
      if (!corners) scene.add(ring(place, rim, colour('goal'), 2 * THIN));
    }
    if (goal.heading) {
      at[2] = goal.heading[0] * FINE;
      if (goal.arc) at.splice(0, 3, ...swung(goal.arc, posed(objects[goal.objects[0]].at)));
      for (const [body, pose] of solidsAt(objects, goal.objects[0], at)) {
        scene.add(placed(piece(body, colour('goal'), colour('goal'), true), pose));
      }
    }
  }

  function drawStill() {
    const { objects, obstacles, reach, regions = [] } = page.stage;
    for (const radius of reach) scene.add(ring(baseOf(page.stage), radius * LENGTH, colour('accent')));
    for (const body of obstacles) {
      const low = body.base ? { ...body, height: Math.min(body.height, FOOT / LENGTH) } : body;
      const tint = colour(body.base ? 'faint' : 'hatch');
      const node = placed(piece(low, tint, colour('other-rim'), body.under > 0), posed(body.at));
      scene.add(node);
      names.add(node, body.name, (low.height + low.under || low.height) * LENGTH);
    }
    for (const body of regions) {
      const flat = { ...body, height: (2 * THIN) / LENGTH };
      scene.add(placed(piece(flat, colour('bad'), colour('bad'), true), posed(body.at)));
    }
    for (const object of goals.flatMap((goal) => goal.objects)) {
      for (const replay of shown()) {
        const [xs, ys, , zs] = replay.objects[object];
        const way = Array.from(xs, (x, k) => [x, ys[k], (zs?.[k] ?? 0) + 3 * THIN]);
        scene.add(line(way, layerColour(replay.layer)));
      }
    }
    if (page.measure) return;
    for (const goal of goals) drawGoal(goal, objects);
    for (const stroke of plan().strokes) {
      const grip = posed(page.tools[stroke.tool].grip);
      const ends = [stroke.from, stroke.to].map((end) => {
        const [x, y, heading] = posed(end);
        const [c, s] = [Math.cos(heading), Math.sin(heading)];
        return [x + c * grip[0] - s * grip[1], y + s * grip[0] + c * grip[1], 2 * THIN];
      });
      scene.add(line(ends, colour('ink')));
    }
  }

  function drawMoving() {
    moved = [];
    const lead = leading();
    if (!lead) return;
    const add = (node, place, name) => {
      scene.add(node);
      moved.push({ node, place, ...name });
    };
    for (const index of new Set(plan().strokes.map((stroke) => stroke.tool))) {
      const tool = new THREE.Group();
      for (const part of page.tools[index].parts) {
        const node = placed(piece(part, colour('tool'), colour('tool-rim')), posed(part.at), plan().lift * LENGTH);
        tool.add(node);
        // Named at its last part, away from the hand.
        if (part === page.tools[index].parts.at(-1)) names.add(node, page.tools[index].name, part.height * LENGTH);
      }
      const { hand } = plan();
      const top = Math.max(...page.tools[index].parts.map((part) => part.height + (part.under ?? 0)));
      if (hand) {
        const held = placed(gripper(hand, top), posed(page.tools[index].grip), plan().lift * LENGTH);
        tool.add(held);
        names.add(held, 'hand', (hand.under + hand.height / 2) * LENGTH);
      }
      add(tool, (time) => (lead.stroke(time).tool === index ? lead.toolPose(time) : null), { tool: index });
    }
    for (const replay of shown()) {
      page.stage.objects.forEach((body, object) => {
        const own = wants(object) ? 'own' : 'other';
        const tint = layerColour(replay.layer);
        const node = replay === lead ? piece(body, colour(own), colour(`${own}-rim`)) : piece(body, tint, tint, true);
        if (replay === lead && body.whole === undefined) names.add(node, body.name, body.height * LENGTH);
        add(node, (time) => replay.object(object, time), { layer: replay.layer, object });
      });
    }
  }

  function light(middle, half) {
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    // From the left, so that shadows remain visible.
    sun.position.set(middle[0] - 1.7 * half, middle[1] - 0.2 * half, 2 * half);
    sun.target.position.set(...middle, 0);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.bias = -0.002;
    Object.assign(sun.shadow.camera, {
      left: -2 * half, right: 2 * half, top: 2 * half, bottom: -2 * half, near: half / 10, far: 8 * half,
    });
    sun.shadow.camera.updateProjectionMatrix();
    scene.add(sun, sun.target, new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.7));
  }

  function render() {
    if (!ready || figure.hidden) return;
    renderer.render(scene, camera);
    names.show(camera);
  }

  function move() {
    for (const { node, place } of moved) {
      const pose = place(view.time);
      node.visible = pose !== null;
      if (pose) placed(node, pose, node.position.z);
    }
    render();
  }

  function draw() {
    if (!ready || figure.hidden) return;
    scene.traverse((node) => {
      node.geometry?.dispose();
      node.material?.dispose();
    });
    scene.clear();
    names.clear();
    const [middle, half] = extent();
    drawTable(middle, half);
    drawStill();
    drawMoving();
    light(middle, half);
    const width = widthOf(figure);
    const height = Math.round(Math.min(520, width * 0.66));
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    move();
  }

  /** Moves the camera to its initial position, at the lower edge of the top view. */
  function home() {
    const [[x, y], half] = extent();
    controls.target.set(x, y, 0);
    camera.position.set(x, y - 1.8 * half, 2 * half);
    controls.update();
    render();
  }

  /** Rotates the camera about the vertical, tilts it, and zooms. */
  function orbit(turn, tilt, away) {
    const from = camera.position.clone().sub(controls.target);
    const far = from.length();
    const around = Math.atan2(from.y, from.x) + turn;
    const up = Math.min(1.55, Math.max(0.05, Math.asin(from.z / far) + tilt));
    const flatPart = far * away * Math.cos(up);
    camera.position.set(flatPart * Math.cos(around), flatPart * Math.sin(around), far * away * Math.sin(up))
      .add(controls.target);
    controls.update();
    render();
  }

  /** Loads `THREE`, which the page holds compressed. */
  async function unpack() {
    const packed = Uint8Array.from(atob(byId('three').textContent), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    document.body.append(html('script', {}, await new Response(stream).text()));
  }

  async function begin() {
    if (!document.createElement('canvas').getContext('webgl2')) {
      throw new Error('The 3-D view needs WebGL 2, which this browser does not provide. The page shows a drawing instead.');
    }
    if (!('DecompressionStream' in window)) {
      throw new Error('The 3-D view needs a browser from 2023 or later. The page shows a drawing instead.');
    }
    await unpack();
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    renderer.shadowMap.enabled = true;
    scene = new THREE.Scene();
    camera = new THREE.PerspectiveCamera(38, 1, 0.01, 50);
    camera.up.set(0, 0, 1);
    controls = new THREE.OrbitControls(camera, canvas);
    controls.maxPolarAngle = 1.52;
    // The wheel zooms only after a click, so that it does not interrupt scrolling.
    controls.enableZoom = false;
    canvas.addEventListener('focus', () => { controls.enableZoom = true; });
    canvas.addEventListener('blur', () => { controls.enableZoom = false; });
    ready = true;
    Object.assign(keys, {
      a: () => orbit(-0.15, 0, 1),
      d: () => orbit(0.15, 0, 1),
      w: () => orbit(0, 0.1, 1),
      s: () => orbit(0, -0.1, 1),
      '+': () => orbit(0, 0, 0.85),
      '-': () => orbit(0, 0, 1 / 0.85),
      h: home,
      v: () => show(figure.hidden),
    });
    byId('more-keys').textContent = ' In the 3-D view, a and d rotate, w and s tilt, plus and minus zoom, h resets '
      + 'the camera; v switches between the views.';
    words.textContent = 'Drag to rotate, drag with the right button to move. After a click, the wheel zooms.';
    show(true);
    home();
    controls.addEventListener('change', render);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    new ResizeObserver(() => { if (widthOf(figure) !== canvas.clientWidth) draw(); }).observe(figure);
    whenPlanChanges.push(draw);
    whenTimeChanges.push(move);
  }

  flat.before(buttons, figure, words);
  figure.hidden = true;
  buttons.hidden = true;
  const begun = begin().then(() => { buttons.hidden = false; }, (error) => {
    figure.hidden = true;
    flat.hidden = false;
    words.textContent = error.message;
    words.hidden = false;
  });

  return {
    /** Resolves when the view is ready, or the page states why there is none. */
    begun,
    /** Returns the drawn position of an object of a layer, metres. */
    where: (layer, object) => moved.find((one) => one.layer === layer && one.object === object)?.node.position.toArray(),
    /** Returns the pixel of the canvas that shows a point of the world. */
    pixel: (point) => {
      const { x, y } = new THREE.Vector3(...point).project(camera);
      return [((x + 1) / 2) * canvas.width, ((1 - y) / 2) * canvas.height];
    },
    render,
  };
})();
