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
function goalMarks({ bands = [], covers = [], edges = [] }, px, map) {
  const points = (corners) => corners.map(([x, y]) => map([x * LENGTH, y * LENGTH]).join(',')).join(' ');
  const marks = [];
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
