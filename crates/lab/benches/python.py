#!/usr/bin/env python3
"""Measures the cost of the Python package: solving compared with the command, and rollouts compared
with MuJoCo.

    crates/lab/benches/python.py solve       # target: at most 1.05 times the time of the command
    crates/lab/benches/python.py rollout     # target: at most a 20th of MuJoCo's processor time

Needs the package of this checkout (`pip install .`), the package `mujoco` for `rollout`
(`pip install mujoco`), and the command in target/release or in PUSHPLAN. All times are on one
thread. Runs alternate, and the median is printed, so that other load on a shared machine affects
both equally. Prints Markdown.
"""

import argparse
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pushplan

ROOT = Path(__file__).resolve().parents[3]
COMMAND = os.environ.get("PUSHPLAN", str(ROOT / "target/release/pushplan"))
# Tasks of one push and of two, with and without obstacles, alone and in a crowd.
TASKS = [
    "pull-back",
    "pull-back-behind-wall",
    "pull-back-twice",
    "diagonal",
    "hinged-train",
    "crowd",
]

#: The work of the command, from Python: the plan and the report as files.
SCRIPT = """
import sys, pushplan
solution = pushplan.solve(pushplan.Task.load(sys.argv[1]), threads=1)
solution.best.save(sys.argv[2] + "/plan.json")
open(sys.argv[2] + "/page.html", "w").write(solution.page())
"""

#: Settings of MuJoCo: as in most scenes, and as the export needs for Coulomb friction.
USUAL, EXACT = "MuJoCo, usual contacts, 2 ms", "MuJoCo, as exported, 0.25 ms"


def children():
    """Returns the processor time of all finished child processes, seconds."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def processor(words):
    """Runs a process and returns its processor time, seconds."""
    began = children()
    subprocess.run(words, capture_output=True, check=True)
    return children() - began


def solve(rounds):
    rows = []
    for name in TASKS:
        path = str(ROOT / f"tasks/{name}.yaml")
        times = {"command": [], "running": [], "process": []}
        for _ in range(rounds):
            with tempfile.TemporaryDirectory() as out:
                words = [COMMAND, "solve", path, "--threads", "1", "--quiet", "--out", out]
                times["command"].append(processor(words))
                sys.argv[1:] = [path, out]
                began = time.process_time()
                exec(SCRIPT, {})
                times["running"].append(time.process_time() - began)
                times["process"].append(processor([sys.executable, "-c", SCRIPT, path, out]))
        rows.append([name, *(statistics.median(found) for found in times.values())])
    rows.append(["all", *(sum(column) for column in list(zip(*rows))[1:])])
    print(
        "\nProcessor time of one thread, from the task file to plan and page as files; median of "
        f"{rounds} runs.\n"
    )
    print("| task | command | in a running Python | ratio | with the start of Python | ratio |")
    print("| --- | --: | --: | --: | --: | --: |")
    for name, command, running, process in rows:
        numbers = [running, running / command, process, process / command]
        each = [f"{1e3 * command:.0f} ms"]
        each += [f"{1e3 * n:.0f} ms" if k % 2 == 0 else f"{n:.2f}" for k, n in enumerate(numbers)]
        print(f"| {name} | " + " | ".join(each) + " |")


def candidates(plan, count):
    """Returns pushes around the push of a plan, all of which touch the object."""
    rng = np.random.default_rng(7)
    [push] = plan.pushes
    pushes = np.tile([*push.start, push.direction, push.length, push.speed], (count, 1))
    pushes[:, 1] += rng.uniform(-0.02, 0.02, count)
    pushes[:, 2] += rng.uniform(-0.1, 0.1, count)
    pushes[:, 3] = rng.uniform(0.10, 0.20, count)
    return pushes


def rollout(rounds, count):
    import mujoco

    rows = []
    for name in ["pull-back", "diagonal"]:
        plan = pushplan.solve(pushplan.Task.load(ROOT / f"tasks/{name}.yaml")).best
        pushes = candidates(plan, count)
        ways = {
            f"pushplan, {model}": lambda model=model: ours(plan, pushes, model)
            for model in ["prior", "network", "planar", "3d"]
        }
        ways[USUAL] = lambda: theirs(plan, pushes, 2e-3, usual=True)[:, :2]
        times, ends = {way: [] for way in ways}, {}
        for _ in range(rounds):
            for way, roll in ways.items():
                began = time.process_time()
                ends[way] = roll()
                times[way].append(time.process_time() - began)
        each = {way: statistics.median(found) / count for way, found in times.items()}
        # A tenth of the pushes, because these rollouts are expensive.
        few = max(1, count // 10)
        began = time.process_time()
        exact = theirs(plan, pushes[:few], 2.5e-4)[:, :2]
        each[EXACT] = (time.process_time() - began) / few
        for way, seconds in each.items():
            away = ""
            if way in ends:
                apart = np.linalg.norm(ends[way][:few] - exact, axis=1)
                away = f"{1e3 * np.median(apart):.2f} mm"
            cheaper = [f"{each[mujoco] / seconds:.1f}" for mujoco in (USUAL, EXACT)]
            rows.append([name, way, f"{1e3 * seconds:.3f} ms", *cheaper, away])
    print(
        f"\nProcessor time of one thread per push, with frames in an array; {count} pushes, median "
        "of"
    )
    print(f"{rounds} runs. MuJoCo {mujoco.__version__} runs `rollout` in the exported scene.\n")
    print(
        "| task | model | per push | factor to usual MuJoCo | factor to exact MuJoCo "
        "| distance to exact MuJoCo, median |"
    )
    print("| --- | --- | --: | --: | --: | --: |")
    for row in rows:
        print("| " + " | ".join(row) + " |")


def ours(plan, pushes, model):
    """Returns the final positions of the goal's object."""
    rolled = pushplan.rollout(
        plan.task, plan.tool, pushes, grip_yaw=plan.grip_yaw, model=model, threads=1
    )
    return rolled.poses[:, -1, plan.task.objects.index(plan.task.goal_object), :2]


