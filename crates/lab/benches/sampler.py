#!/usr/bin/env python3
"""Compares `pushplan solve` with a lean sampling search in MuJoCo: cost, and errors of both plans.

    crates/lab/benches/sampler.py [--rounds 3] [--seed 1]

Needs the package of this checkout (`pip install .`), the package `mujoco`, and the command in
target/release or in PUSHPLAN. Takes about three minutes.
"""

import argparse
import copy
import math
import statistics
import tempfile
import time

import mujoco
import numpy as np
import pushplan
from mujoco import rollout
from python import COMMAND, ROOT, processor, theirs

EPILOG = """
The sampler has the same tools, grips, directions and lengths of pushes as `solve`. Its candidates
are aligned to faces: 9 lateral offsets of every allowed direction, tool and grip, at most 500,
those towards the goal first; then 96 near the best eight. One rollout tries all lengths of a
candidate. It ends early where the remaining travel cannot bring the object to its goal, or where
the object leaves it again. All rollouts are batches of `mujoco.rollout` with a step of 4 ms, the
usual contacts and one thread; the scene is reduced to the shapes that touch. Few steps pass
without contact, because pushes start a few millimetres from the object.

A plan is found if the object rests at the goal, and in all 8 perturbed rollouts too (starts by a
millimetre and a degree, frictions by 10 %). `first` is the time until then; `all` is the time of
all candidates. Both are processor times and leave out models and placement of pushes, which
`pushplan` does for the sampler. The time of `solve` is the whole command: reading, search,
verification in two engines, and the page. Rounds alternate between the three, and factors are
medians over the rounds. Finally both plans are judged in the exported scene at 0.25 ms, except
for plans of several pushes. Prints Markdown.
"""

TASKS = ["pull-back", "narrow-gap", "wide-sweep", "diagonal", "turn-the-box"]
FIRST, AROUND, NEXT, GROUP = 500, 8, 96, 24
STEP, EXACT = 4e-3, 2.5e-4
# Steps of one call, 2 cm of a push, and steps to rest, four times the longest glide.
CALL, REST = 50, 30
OFFSETS = [0.0, 0.015, -0.015, 0.03, -0.03, 0.045, -0.045, 0.06, -0.06]
DRAWS = 8
STATE = mujoco.mjtState.mjSTATE_FULLPHYSICS


class Clock:
    """Processor time inside `with` blocks, seconds."""

    def __init__(self):
        self.spent = 0.0

    def __enter__(self):
        self.began = time.process_time()

    def __exit__(self, *_):
        self.spent += time.process_time() - self.began


