

# Time steps. Contacts of an exported scene may be unstable at its time step, which looks like a
# failure.

NOT_FINITE = "not finite"
TOO_FAST = "moves too fast"
FINEST = 16  # largest number by which a time step is divided


class Failed(Exception):
    """Failure of the plan before its end."""


def check_finite(data):
    """Raises `Failed` if MuJoCo found no finite state and has reset the scene."""
    kinds = mujoco.mjtWarning
    bad = kinds.mjWARN_BADQPOS, kinds.mjWARN_BADQVEL, kinds.mjWARN_BADQACC
    if any(data.warning[kind].number for kind in bad):
        raise Failed(NOT_FINITE)


def decided(play):
    """Returns the first stable result of `play`, which receives the divisor of the time step.

    An unstable replay is repeated with half the time step, and the last one counts in any case.
    `runs` lists all replays.
    """
    runs, finer = [], 1
    while True:
        result = play(finer)
        runs.append({"timestep": result["timestep"], "failure": result["failure"]})
        finer *= 2
        if result["failure"] not in (NOT_FINITE, TOO_FAST) or finer > FINEST:
            return {**result, "runs": runs}


# Checks of goals, which the scene holds as JSON. A check is a quantity with limits, or a minimum
# number of goals of a group.


def judged(check, scene):
    """Returns whether a check holds at the end, and (quantity, error) of all its quantities."""
    if "at_least" in check:
        found = [judged(one, scene) for one in check["at_least"]["of"]]
        held = sorted(found, key=lambda one: not one[0])[: check["at_least"]["count"]]
        return all(met for met, _ in held), [error for _, errors in held for error in errors]
    within = check["within"]
    (name, asked), = within["quantity"].items()
    value = QUANTITIES[name](scene, **asked)
    low, high = within.get("low"), within.get("high")
    error = max(0.0 if low is None else low - value, 0.0 if high is None else value - high, 0.0)
    if name in ("distance", "turn"):
        error = value
    if name == "covered":
        error = math.dist(scene.seen(asked["object"], asked.get("frame"))[:2], asked["at"][:2])
    met = (low is None or value >= low) and (high is None or value <= high)
    return met, [(name, error)]


def all_judged(scene, texts):
    """Returns whether all goals are met, and distance and heading error of the first one."""
    met, errors = True, None
    for goal in json.loads(texts["goals"]):
        held, found = judged(goal["check"], scene)
        met, errors = met and held, found if errors is None else errors
    turns = [error for name, error in errors if name == "turn"]
    others = [error for name, error in errors if name != "turn"]
    return met, max(others, default=0.0), max(turns, default=None)


def distance(scene, object, to, frame=None):
    return math.dist(scene.seen(object, frame)[:2], to)


def turn(scene, object, heading, symmetry, frame=None, middle=None):
    """Returns the rotation from the nearest equivalent heading; headings are nearest to `middle`,
    if it is given."""
    found = scene.seen(object, frame)[2]
    if middle is not None:
        return abs(middle + math.remainder(found - middle, math.tau) - heading)
    return abs(math.remainder(found - heading, math.tau / symmetry))


def beyond(scene, object, corners, frame=None):
    """Returns the distance of a centre from a convex region, metres; negative inside."""
    ends = np.array(corners)
    sides = np.roll(ends, -1, axis=0) - ends
    outwards = np.stack([sides[:, 1], -sides[:, 0]], axis=1)
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    point = np.array(scene.seen(object, frame)[:2])
    return float(np.max(np.sum((point - ends) * outwards, axis=1)))


def over(scene, object, centre, edges, part=None):
    """Returns how far the centre of mass of a fallen object is beyond the wanted edge, metres. If
    only a part of the edge counts, the distance from the ends of this part is a limit as well."""
    if not scene.has_left(object):
        return -math.inf
    edges = np.array(edges)
    x, y, heading = scene.seen(object)
    cos, sin = math.cos(heading), math.sin(heading)
    there = np.array([[cos, -sin], [sin, cos]]) @ centre + [x, y]
    beyond = float(np.max(edges[:, :2] @ there - edges[:, 2]))
    if part is None:
        return beyond
    along = float(np.abs(edges[0, 1::-1]) @ there)
    return min(beyond, along - part[0], part[1] - along)


