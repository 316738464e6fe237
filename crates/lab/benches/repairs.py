#!/usr/bin/env python3
"""Breaks shipped tasks in seeded ways, and follows the repairs of `pushplan mcp` blindly.

    python3 crates/lab/benches/repairs.py --count 200 --seed 1
    python3 crates/lab/benches/repairs.py --count 200 --seed 1 --out repairs.json

Each broken task is solved; without a plan, the first repair of the answer is applied and the task
is solved again, with at most three calls. The result is `solved`, `cannot` (no repair, but a cause)
or `wrong` (a repair that led nowhere, or neither repair nor cause). `restored` counts repaired
tasks that equal the shipped one. The script needs the package `pushplan` with the extra `mcp`. The
exit code is 0 if none is wrong.
"""

import argparse
import collections
import copy
import json
import math
import random
import sys
import time

import pushplan
from pushplan.mcp.calls import Context, answer
from pushplan.mcp.edits import leaves, joined, split, value_at
from pushplan.mcp.units import is_length

#: Shipped tasks with a plan at effort draft within a second, without lever-ups.
SLOW = {"boxed-in", "too-far", "everything-hidden", "two-places", "handle-to-the-front"}
CALLS = 3
#: Time limit of a call, seconds.
LIMIT = 60.0


def tasks():
    """Returns the mappings of the tasks by name."""
    found = {}
    for name in pushplan.Task.examples():
        mapping = pushplan.Task.example(name).to_dict()
        if name not in SLOW and "levers" not in mapping:
            found[name] = mapping
    return found


def put(mapping, path, value):
    *above, last = split(path)
    for step in above:
        if isinstance(mapping, dict):
            mapping = mapping.setdefault(step, {})
        else:
            mapping = mapping[step]
    mapping[last] = value


def typo(rng, word):
    """Returns a word with a slip of the fingers: a letter lost, doubled, swapped or replaced."""
    k = rng.randrange(len(word))
    kind = rng.randrange(4)
    if kind == 0 and len(word) > 3:
        return word[:k] + word[k + 1 :]
    if kind == 1:
        return word[:k] + word[k] + word[k:]
    if kind == 2 and k + 1 < len(word):
        return word[:k] + word[k + 1] + word[k] + word[k + 2 :]
    return word[:k] + rng.choice("aeiourstn") + word[k + 1 :]


def maps(value, path=()):
    """Yields the paths of all maps."""
    if isinstance(value, dict):
        yield path
        for key, inner in value.items():
            yield from maps(inner, (*path, key))
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from maps(inner, (*path, k))


def misspelt_key(rng, mapping):
    path = list(rng.choice(list(maps(mapping))))
    inner = value_at(mapping, joined(path)) if path else mapping
    if not inner:
        return False
    key = rng.choice(list(inner))
    new = typo(rng, key)
    if new in inner:
        return False
    items = [(new if one == key else one, value) for one, value in inner.items()]
    inner.clear()
    inner.update(items)
    return True


def misspelt_name(rng, mapping):
    goals = mapping["goal"] if isinstance(mapping["goal"], list) else [mapping["goal"]]
    places = [(goal, "object") for goal in goals if "object" in goal]
    places += [(goal, "relative_to") for goal in goals if goal.get("relative_to")]
    if isinstance(mapping["tools"], list):
        plain = [k for k, name in enumerate(mapping["tools"]) if isinstance(name, str)]
        places += [(mapping["tools"], k) for k in plain]
    for joint in mapping["scene"].get("joints", []):
        places += [(joint["between"], k) for k in range(2) if joint["between"][k] != "world"]
    inner, key = rng.choice(places)
    inner[key] = typo(rng, inner[key])
    return True


def misspelt_twice(rng, mapping):
    # A misspelt key hides the names below it.
    return misspelt_name(rng, mapping) and misspelt_key(rng, mapping)


def lengths(mapping):
    """Returns the paths of the lengths of the scene and of the goals."""
    found = {}
    for steps, value in leaves(mapping):
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if number and value and is_length(steps):
            found[joined(steps)] = value
    return found


def scaled(mapping, paths, factor):
    for path in paths:
        put(mapping, path, round(value_at(mapping, path) * factor, 6))
    return bool(paths)


def unit_of_one(rng, mapping):
    """A list or a number, such as one position, in millimetres or centimetres."""
    found = lengths(mapping)
    path = rng.choice(list(found))
    above = joined(split(path)[:-1]) if path.endswith("]") else path
    group = [one for one in found if one == path or one.startswith(above + "[")]
    return scaled(mapping, group, rng.choice([100.0, 1000.0]))


def unit_of_object(rng, mapping):
    k = rng.randrange(len(mapping["scene"]["objects"]))
    prefix = f"scene.objects[{k}]."
    group = [one for one in lengths(mapping) if one.startswith(prefix)]
    return scaled(mapping, group, rng.choice([100.0, 1000.0]))


def unit_of_all(rng, mapping):
    return scaled(mapping, list(lengths(mapping)), rng.choice([100.0, 1000.0]))


def first_goal(mapping):
    goal = mapping["goal"][0] if isinstance(mapping["goal"], list) else mapping["goal"]
    alone = "relative_to" not in goal and not mapping["scene"].get("joints")
    return goal if "position" in goal and alone else None


def out_of_reach(rng, mapping):
    goal = first_goal(mapping)
    if goal is None or "size" in mapping["scene"].get("table", {}):
        return False
    far = rng.uniform(1.6, 2.4) / max(abs(goal["position"][0]), 0.1)
    goal["position"] = [round(value * far, 3) for value in goal["position"]]
    return True


