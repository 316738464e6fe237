"""Full loop in MuJoCo: a camera observes tags, and an arm pushes the tagged objects to their goals.

    pip install 'pushplan[camera]' 'mujoco>=3.3,<5'
    python examples/robot/run.py [--scenes 40] [--seed 1] [--film robot.webp]

The script observes AprilTags in a rendered image, plans from the observed poses (a Panda arm with a
tool), sends the joint trajectory to position servos, and observes again. It stops when the goal is
certainly reached, or when no plan remains. It prints a line of JSON per scene, with the claimed
result and the ground truth.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

import pushplan
from pushplan.poses import look

from world import EDGE, TABLE, Film, World, camera, tags_of

#: Joint positions during an observation, with the tool outside the image, rad.
HOME = [1.4, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
#: Maximum number of observations of a scene.
LOOKS = 5
#: Tolerance of the goal, metres, and smaller tolerance for planning, because camera and task have
#: errors.
TOLERANCE, PLANNED = 0.02, 0.012
#: Standard deviations of the camera by which an object must be inside the tolerance.
SURE = 3.0


def drawn(rng: np.random.Generator, urdf: Path) -> pushplan.Task:
    """Draws a task for a can or a box, sometimes with a second object or a wall."""

    def thing(name: str, at: Any) -> dict[str, Any]:
        if rng.random() < 0.5:
            shape: Any = {
                "cylinder": {"radius": rng.uniform(0.036, 0.05), "height": rng.uniform(0.06, 0.10)}
            }
        else:
            shape = {"cuboid": {"size": [*rng.uniform(0.075, 0.13, 2), rng.uniform(0.05, 0.08)]}}
        return {
            "name": name,
            "shape": shape,
            "mass": rng.uniform(0.2, 0.8),
            "friction": rng.uniform(0.3, 0.5),
            "position": at,
            "yaw_deg": rng.uniform(-180, 180),
        }

    while True:
        out, turn = rng.uniform(0.42, 0.60), rng.uniform(-0.6, 0.6)
        start = np.array([out * math.cos(turn), out * math.sin(turn)])
        way, length = rng.uniform(-math.pi, math.pi), rng.uniform(0.08, 0.18)
        goal = start + length * np.array([math.cos(way), math.sin(way)])
        if not 0.36 < np.linalg.norm(goal) < 0.66 or abs(math.atan2(goal[1], goal[0])) > 0.7:
            continue
        scene: Any = {"objects": [thing("goods", start.tolist())]}
        aside = start + rng.uniform(0.16, 0.25) * np.array(
            [math.cos(way + 1.8), math.sin(way + 1.8)]
        )
        if rng.random() < 0.4:
            scene["objects"].append(thing("other", aside.tolist()))
        elif rng.random() < 0.4:
            scene["obstacles"] = [
                {
                    "name": "wall",
                    "size": [0.03, 0.12, 0.08],
                    "position": aside.tolist(),
                    "yaw_deg": math.degrees(way),
                }
            ]
        task: Any = {
            "name": "goods",
            "scene": scene,
            "tools": "all",
            "pushes": {"max_count": 2, "directions": 16},
            "robot": {
                "urdf": str(urdf),
                "flange": "panda_link8",
                "tool_mount": {"length": 0.12},
                "home": HOME,
            },
            "goal": {"object": "goods", "position": goal.tolist(), "tolerance": PLANNED},
        }
        try:
            return pushplan.Task.from_dict(task)
        except pushplan.TaskError:
            continue  # objects overlap


def attempt(task: pushplan.Task, world: World) -> dict[str, Any]:
    """Pushes the object to the goal according to the camera; returns the claimed result."""
    tags = tags_of(task)
    eye = camera().placed(world.photo(), TABLE, EDGE)
    plans = 0
    for _ in range(LOOKS):
        seen = look(task, world.photo(), eye, tags)
        if seen.missing:
            return {"claims": f"no observation of {', '.join(seen.missing)}", "plans": plans}
        task = task.at(seen.poses)
        error = task.score(seen.poses) * PLANNED
        if error + SURE * seen.noise[0] <= TOLERANCE:
            return {"claims": "reached", "plans": plans, "seen_mm": 1e3 * error}
        best = pushplan.solve(task, effort="standard")
        if not best.solved or best.best is None:
            return {"claims": best.status, "plans": plans, "seen_mm": 1e3 * error}
        world.carry_out(best.best)
        plans += 1
    return {"claims": "maximum number of observations reached", "plans": plans}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--scenes", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--film", type=Path, help="file for an animation of the first scene (WebP)")
    parser.add_argument(
        "--urdf",
        type=Path,
        default=Path(__file__).with_name("panda.urdf"),
        help="URDF file of another Panda arm",
    )
    options = parser.parse_args()
    reached = false = 0
    for k in range(options.scenes):
        rng = np.random.default_rng([options.seed, k])
        task = drawn(rng, options.urdf.resolve())
        world = World(task, int(rng.integers(2**32)))
        film = Film() if k == 0 and options.film else None
        world.watch = film.watch if film else None
        outcome = attempt(task, world)
        if film:
            film.save(str(options.film))
        off = float(np.linalg.norm(world.poses[0, :2] - task.goal_position))
        true = bool(off <= TOLERANCE and np.isfinite(world.poses).all())
        reached += outcome["claims"] == "reached" and true
        false += outcome["claims"] == "reached" and not true
        print(json.dumps({"scene": k, **outcome, "truly_mm": 1e3 * off, "true": true}), flush=True)
    print(json.dumps({"scenes": options.scenes, "reached": reached, "falsely_reached": false}))


if __name__ == "__main__":
    main()
