#!/usr/bin/env python3
"""Solves puzzles of many objects, from files of PushWorld or generated with a known solution.

    python3 crates/lab/benches/puzzles.py --solve target/release/pushplan --seconds 8 FOLDER...
    python3 crates/lab/benches/puzzles.py --solve target/release/pushplan --kind heap --objects 4

Generated are goals for all objects (`goals`), pairs that exchange places (`swap`) and an object
behind others (`heap`). A solution on the grid is known for each: pushes of single objects by a
plate that comes from above and needs a free cell behind them. Every puzzle is solved on one
thread with a limit of time. With `--mujoco` the plans are replayed there; it names a Python with
the package `mujoco`. The package `pushplan` converts the puzzles, as in `examples/pushworld.py`.
"""

import argparse
import importlib.util
import json
import random
import re
import resource
import shutil
import subprocess
import sys
from collections import deque
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
STEPS = [(1, 0), (-1, 0), (0, 1), (0, -1)]
SHAPES = [
    [(0, 0)],
    [(0, 0), (0, 1)],
    [(0, 0), (1, 0)],
    [(0, 0), (0, 1), (1, 0)],
    [(0, 0), (0, 1), (0, 2)],
]


def moved(cells, step, count=1):
    return frozenset((row + count * step[0], column + count * step[1]) for row, column in cells)


class Grid:
    """A grid of cells with walls and objects, each a set of cells."""

    def __init__(self, rows, columns, walls):
        self.rows, self.columns, self.walls = rows, columns, walls

    def is_free(self, cells, others):
        """Returns whether cells are inside, and free of walls and of other objects."""
        inside = all(0 <= r < self.rows and 0 <= c < self.columns for r, c in cells)
        return inside and not cells & self.walls and not any(cells & other for other in others)

    def pushes(self, cells, others):
        """Yields the steps by which a plate behind an object can push it."""
        for step in STEPS:
            ahead, back = moved(cells, step), (-step[0], -step[1])
            behind = moved(cells, back) - cells
            held = any(self.is_free(frozenset([cell]), [*others, cells]) for cell in behind)
            if held and self.is_free(ahead, others):
                yield step, ahead

    def path(self, start, is_goal, others):
        """Returns the shortest pushes of an object to a goal; `None` without any."""
        before, queue = {start: None}, deque([start])
        while queue:
            cells = queue.popleft()
            if is_goal(cells):
                steps = []
                while before[cells]:
                    cells, step = before[cells]
                    steps.append(step)
                return steps[::-1]
            for step, ahead in self.pushes(cells, others):
                if ahead not in before:
                    before[ahead] = (cells, step)
                    queue.append(ahead)
        return None

    def text(self, objects, goals):
        """Returns the puzzle in the format of PushWorld."""
        names = [[[] for _ in range(self.columns)] for _ in range(self.rows)]
        for row, column in self.walls:
            names[row][column].append("W")
        for kind, all_cells in (("M", objects), ("G", goals)):
            for k, cells in all_cells.items():
                for row, column in cells:
                    names[row][column].append(f"{kind}{k}")
        return "\n".join(" ".join("+".join(cell) or "." for cell in row) for row in names)


