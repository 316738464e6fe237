// Bodies seen from above, in the units of the data. Lengths are integers in hundredths of a millimetre. Angles
// and times are integers in ten-thousandths of a radian and of a second.

const LENGTH = 1e-5; // metres per unit of the data
const FINE = 1e-4; // radians or seconds per unit of the data

const posed = ([x, y, heading]) => [x * LENGTH, y * LENGTH, heading * FINE];

/** Returns the distance of the farthest corner from a body's own origin, metres. */
const radius = (shape) => LENGTH * ('disc' in shape ? shape.disc
  : Math.max(...shape.polygon.map(([x, y]) => Math.hypot(x, y))));

/** Returns the shape of a body about its own origin; `px` converts metres to pixels. */
function outlined(shape, px, attributes) {
  if ('disc' in shape) return svg('circle', { r: px(shape.disc * LENGTH), ...attributes });
  const corners = shape.polygon.map(([x, y]) => `${px(x * LENGTH)},${px(-y * LENGTH)}`);
  return svg('polygon', { points: corners.join(' '), ...attributes });
}

/** Returns the world position of a point in the frame of a pose. */
function placed([x, y, heading], [u, v]) {
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  return [x + c * u - s * v, y + s * u + c * v];
}

/** Returns an object and its parts, each with its pose if the object is at `pose`. */
function solidsAt(objects, index, pose) {
  const [x, y, heading] = posed(objects[index].at);
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  return objects.filter((body, k) => k === index || body.whole === index).map((body) => {
    const [u, v, turned] = posed(body.at);
    const own = [c * (u - x) + s * (v - y), c * (v - y) - s * (u - x)];
    return [body, [...placed(pose, own), pose[2] + turned - heading]];
  });
}

/** Returns the marks of a goal other than its position and areas; `map` converts a point in metres to pixels. */
function goalMarks({ arc, bands = [], covers = [], edges = [] }, px, map) {
  const points = (corners) => corners.map(([x, y]) => map([x * LENGTH, y * LENGTH]).join(',')).join(' ');
  const marks = arc ? arcMarks(arc, map) : [];
  for (const { pieces, from, to } of bands) for (const piece of pieces) {
    // A line about the outline with round corners covers exactly these distances.
    const width = Math.max(3, 2 * px(to * LENGTH));
    marks.push(svg('polygon', { points: points(piece), class: 'band', 'stroke-width': width }));
    if (from) marks.push(svg('polygon', { points: points(piece), class: 'leave' }));
  }
  for (const piece of covers) marks.push(svg('polygon', { points: points(piece), class: 'goal' }));
  for (const edge of edges) marks.push(svg('polyline', { points: points(edge), class: 'goal-edge' }));
  return marks;
}

/** Returns a point of an arc, metres; `share` of its radius away from the hinge. */
const onArc = ({ centre, radius: far }, angle, share = 1) => [0, 1].map(
  (k) => (centre[k] + share * far * [Math.cos, Math.sin][k](angle * FINE)) * LENGTH);

/** Returns the points of an arc between two angles, metres. */
function arcPoints(arc, from, to) {
  const count = Math.max(2, Math.ceil(Math.abs(to - from) * FINE * 20));
  return Array.from({ length: count + 1 }, (_, k) => onArc(arc, from + ((to - from) * k) / count));
}

/** Returns the pose at the wanted angle of a body that starts at `pose` and turns about a hinge. */
function swung({ centre, from, to }, [x, y, heading]) {
  const [hingeX, hingeY] = centre.map((value) => value * LENGTH);
  const turn = (to - from) * FINE;
  return [...placed([hingeX, hingeY, turn], [x - hingeX, y - hingeY]), heading + turn];
}

/** Returns the goal of a hinged object: the way of its far end, and the accepted angles as a sector. */
function arcMarks(arc, map) {
  const { from, to, tolerance } = arc;
  const points = (list) => list.map((point) => map(point).join(',')).join(' ');
  const hinge = onArc(arc, 0, 0);
  const [end, before] = [map(onArc(arc, to)), map(onArc(arc, to - Math.sign(to - from) * 300))];
  const turn = (Math.atan2(end[1] - before[1], end[0] - before[0]) * 180) / Math.PI;
  const [cx, cy] = map(hinge);
  return [
    svg('polygon', { points: points([hinge, ...arcPoints(arc, to - tolerance, to + tolerance)]), class: 'goal' }),
    svg('polyline', { points: points(arcPoints(arc, from, to)), class: 'arc' }),
    svg('path', { d: 'M-9-5l9 5-9 5', class: 'arc head', transform: `translate(${end.join(' ')}) rotate(${turn.toFixed(1)})` }),
    svg('circle', { cx, cy, r: 4, class: 'hinge' }, svg('title', {}, 'hinge')),
  ];
}

/** Returns the shape of a tool as one piece, rims first and fills over them, with the hand at its grip. */
function toolShape({ parts, grip }, hand, px, attributes) {
  const group = svg('g', attributes);
  for (const layer of ['rim', 'fill']) {
    for (const part of parts) {
      const [x, y, heading] = posed(part.at);
      const turn = `translate(${px(x)} ${px(-y)}) rotate(${(-heading * 180) / Math.PI})`;
      group.append(outlined(part.shape, px, { transform: turn, class: layer }));
    }
  }
  const [cx, cy] = posed(grip).slice(0, 2).map((value, k) => px(k ? -value : value));
  if (hand) group.append(svg('circle', { cx, cy, r: px(radius(hand.shape)), class: 'hand' }, svg('title', {}, 'hand')));
  group.append(svg('circle', { cx, cy, r: 4.5, class: 'grip' }));
  return group;
}

/** Returns the arrow along the way of the end effector in the stroke of index `k`. */
function strokeShapes(stroke, k, tools, map) {
  const grip = posed(tools[stroke.tool].grip);
  const [from, to] = [stroke.from, stroke.to].map((end) => map(placed(posed(end), grip)));
  const turn = (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI;
  return [
    svg('line', { x1: from[0], y1: from[1], x2: to[0], y2: to[1], class: 'push' }),
    svg('path', { d: 'M-9-5l9 5-9 5', class: 'push head', transform: `translate(${to[0]} ${to[1]}) rotate(${turn})` }),
    svg('circle', { cx: from[0], cy: from[1], r: 9, class: 'push-dot' }),
    svg('text', { x: from[0], y: from[1] + 4, class: 'push-number' }, `${k + 1}`),
  ];
}

/** Returns the centre of the reach in metres: the base of the robot. */
function baseOf(stage) {
  return (stage.base ?? [0, 0]).map((value) => value * LENGTH);
}

/** Returns the robot at its base: a dot, and its name below the base or the dot. */
function robotMark(stage, px, map) {
  const [cx, cy] = map(baseOf(stage));
  const low = Math.max(0, ...stage.obstacles.filter((body) => body.base).map((body) => radius(body.shape) * 0.71));
  return [
    svg('circle', { cx, cy, r: 4, class: 'robot' }, svg('title', {}, 'robot')),
    svg('text', { x: cx, y: cy + px(low) + 16, class: 'small middle' }, low ? 'robot base' : 'robot'),
  ];
}