def outlines(pieces, pose):
    """Returns polygons in the world for a pose of their body."""
    x, y, heading = pose
    cos, sin = math.cos(heading), math.sin(heading)
    return [np.array(corners) @ np.array([[cos, sin], [-sin, cos]]) + [x, y] for corners in pieces]


def gap(scene, object, own, others, other=None):
    """Returns the smallest distance between the outlines of an object and another body; 0 if they
    overlap."""
    there = outlines(others, [0, 0, 0] if other is None else scene.seen(other))
    return min(apart(a, b) for a in outlines(own, scene.seen(object)) for b in there)


def apart(first, second):
    """Returns the distance of two convex polygons."""

    def from_sides(points, corners):
        sides = np.roll(corners, -1, axis=0) - corners
        off = points[:, None] - corners
        along = np.clip(np.sum(off * sides, axis=2) / np.sum(sides * sides, axis=1), 0.0, 1.0)
        return np.linalg.norm(off - along[..., None] * sides, axis=2).min()

    # Whether an edge of the first polygon separates it from the second.
    def separates(corners, points):
        sides = np.roll(corners, -1, axis=0) - corners
        outwards = np.stack([sides[:, 1], -sides[:, 0]], axis=1)
        beyond = np.sum((points[:, None] - corners) * outwards, axis=2)
        return np.any(np.min(beyond, axis=0) > 0.0)

    if not (separates(first, second) or separates(second, first)):
        return 0.0
    return float(min(from_sides(first, second), from_sides(second, first)))


def covered(scene, object, at, pieces, frame=None):
    """Returns the share of the wanted outline that an object covers."""

    def area(corners):
        x, y = np.transpose(corners)
        return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))

    def common(corners, other):
        for start, end in zip(other, np.roll(other, -1, axis=0)):
            before, corners = corners, []
            along = end - start
            inside = [along[0] * (p - start)[1] - along[1] * (p - start)[0] for p in before]
            for k, (p, a) in enumerate(zip(before, inside)):
                q, b = before[(k + 1) % len(before)], inside[(k + 1) % len(before)]
                if a >= 0.0:
                    corners.append(p)
                if a * b < 0.0:
                    corners.append(p + (q - p) * (a / (a - b)))
        return area(corners) if corners else 0.0

    wanted, own = outlines(pieces, at), outlines(pieces, scene.seen(object, frame))
    return sum(common(list(a), b) for a in wanted for b in own) / sum(area(a) for a in wanted)


def raised(scene, object):
    """Returns how far the last lever-up lifted the edge of an object, metres. Contact with the
    blade is not checked."""
    return scene.lifted(object)


def tilt(scene, object):
    """Returns the angle between the upper side of an object and the vertical, radians."""
    return scene.leaning(object)


QUANTITIES = {
    "distance": distance,
    "turn": turn,
    "beyond": beyond,
    "over": over,
    "gap": gap,
    "covered": covered,
    "raised": raised,
    "tilt": tilt,
}


def seen(pose, frame):
    """Returns a pose in the frame of another pose."""
    x, y, turn = (own - other for own, other in zip(pose, frame))
    cos, sin = math.cos(frame[2]), math.sin(frame[2])
    return [cos * x + sin * y, cos * y - sin * x, turn]


def texts(model):
    """Returns the texts of a scene by name."""
    found = {}
    for k in range(model.ntext):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TEXT, k)
        begin, size = model.text_adr[k], model.text_size[k]
        found[name] = bytes(model.text_data[begin : begin + size]).rstrip(b"\0").decode()
    return found


if __name__ == "__main__":
    sys.exit(main())