def narrow_gap(rng, mapping):
    """Two walls between the first object and its goal, with a gap narrower than the object."""
    goal = first_goal(mapping)
    if goal is None:
        return False
    objects = {one["name"]: one for one in mapping["scene"]["objects"]}
    shape = objects[goal["object"]]["shape"]
    if "cylinder" not in shape or len(objects) > 1:
        return False
    x, y = objects[goal["object"]]["position"][:2]
    to_x, to_y = goal["position"]
    turn = math.degrees(math.atan2(to_y - y, to_x - x))
    radius = shape["cylinder"]["radius"]
    if ((to_x - x) ** 2 + (to_y - y) ** 2) ** 0.5 < 2 * radius + 0.08:
        return False
    gap = rng.uniform(0.5, 0.95) * 2 * radius
    across = [-(to_y - y), to_x - x]
    size = (across[0] ** 2 + across[1] ** 2) ** 0.5
    for side, sign in (("left", 1), ("right", -1)):
        off = sign * (gap / 2 + 0.5) / size
        middle = ((x + to_x) / 2, (y + to_y) / 2)
        place = [round(middle[k] + off * across[k], 4) for k in range(2)]
        mapping["scene"].setdefault("obstacles", []).append(
            {"name": f"gap-{side}", "size": [0.02, 1.0, 0.12], "position": place, "yaw_deg": turn}
        )
    return True


def too_weak(rng, mapping):
    mapping["robot"]["max_force"] = round(rng.uniform(0.1, 0.6), 2)
    return True


def too_few(rng, mapping):
    mapping["pushes"]["max_count"] = 1
    mapping["pushes"]["length"] = round(rng.uniform(0.2, 0.6) * mapping["pushes"]["length"], 3)
    return True


def wrong_tools(rng, mapping):
    used = pushplan.solve(pushplan.Task.from_dict(mapping), effort="draft", threads=1).best
    if used is None or not used.pushes:
        return False
    others = set(pushplan.ToolLibrary.shipped().names) - {tool.name for tool in used.tools}
    mapping["tools"] = [rng.choice(sorted(others))]
    return True


KINDS = [
    misspelt_key, misspelt_name, misspelt_twice, unit_of_one, unit_of_object, unit_of_all,
    out_of_reach, narrow_gap, too_weak, too_few, wrong_tools,
]  # fmt: skip


def status(mapping, context):
    arguments = {"task": mapping, "effort": "draft", "repair": False}
    return answer("solve", arguments, context)["status"]


def followed(mapping, context):
    """Returns the result of blind following, the number of calls, the last answer and task."""
    for call in range(1, CALLS + 1):
        found = answer("solve", {"task": mapping, "effort": "draft"}, context)
        if found["status"] == "solved":
            return "solved", call, found, mapping
        if not found["repairs"]:
            return "cannot" if found["cause"] else "wrong", call, found, mapping
        mapping = found["repairs"][0]["task"]
    return "wrong", CALLS, found, mapping


def same(one, other):
    """Returns `True` if two mappings are the same task."""
    try:
        return pushplan.Task.from_dict(one) == pushplan.Task.from_dict(other)
    except pushplan.PushplanError:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--kind", help="only this kind of break")
    parser.add_argument("--out", help="file for all results (JSON)")
    options = parser.parse_args()
    context = Context(LIMIT, options.threads, lambda now: None)
    rng, shipped = random.Random(options.seed), tasks()
    kinds = [one for one in KINDS if options.kind in (None, one.__name__)]
    rows, unbroken = [], 0
    while len(rows) < options.count:
        kind = kinds[len(rows) % len(kinds)]
        name = rng.choice(sorted(shipped))
        mapping = copy.deepcopy(shipped[name])
        # A break that does no harm is drawn again.
        if not kind(rng, mapping) or status(mapping, context) == "solved":
            unbroken += 1
            continue
        begin = time.monotonic()
        result, calls, found, last = followed(mapping, context)
        rows.append(
            {
                "kind": kind.__name__, "task": name, "result": result, "calls": calls,
                "seconds": round(time.monotonic() - begin, 2),
                "restored": result == "solved" and same(last, shipped[name]),
                "cause": found["cause"], "status": found["status"], "broken": mapping,
                "repaired": last,
            }
        )  # fmt: skip
        seconds = rows[-1]["seconds"]
        cause = found["cause"] or ""
        print(len(rows), kind.__name__, name, result, calls, f"{seconds} s", cause, flush=True)
    print("\n|break|broken|solved|restored|cannot|wrong|calls, mean|time, mean|")
    print("|---" + 7 * "|--:" + "|")
    for kind in [None, *kinds]:
        mine = [row for row in rows if kind is None or row["kind"] == kind.__name__]
        if not mine:
            continue
        results = collections.Counter(row["result"] for row in mine)
        calls = sum(row["calls"] for row in mine) / len(mine)
        seconds = sum(row["seconds"] for row in mine) / len(mine)
        restored = sum(row["restored"] for row in mine)
        label = kind.__name__ if kind else "all"
        print(
            f"|{label}|{len(mine)}|{results['solved']}|{restored}|{results['cannot']}|"
            f"{results['wrong']}|{calls:.1f}|{seconds:.1f} s|"
        )
    if options.out:
        with open(options.out, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return int(any(row["result"] == "wrong" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