class Scene:
    """Scene with one grip of a tool, in MuJoCo."""

    def __init__(self, task, plan):
        self.task = task
        spec = mujoco.MjSpec.from_string(plan.to_mjcf())
        # The export's feet model the friction of a whole base; MuJoCo's own contacts are cheaper.
        frictions, standing = {}, set()
        for pair in list(spec.pairs):
            name, _, foot = pair.geomname1.partition("/foot-")
            if foot:
                frictions[name] = pair.friction.copy()
                spec.delete(pair)
            elif pair.geomname2 == "table":
                standing.add(name)
        for name in set(frictions) - standing:
            spec.add_pair(geomname1=name, geomname2="table", condim=3, friction=frictions[name])
        for geom in list(spec.geoms):
            if "/foot-" in geom.name:
                spec.delete(geom)
        spec.delete(spec.joint("tool z"))
        spec.option.timestep, spec.option.impratio = STEP, 1.0
        spec.option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
        self.model = model = spec.compile()
        model.pair_solref[:] = [0.02, 1.0]
        model.pair_solimp[:] = [0.9, 0.95, 0.001, 0.5, 2.0]
        model.pair_solreffriction[:] = 0.0
        self.data = mujoco.MjData(model)
        self.start = np.empty(mujoco.mj_stateSize(model, STATE))
        mujoco.mj_forward(model, self.data)
        mujoco.mj_getState(model, self.data, self.start, STATE)
        joints = [model.joint("tool x"), model.joint("tool y")]
        self.places = [1 + joint.qposadr[0] for joint in joints]
        self.speeds = [1 + model.nq + joint.dofadr[0] for joint in joints]
        self.shift = model.numeric("push 1").data[:2] - np.array(plan.pushes[0].start)
        joint = model.body(f"object/{task.goal_object}").jntadr[0]
        self.goal = 1 + model.jnt_qposadr[joint]
        free = model.jnt_type == mujoco.mjtJoint.mjJNT_FREE
        self.objects = [1 + place for place in model.jnt_qposadr[free]]
        self.perturbed = None
        tool = np.flatnonzero(model.geom_bodyid == model.body("tool").id)
        corners = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])
        turned = self.data.geom_xmat[tool].reshape(-1, 3, 3)[:, :2, :2]
        self.corners = model.geom_pos[tool, None, :2] + np.einsum(
            "gij,gkj->gki", turned, corners * model.geom_size[tool, None, :2]
        )

    def outline(self, push):
        """Returns a key of the tool's corners at the start of a push, the same for grips that turn
        a tool into itself."""
        corners = (self.corners + push[:2] + self.shift).reshape(-1, 2).round(4) + 0.0
        return tuple(sorted(map(tuple, corners)))

    def begin(self, pushes):
        """Returns the states in which pushes begin."""
        states = np.tile(self.start, (len(pushes), 1))
        states[:, self.places] = pushes[:, :2] + self.shift
        way = np.stack([np.cos(pushes[:, 2]), np.sin(pushes[:, 2])], axis=1)
        states[:, self.speeds] = pushes[:, 4, None] * way
        return states

    def missed(self, states):
        """Returns the errors in tolerances and the distances from the goal, metres."""
        place = states[..., self.goal : self.goal + 2] - self.task.goal_position
        away = np.hypot(place[..., 0], place[..., 1])
        score = away / self.task.tolerance
        if self.task.goal_heading is not None:
            turned = 2.0 * np.arctan2(states[..., self.goal + 6], states[..., self.goal + 3])
            turned = np.abs(np.remainder(turned - self.task.goal_heading + np.pi, math.tau) - np.pi)
            score = np.maximum(score, turned / self.task.heading_tolerance)
        return score, away

    def swept(self, pushes):
        """Returns the best stop of each push: steps, and the error in tolerances at rest."""
        now, alive = self.begin(pushes), np.arange(len(pushes))
        whole = np.floor(pushes[:, 3] / pushes[:, 4] / STEP).astype(int)
        best, stops, kept = np.full(len(pushes), np.inf), np.ones(len(pushes), int), now.copy()
        done = 0
        while alive.size:
            moved, _ = rollout.rollout(self.model, self.data, now[alive], nstep=CALL)
            score, away = self.missed(moved)
            beyond = done + 1 + np.arange(CALL) > whole[alive, None]
            score[beyond] = np.inf
            nearest = score.argmin(axis=1)
            found = score[np.arange(len(alive)), nearest]
            better = np.flatnonzero(found < best[alive])
            best[alive[better]] = found[better]
            stops[alive[better]] = done + 1 + nearest[better]
            kept[alive[better]] = moved[better, nearest[better]]
            now[alive] = moved[:, -1]
            done += CALL
            left = pushes[alive, 3] - pushes[alive, 4] * done * STEP
            hopeless = (left <= 0.0) | (away[:, -1] - left > self.task.tolerance)
            alive = alive[~hopeless & (score[:, -1] < best[alive] + 2.0)]
        # A stop that misses by far needs no rollout to rest.
        near = np.flatnonzero(best < 2.0)
        if near.size:
            best[near] = self.rested(self.model, kept[near])
        return stops, best

    def rested(self, models, states):
        """Returns the errors in tolerances after the tool has stopped."""
        states = states.copy()
        states[:, self.speeds] = 0.0
        moved, _ = rollout.rollout(models, self.data, states, nstep=REST)
        return self.missed(moved[:, -1])[0]

    def perturb(self, rng):
        """Makes the models with perturbed frictions."""
        if self.perturbed is None:
            self.perturbed = []
            for _ in range(DRAWS):
                model = copy.copy(self.model)
                model.pair_friction *= rng.uniform(0.9, 1.1, (model.npair, 1))
                self.perturbed.append(model)

    def steady(self, push, steps, rng):
        """Returns `True` if all perturbed rollouts reach the goal."""
        states = self.begin(np.tile(push, (DRAWS, 1)))
        for place in self.objects:
            states[:, place : place + 2] += rng.uniform(-1e-3, 1e-3, (DRAWS, 2))
            half = np.radians(rng.uniform(-1.0, 1.0, DRAWS)) / 2.0
            half += np.arctan2(states[:, place + 6], states[:, place + 3])
            states[:, place + 3], states[:, place + 6] = np.cos(half), np.sin(half)
        moved, _ = rollout.rollout(self.perturbed, self.data, states, nstep=int(steps))
        return np.all(self.rested(self.perturbed, moved[:, -1]) <= 1.0)