def theirs(plan, pushes, step, usual=False):
    """Returns final positions and headings by `mujoco.rollout`, in the scene that `pushplan export`
    writes: with its contacts, or with MuJoCo's usual ones, which are softer, let objects creep, and
    allow larger steps.

    The tool is a heavy, weightless body on free sliding joints. Its initial velocity is the speed
    of the push. Afterwards it stands still until the object rests, for twice the maximum time v /
    (mu g).
    """
    import mujoco
    from mujoco import rollout

    scene = mujoco.MjSpec.from_string(plan.to_mjcf())
    scene.body("tool").gravcomp = 1.0
    model = scene.compile()
    model.opt.timestep = step
    if usual:
        model.opt.impratio = 1.0
        model.pair_solref[:] = [0.02, 1.0]
        model.pair_solimp[:] = [0.9, 0.95, 0.001, 0.5, 2.0]
        model.pair_solreffriction[:] = 0.0
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    size = mujoco.mj_stateSize(model, kind)
    start = np.empty(size)
    mujoco.mj_getState(model, data, start, kind)
    joints = [model.joint("tool x"), model.joint("tool y")]
    places = [1 + joint.qposadr[0] for joint in joints]
    speeds = [1 + model.nq + joint.dofadr[0] for joint in joints]
    # Position of the tool frame relative to the end effector; constant, like the grip.
    shift = model.numeric("push 1").data[:2] - np.array(plan.pushes[0].start)
    joint = model.body(f"object/{plan.task.goal_object}").jntadr[0]
    goal = 1 + model.jnt_qposadr[joint]
    ends = np.empty((len(pushes), 3))
    coast = round(2.0 * pushes[:, 4].max() / (0.4 * 9.81) / step) + 1
    # Batches of similar lengths, so that few steps are wasted, as large as memory allows.
    for some in np.array_split(np.argsort(pushes[:, 3]), max(1, len(pushes) // 25)):
        x, y, direction, length, speed = pushes[some].T
        states = np.tile(start, (len(some), 1))
        states[:, places] = np.stack([x, y], axis=1) + shift
        states[:, speeds] = (speed * np.stack([np.cos(direction), np.sin(direction)])).T
        steps = np.ceil(length / speed / step).astype(int)
        moved, _ = rollout.rollout(model, data, states, nstep=int(steps.max()))
        states = moved[np.arange(len(some)), steps - 1]
        states[:, speeds] = 0.0
        rested, _ = rollout.rollout(model, data, states, nstep=coast)
        ends[some, :2] = rested[:, -1, goal : goal + 2]
        w, z = rested[:, -1, goal + 3], rested[:, -1, goal + 6]
        ends[some, 2] = 2.0 * np.arctan2(z, w)
    return ends


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["solve", "rollout"])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--count", type=int, default=1000, help="pushes to roll out")
    arguments = parser.parse_args()
    if arguments.what == "solve":
        solve(arguments.rounds)
    else:
        rollout(arguments.rounds, arguments.count)


if __name__ == "__main__":
    main()
