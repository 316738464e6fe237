"""Wrong edits of pushes and of lever-ups, for `edited.py`.

An edit gets a plan file and one of its steps, and returns False where it does not apply. Lengths
are in metres.
"""

import copy
import math

BOTTLE = {"name": "bottle", "shape": {"cylinder": {"radius": 0.015, "height": 0.3}}, "mass": 1.0}
BLOCK = {"name": "block", "shape": {"cuboid": {"size": [0.03, 0.03, 0.06]}}, "mass": 5.0}


def along(direction, length):
    return [length * math.cos(direction), length * math.sin(direction)]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def end(push):
    return plus(push["start"], along(push["direction"], push["length"]))


def set_to(**values):
    """Returns an edit that sets fields of the step."""
    return lambda file, step: step.update(values)


def changed(key, change):
    """Returns an edit that changes a number of the step; it must not stay the same."""

    def edit(file, step):
        before = step[key]
        step[key] = change(before)
        return step[key] != before

    return edit


def add(file, kind, thing, position):
    # The stated end of the file has no such object.
    file.update(predicted=None, verdict=None)
    file["task"]["scene"][kind].append({"friction": 0.4, **thing, "position": position})


# Edits of pushes.


def form(file, push):
    push["form"] = "placed" if push["form"] == "chained" else "chained"


def longer(file, push):
    """Keeps the end of a push, and starts farther back than refinement may."""
    at, length = end(push), 1.6 * file["task"]["pushes"]["length"]
    push.update(start=plus(at, along(push["direction"], -length)), length=length)


def blocked(file, push):
    thing = {"name": "in-the-hand", "size": [0.01, 0.01, 0.4]}
    add(file, "obstacles", thing, end(push))


def in_the_base(file, push):
    file["task"]["robot"]["base"] = "none"
    push["start"] = [0.0, 0.0]


def split(file, push):
    """Adds pushes of the last millimetre until there is one too many."""
    steps = file["plan"]["steps"]
    if "push" not in steps[-1]:
        return False
    last = steps[-1]["push"]
    short = dict(last, start=plus(end(last), along(last["direction"], -0.001)), length=0.001)
    steps += [{"push": dict(short)}] * (file["task"]["pushes"]["max_count"] + 1)


def heavy(file, push):
    file["task"]["robot"].update(max_force=30.0)
    for thing in file["task"]["scene"]["objects"]:
        thing.update(mass=500.0)


def in_the_hand(file, push):
    """Puts a tall bottle where the hand passes, but the tool does not."""
    if "hand" not in file["task"]["robot"]:
        return False
    tool = next(tool for tool in file["tools"] if tool["name"] == push["tool"])
    goals = [one["position"] for one in goals_of(file) if "position" in one]
    objects = [one["position"] for one in file["task"]["scene"]["objects"]]
    for share in (0.5, 0.75, 1.0, 0.25):
        middle = plus(push["start"], along(push["direction"], share * push["length"]))
        for turn in range(24):
            at = plus(middle, along(turn * math.pi / 12, 0.055))
            far = all(math.dist(at, one) > 0.18 for one in goals + objects)
            if far and not touched(tool, push, at):
                return add(file, "objects", BOTTLE, at)
    return False


def touched(tool, push, at):
    """Returns whether a part of the tool comes near a place during a push."""
    if tool["grip"]["yaw_deg"] or "blade" in tool:
        return True
    cos, sin = math.cos(push["grip_yaw"]), math.sin(push["grip_yaw"])
    for k in range(41):
        hand = plus(push["start"], along(push["direction"], push["length"] * k / 40))
        x, y = at[0] - hand[0], at[1] - hand[1]
        own = plus([cos * x + sin * y, cos * y - sin * x], tool["grip"]["position"])
        for part in tool["parts"]:
            reach = 0.5 * math.hypot(*part.get("size", [0.2, 0.2])[:2]) + 0.02
            if math.dist(own, part["position"]) < reach and near(part, own):
                return True
    return False


def near(part, own):
    if "size" not in part:
        return True
    turn = math.radians(part["yaw_deg"])
    x, y = own[0] - part["position"][0], own[1] - part["position"][1]
    x, y = math.cos(turn) * x + math.sin(turn) * y, math.cos(turn) * y - math.sin(turn) * x
    return abs(x) < 0.5 * part["size"][0] + 0.02 and abs(y) < 0.5 * part["size"][1] + 0.02


def goals_of(file):
    goal = file["task"]["goal"]
    return goal if isinstance(goal, list) else [goal]


def goal(file, step):
    """Moves the goals, or asks for the other side of a plate."""
    placed = [one for one in goals_of(file) if "position" in one]
    for one in placed:
        one["position"][0] += 3 * one["tolerance"]
    sides = [one for one in goals_of(file) if "flipped" in one]
    for one in sides:
        one["flipped"] = not one["flipped"]
    return bool(placed or sides)


