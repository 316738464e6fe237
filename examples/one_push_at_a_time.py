"""A closed loop: look, plan, make the first push, look again.

Here the world is the planar engine with objects that rub more than anybody knows; a robot would be
in its place.

    python examples/one_push_at_a_time.py
"""

import numpy as np
import numpy.typing as npt

import pushplan

TASK = pushplan.Task.parse(
    """
    scene:
      objects:
        - {name: crate, shape: {cuboid: {size: [0.12, 0.08, 0.08]}}, mass: 0.8, friction: 0.4,
           position: [0.45, -0.15]}
    robot: {reach: {min: 0.1, max: 0.8}}
    tools: all
    pushes: {max_count: 2}
    goal: {object: crate, position: [0.60, 0.10], tolerance: 0.015, heading_deg: 90,
           heading_tolerance_deg: 10}
    """,
    name="crate",
)


def make(task: pushplan.Task, plan: pushplan.Plan) -> npt.NDArray[np.float64]:
    """What the first push of a plan really does: poses of the objects afterwards."""
    push = plan.pushes[0]
    first = pushplan.Plan.of(task, plan.tool, [push], grip_yaw=plan.grip_yaw)
    poses: npt.NDArray[np.float64] = pushplan.predict(first, "planar,friction=130%").poses[-1]
    return poses


def main() -> None:
    poses = TASK.start
    for count in range(6):
        score = TASK.score(poses)
        print(f"after {count} pushes: {score:.2f} of the tolerance")
        if score <= 1.0:
            return
        now = TASK.at(poses)
        plan = pushplan.solve(now, effort="draft").best
        assert plan is not None and plan.pushes, "no push brings it nearer"
        poses = make(now, plan)
    raise SystemExit("not there after six pushes")


if __name__ == "__main__":
    main()