class Sampler:
    """Search for a push in MuJoCo."""

    def __init__(self, task, seed):
        self.task, self.rng, self.scenes = task, np.random.default_rng(seed), {}
        self.clock, self.rollouts, self.seen, self.plan = Clock(), 0, set(), None

    def aligned(self):
        """Returns all candidates that are aligned to faces, promising ones first."""
        task = self.task
        tools = task.tools or list(pushplan.ToolLibrary.shipped().names)
        wanted = task.to_dict().get("pushes", {}).get("directions", "principal")
        count = 4 if wanted == "principal" else wanted
        even = isinstance(count, int)
        ways = [math.tau * k / count for k in range(count)] if even else np.radians(wanted)
        start = task.start[task.objects.index(task.goal_object)]
        goal = math.atan2(task.goal_position[1] - start[1], task.goal_position[0] - start[0])
        found = [
            (tool, float(yaw), float(way), offset)
            for tool in tools
            for yaw in task.grip_yaws
            for way in ways
            for offset in OFFSETS
        ]
        found.sort(key=lambda one: (abs(math.remainder(one[2] - goal, math.tau)), abs(one[3])))
        return found

    def placed(self, words):
        """Returns the longest feasible push of a candidate; `None` if there is none, or if another
        candidate is the same push."""
        tool, yaw, way, offset = words
        for share in (1.0, 0.75, 0.5, 0.25):
            length = share * self.task.push_length
            push = pushplan.Push.before(self.task.goal_object, way, offset, length)
            try:
                plan = pushplan.Plan.of(self.task, tool, [push], grip_yaw=yaw)
            except pushplan.PushplanError:
                continue
            if plan.violations:
                continue
            if (tool, yaw) not in self.scenes:
                self.scenes[tool, yaw] = Scene(self.task, plan)
            [push] = plan.pushes
            key = round(way, 6), self.scenes[tool, yaw].outline(push.start)
            if key in self.seen:
                return None
            self.seen.add(key)
            return [*push.start, push.direction, push.length, push.speed]
        return None

    def tried(self, candidates, most, first):
        """Rolls out candidates; returns their words and best stops, in order of the errors."""
        results = []
        for group in range(0, len(candidates), GROUP):
            grips = {}
            for words in candidates[group : group + GROUP]:
                push = self.placed(words)
                if push is not None and self.rollouts < most:
                    grips.setdefault(words[:2], []).append((words, push))
                    self.rollouts += 1
            own = []
            for grip, some in grips.items():
                pushes = np.array([push for _, push in some])
                with self.clock:
                    stops, best = self.scenes[grip].swept(pushes)
                own += zip(best, [words for words, _ in some], pushes, stops)
            own.sort(key=lambda one: one[0])
            results += own
            if first and self.settled(own):
                break
        return sorted(results, key=lambda one: one[0])

    def settled(self, results):
        """Keeps the first robust plan of some results; returns `True` if there is one."""
        for best, words, push, stop in results[:AROUND]:
            if self.plan is None and best <= 1.0:
                scene = self.scenes[words[:2]]
                scene.perturb(self.rng)
                with self.clock:
                    steady = scene.steady(push, stop, self.rng)
                if steady:
                    self.plan = words, push, stop
        return self.plan is not None

    def near(self, words):
        tool, yaw, way, offset = words
        return tool, yaw, way + self.rng.normal(0, 0.05), offset + self.rng.normal(0, 0.01)

    def search(self, first):
        """Searches until the `first` plan, or through all candidates; `results` are in order of
        the errors."""
        self.results = results = self.tried(self.aligned(), FIRST, first)
        if not (first and self.plan):
            best = [words for _, words, _, _ in results[:AROUND]]
            around = [self.near(words) for words in best for _ in range(NEXT // AROUND)]
            results += self.tried(around, self.rollouts + NEXT, first)
            self.results = sorted(results, key=lambda one: one[0])
            self.settled(self.results)
        return self


def exact(task, grip, push):
    """Returns the errors of a push in the exported scene, metres and radians, as text."""
    start, way, length, speed = push[:2], *map(float, push[2:])
    made = pushplan.Push([float(one) for one in start], way, length, speed)
    plan = pushplan.Plan.of(task, grip[0], [made], grip_yaw=grip[1])
    end = theirs(plan, np.array([push]), step=EXACT)[0]
    text = f"{1e3 * math.dist(end[:2], task.goal_position):.1f} mm"
    if task.goal_heading is not None:
        turned = abs(math.remainder(end[2] - task.goal_heading, math.tau))
        text += f", {math.degrees(turned):.1f} degrees"
    return text


def compared(name, rounds, seed):
    """Returns the cells of a task, and the ratios of `first` and `all`."""
    path = ROOT / f"tasks/{name}.yaml"
    task = pushplan.Task.load(path)
    times = []
    for k in range(rounds):
        first = Sampler(task, seed + k).search(True)
        every = Sampler(task, seed + k).search(False)
        with tempfile.TemporaryDirectory() as out:
            words = [COMMAND, "solve", str(path), "--threads", "1", "--quiet", "--out", out]
            times.append((processor(words), first.clock.spent, every.clock.spent))
            plan = pushplan.Plan.load(f"{out}/{name}.plan.json")
    ratios = [statistics.median(time[k] / time[0] for time in times) for k in (1, 2)]
    own, one, all_ = (statistics.median(column) for column in zip(*times))
    [push] = plan.pushes[:1]
    ours = [*push.start, push.direction, push.length, push.speed]
    there = exact(task, (plan.tool.name, plan.grip_yaw), ours) if len(plan.pushes) == 1 else ""
    theirs_there = "no plan"
    if first.plan:
        (tool, yaw, *_), push, stop = first.plan
        push = [*push[:3], stop * STEP * push[4], push[4]]
        theirs_there = exact(task, (tool, yaw), push)
    cells = [
        f"{own:.3f} s",
        f"{first.rollouts}",
        f"{one:.2f} s",
        f"{ratios[0]:.1f}",
        f"{every.rollouts}",
        f"{all_:.2f} s",
        f"{ratios[1]:.1f}",
        theirs_there,
        there,
    ]
    return cells, ratios


def main():
    parser = argparse.ArgumentParser(
        description="\n".join(__doc__.splitlines()),
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--rounds", type=int, default=3, help="runs of each, in turn [default: 3]")
    parser.add_argument("--seed", type=int, default=1, help="seed of the sampler [default: 1]")
    arguments = parser.parse_args()
    if arguments.rounds < 1:
        parser.error("--rounds must be at least 1")
    print(
        "| task | solve | rollouts, first | first | factor | rollouts, all | all | factor "
        "| error of first | error of solve |"
    )
    print("| --- " + "| --: " * 9 + "|")
    ratios = []
    for name in TASKS:
        cells, own = compared(name, arguments.rounds, arguments.seed)
        ratios.append(own)
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    first, every = (statistics.median(column) for column in zip(*ratios))
    print(f"\nMedian factor {first:.1f} to the first plan, {every:.1f} for all candidates.")


if __name__ == "__main__":
    main()
