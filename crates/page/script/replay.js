// Trajectories: unpacking, and poses interpolated between frames.

/** Returns the values of a column, stored as the first value and differences, or as one for all `count` frames. */
function unpacked(column, count, unit) {
  const values = new Float64Array(count);
  let sum = 0;
  for (let k = 0; k < count; k++) {
    sum += k < column.length ? column[k] : 0;
    values[k] = sum * unit;
  }
  return values;
}

const between = (a, b, share) => a.map((value, k) => value + (b[k] - value) * share);

class Replay {
  constructor(raw, strokes) {
    const count = raw.time.length;
    // The third column of a pose and the columns after the fourth are angles or shares.
    const columns = (pose) => pose.map((column, c) => unpacked(column, count, c === 2 || c > 3 ? FINE : LENGTH));
    this.layer = raw.layer;
    this.by = raw.by;
    this.reached = raw.reached;
    this.time = unpacked(raw.time, count, FINE);
    this.end = this.time[count - 1];
    this.tool = columns(raw.tool);
    this.objects = raw.objects.map(columns);
    this.measure = raw.measure?.map((value) => value * LENGTH);
    this.graph = raw.graph;
    this.firsts = raw.strokes;
    this.strokes = strokes;
  }

  /** Returns the index of the last frame at or before `time`, and the share of the way to the next one. */
  place(time) {
    let [low, high] = [0, this.time.length - 1];
    if (time >= this.end) return [high, 0];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= time) low = middle;
      else high = middle;
    }
    const span = this.time[high] - this.time[low];
    return [low, span > 0 ? Math.max(0, (time - this.time[low]) / span) : 0];
  }

  /** Returns the pose of an object at `time`. */
  object(index, time) {
    return this.pose(this.objects[index], this.place(time));
  }

  /** Returns the current stroke at `time`. */
  stroke(time) {
    const [frame] = this.place(time);
    return this.strokes[Math.max(0, this.firsts.findLastIndex((first) => first <= frame))];
  }

  /** Returns the pose of the tool frame at `time`. Lowering the tool takes no time. */
  toolPose(time) {
    const [frame, share] = this.place(time);
    const stroke = this.firsts.indexOf(frame + 1);
    if (share > 0 && stroke > 0 && this.strokes[stroke].lowered) {
      const from = posed(this.strokes[stroke].from);
      return between(from, this.pose(this.tool, [frame + 1, 0]), share);
    }
    return this.pose(this.tool, [frame, share]);
  }

  pose(columns, [frame, share]) {
    const here = columns.map((column) => column[frame]);
    if (share === 0) return here;
    return between(here, columns.map((column) => column[frame + 1]), share);
  }

  /** Returns the goal error at `time`, or the other measured quantity, metres or thousandths of a degree. */
  error(time) {
    if (angular) return ((this.headingError(time) * 180) / Math.PI) * 1e-3;
    if (this.measure) {
      const [frame, share] = this.place(time);
      const here = this.measure[frame];
      return share === 0 ? here : here + (this.measure[frame + 1] - here) * share;
    }
    const [x, y] = this.object(goals[0].objects[0], time);
    return Math.hypot(x - goals[0].at[0] * LENGTH, y - goals[0].at[1] * LENGTH);
  }

  /** Returns the error from the nearest accepted heading, radians. */
  headingError(time) {
    const [goal] = goals;
    const heading = this.object(goal.objects[0], time)[2];
    if (goal.middle !== undefined) {
      const turn = heading - goal.middle * FINE;
      const off = Math.atan2(Math.sin(turn), Math.cos(turn));
      return Math.abs(off + (goal.middle - goal.heading[0]) * FINE);
    }
    const turn = (heading - goal.heading[0] * FINE) * goal.alike;
    return Math.abs(Math.atan2(Math.sin(turn), Math.cos(turn))) / goal.alike;
  }
}

/** Returns the replays of a plan in the order of layers; each plan is unpacked at its first use. */
const replaysOf = (() => {
  const known = new Map();
  return (plan) => {
    if (!known.has(plan)) {
      known.set(plan, plan.replays.map((raw) => new Replay(raw, plan.strokes)));
    }
    return known.get(plan);
  };
})();