class Draw:
    """A random puzzle with a known solution."""

    def __init__(self, count, seed):
        self.rng = random.Random(seed)
        side = 7 + 2 * round(count**0.5)
        cells = [(row, column) for row in range(side) for column in range(side)]
        self.grid = Grid(side, side, frozenset(self.rng.sample(cells, side * side // 14)))
        self.objects, self.count = {}, count

    def others(self, k):
        return [cells for other, cells in self.objects.items() if other != k]

    def place(self, k, shape, rows, columns):
        """Places an object at random between two rows and two columns; raises LookupError."""
        for _ in range(200):
            at = (self.rng.randint(*rows), self.rng.randint(*columns))
            cells = frozenset((row + at[0], column + at[1]) for row, column in shape)
            if self.grid.is_free(cells, self.others(k)):
                self.objects[k] = cells
                return
        raise LookupError("no place")

    def carry(self, k, is_goal):
        """Pushes an object to a goal on the shortest way; raises LookupError without any."""
        steps = self.grid.path(self.objects[k], is_goal, self.others(k))
        if steps is None:
            raise LookupError("no way")
        for step in steps:
            self.objects[k] = moved(self.objects[k], step)
        return [(k, step) for step in steps]

    def park(self, k, kept):
        """Pushes an object to a random place outside of cells that must stay free."""
        start = self.objects[k]
        for _ in range(60):
            at = (self.rng.randrange(self.grid.rows), self.rng.randrange(self.grid.columns))
            try:
                witness = self.carry(k, lambda cells, at=at: at in cells)
            except LookupError:
                continue
            if not self.objects[k] & kept:
                return witness
            self.objects[k] = start
        raise LookupError("nothing to park at")

    def goals(self):
        last = self.grid.rows - 1
        for k in range(self.count):
            self.place(k, self.rng.choice(SHAPES), (0, last), (0, last))
        first, witness = dict(self.objects), []
        for k in range(self.count):
            witness += self.park(k, first[k])
        return first, dict(self.objects), witness

    def swap(self):
        last = self.grid.rows - 1
        for k in range(0, self.count, 2):
            shape = self.rng.choice(SHAPES)
            self.place(k, shape, (0, last), (0, last))
            self.place(k + 1, shape, (0, last), (0, last))
        first, witness, goals = dict(self.objects), [], {}
        for k in range(0, self.count, 2):
            one, other = first[k], first[k + 1]
            witness += self.park(k, one | other)
            witness += self.carry(k + 1, lambda cells, one=one: cells == one)
            witness += self.carry(k, lambda cells, other=other: cells == other)
            goals |= {k: other, k + 1: one}
        return first, goals, witness

    def heap(self):
        last, middle = self.grid.rows - 1, self.grid.rows // 2
        near = (middle - 2, middle + 2)
        for k in range(self.count):
            self.place(k, self.rng.choice(SHAPES), near, near)
        first = dict(self.objects)
        target = first[0]
        kept = frozenset((r, c) for r in range(near[0], near[1] + 1) for c in range(*near))
        witness = []
        for k in self.rng.sample(range(1, self.count), self.count - 1):
            witness += self.park(k, kept)
        corner = self.rng.choice([0, last]), self.rng.choice([0, last])
        witness += self.carry(0, lambda cells: corner in cells)
        assert self.objects[0] != target
        return first, {0: self.objects[0]}, witness


def generated(kind, count, seed):
    """Returns a puzzle of one kind and the number of pushes of its known solution."""
    for attempt in range(1000):
        draw = Draw(count, f"{kind} {count} {seed} {attempt}")
        try:
            first, goals, witness = getattr(draw, kind)()
        except LookupError:
            continue
        if any(first[k] == cells for k, cells in goals.items()):
            continue
        # The solution holds when it is followed again.
        objects = dict(first)
        for k, step in witness:
            others = [cells for other, cells in objects.items() if other != k]
            objects[k] = dict(draw.grid.pushes(objects[k], others))[step]
        assert all(objects[k] == cells for k, cells in goals.items())
        straight = sum(a != b for a, b in zip(witness, [None, *witness], strict=False))
        return draw.grid.text(first, goals), straight
    raise LookupError(f"no puzzle of the kind {kind} with {count} objects")


def converter():
    """Returns the module of `examples/pushworld.py`."""
    spec = importlib.util.spec_from_file_location("pushworld", ROOT / "examples/pushworld.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def solve(program, task, out, options):
    """Solves a task, and returns the record of the result."""
    command = [program, "solve", task, "--more-tools", task.parent / "tools", "--out", out]
    command += ["--threads", "1", "--effort", options.effort, "-q", "--json"]
    command += ["--time-limit", str(options.seconds)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    found = json.loads(done.stdout) if done.stdout else {"status": done.stderr.strip()[:100]}
    plan = out / f"{task.stem}.plan.json"
    steps = len(json.loads(plan.read_text())["plan"]["steps"]) if plan.exists() else 0
    status = found["status"]
    record = {"puzzle": task.stem, "status": status, "pushes": steps, "seconds": round(seconds, 2)}
    return record, plan if status == "solved" else None


def replayed(python, program, plans, out):
    """Returns the names of the plans that work in MuJoCo; scenes of earlier plans are removed."""
    shutil.rmtree(out, ignore_errors=True)
    command = [program, "export", *plans, "--out", out]
    subprocess.run(command, check=True, capture_output=True)
    done = subprocess.run([python, out / "replay.py", out], capture_output=True, text=True)
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return {line["plan"] for line in lines if line.get("reached")}


def version_of_mujoco(python):
    """Returns the version of MuJoCo of a Python."""
    command = [python, "-c", "import mujoco; print(mujoco.__version__)"]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    add = parser.add_argument
    add("puzzles", nargs="*", type=Path, help="puzzle files, or folders of them")
    add("--as-played", action="store_true", help="play with the agent, which stays down")
    add("--kind", choices=["goals", "swap", "heap"], help="generate puzzles of this kind")
    add("--objects", type=int, default=4, help="number of objects of generated puzzles")
    add("--count", type=int, default=20, help="number of generated puzzles")
    add("--seed", type=int, default=1, help="seed of generated puzzles")
    add("--solve", metavar="PROGRAM", help="the command pushplan; without it tasks are written")
    add("--effort", default="draft", help="effort of planning")
    add("--seconds", type=float, default=8, help="limit of time, one thread")
    add("--pushes", type=int, help="maximum number of pushes of a plan [default: 32, as played 64]")
    add("--mujoco", metavar="PYTHON", help="a Python with MuJoCo, which replays the plans")
    add("--out", type=Path, default=Path("runs/puzzles"), help="folder of tasks and plans")
    options = parser.parse_args()
    options.pushes = options.pushes or (64 if options.as_played else 32)
    pushworld = converter()
    texts = {}
    for given in options.puzzles:
        for path in sorted(given.glob("*.pwp")) if given.is_dir() else [given]:
            texts[re.sub(r"[^a-z0-9]+", "-", path.stem.lower())] = path.read_text()
    if options.kind:
        for seed in range(options.seed, options.seed + options.count):
            text, straight = generated(options.kind, options.objects, seed)
            texts[f"{options.kind}-{options.objects}-{seed}-of-{straight}"] = text
    (options.out / "tools").mkdir(parents=True, exist_ok=True)
    (options.out / "tools/plate.yaml").write_text(json.dumps(pushworld.PLATE.to_dict()))
    records, plans = [], []
    for name, text in texts.items():
        task = options.out / f"{name}.yaml"
        agent = pushworld.agent_of(text, name) if options.as_played else None
        if agent:
            tool = options.out / f"tools/{agent.name}.yaml"
            tool.write_text(json.dumps(agent.to_dict()))
        task.write_text(pushworld.task_of(text, name, options.pushes, agent).to_yaml())
        if options.solve:
            record, plan = solve(options.solve, task, options.out / "plans", options)
            plans += [plan] if plan else []
            records.append(record)
            print(json.dumps(record), flush=True)
    solved = sum(record["status"] == "solved" for record in records)
    form = options.kind and f"{options.kind}, {options.objects} objects"
    form = form or ", ".join(folder.name for folder in options.puzzles)
    line = f"{form}{', as played' if options.as_played else ''}, {options.seconds:g} s: "
    line += f"{solved} of {len(records)} solved"
    if options.mujoco and plans:
        works = replayed(options.mujoco, options.solve, plans, options.out / "mujoco")
        line += f", {len(works)} work in MuJoCo {version_of_mujoco(options.mujoco)}"
    print(line)


if __name__ == "__main__":
    sys.exit(main())