PUSHES = {
    "lift": changed("lift", lambda lift: lift + 0.01),
    "lift-a-little": changed("lift", lambda lift: lift + 0.0002),
    "yaw": changed("grip_yaw", lambda yaw: yaw + 0.02),
    "fast": changed("speed", lambda speed: 3 * speed),
    "slow": changed("speed", lambda speed: 0.5 * speed),
    "turned-round": changed("direction", lambda angle: angle + math.pi),
    "too-far": set_to(start=[2.0, 0.0]),
    "tool": set_to(tool="no-such-tool"),
    "another-tool": lambda file, push: file["task"].update(tools=["no-such-tool"]),
    "weak-robot": lambda file, push: file["task"]["robot"].update(max_force=0.5),
    "nothing": lambda file, push: file["plan"].update(steps=[]),
    "form": form, "longer": longer, "blocked": blocked, "in-the-base": in_the_base,
    "split": split, "heavy": heavy, "in-the-hand": in_the_hand, "goal": goal,
}


# Edits of lever-ups.


def rules(file):
    return file["task"]["levers"]


def beyond(key, rule, end):
    """Returns an edit that puts a number beyond an end of the task's range."""

    def edit(file, lever):
        low, high = (math.radians(v) if rule == "angle_deg" else v for v in rules(file)[rule])
        lever[key] = low - 0.1 * (high - low) if end == "low" else high + 0.1 * (high - low)
        return low < high and lever[key] > 0

    return edit


def behind(file, lever, distance):
    """Returns the place at a distance from the edge of a cuboid, outward."""
    thing = file["task"]["scene"]["objects"][lever["object"]]
    if "cuboid" not in thing["shape"] or thing.get("parts") or "expected" in lever:
        return None
    x, y = (0.5 * size for size in thing["shape"]["cuboid"]["size"][:2])
    corners = [[-x, -y], [x, -y], [x, y], [-x, y]]
    edge = lever["place"]["edge"]
    a, b = corners[edge], corners[(edge + 1) % 4]
    at = plus(a, [lever["place"]["fraction"] * (q - p) for p, q in zip(a, b)])
    at = plus(at, along(math.atan2(b[1] - a[1], b[0] - a[0]) - math.pi / 2, distance))
    turn = math.radians(thing.get("yaw_deg", 0.0))
    at = [math.cos(turn) * at[0] - math.sin(turn) * at[1],
          math.sin(turn) * at[0] + math.cos(turn) * at[1]]
    return plus(at, thing["position"])


def at_the_fingers(kind, thing):
    """Returns an edit that puts something where the fingers hold the blade."""

    def edit(file, lever):
        tool = next(tool for tool in file["tools"] if tool["name"] == lever["tool"])
        at = behind(file, lever, tool["blade"]["length"] - lever["depth"] + 0.02)
        if at is None or "hand" not in file["task"]["robot"]:
            return False
        return add(file, kind, thing, at)

    return edit


def in_the_way(file, lever):
    at = behind(file, lever, 0.04)
    return False if at is None else add(file, "objects", BLOCK, at)


def displaced(file, lever):
    at = lever.get("expected") or file["task"]["scene"]["objects"][lever["object"]]
    heading = at.get("heading", math.radians(at.get("yaw_deg", 0.0)))
    lever["expected"] = {"position": plus(at["position"], [0.03, 0.0]), "heading": heading}


def thick(file, lever):
    tool = next(tool for tool in file["tools"] if tool["name"] == lever["tool"])
    tool["blade"]["thickness"] = 0.05


def twice(file, lever):
    steps = file["plan"]["steps"]
    at = next(k for k, step in enumerate(steps) if step.get("lever_up") is lever)
    steps.insert(at, copy.deepcopy(steps[at]))


def corner(file, lever):
    lever["place"]["fraction"] = 0.01


def through(file, lever):
    """Allows any depth, and puts the tip beyond the object."""
    rules(file)["depth"] = [0.002, 0.2]
    lever["depth"] = 0.2
    return "cuboid" in file["task"]["scene"]["objects"][lever["object"]]["shape"]


LEVERS = {
    "blade-15-times": changed("speed", lambda speed: 15 * speed),
    "blade-a-little-fast": changed("speed", lambda speed: 1.1 * speed),
    "blade-slow": changed("speed", lambda speed: 0.5 * speed),
    "no-retreat": changed("retreat", lambda retreat: 0.0),
    "retreat": changed("retreat", lambda retreat: 0.5 * retreat),
    "no-hold": changed("hold", lambda hold: 0.0),
    "hold": changed("hold", lambda hold: hold + 1.0),
    "shallow": beyond("depth", "depth", "low"),
    "deep": beyond("depth", "depth", "high"),
    "angle": beyond("angle", "angle_deg", "high"),
    "small-angle": beyond("angle", "angle_deg", "low"),
    "pivot": changed("pivot", lambda pivot: pivot + 0.04),
    "object": set_to(object=9),
    "blade": set_to(tool="no-such-tool"),
    "held-by-obstacle": at_the_fingers("obstacles", {"name": "post", "size": [0.02, 0.02, 0.2]}),
    "held-by-object": at_the_fingers("objects", BLOCK),
    "displaced": displaced, "thick": thick, "twice": twice, "corner": corner,
    "through": through, "in-the-way": in_the_way, "other-goal": goal,
}
