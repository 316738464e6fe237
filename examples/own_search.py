"""Custom search: rolls out thousands of candidate pushes into arrays and verifies the best one.

The cross-entropy method for one push: sample candidates, keep the best, sample again around them.

    python examples/own_search.py
"""

import numpy as np

import pushplan

TASK = pushplan.Task.parse(
    """
    scene:
      objects:
        - {name: box, shape: {cuboid: {size: [0.10, 0.06, 0.08]}}, mass: 0.5, friction: 0.4,
           position: [0.50, 0.00], yaw_deg: 20}
    robot: {reach: {min: 0.1, max: 0.8}}
    tools: [paddle]
    pushes: {directions: 16, length: 0.35}
    goal: {object: box, position: [0.62, 0.06], tolerance: 0.02}
    """,
    name="to-the-left",
)

ROUNDS, CANDIDATES, KEPT = 6, 500, 40


def main() -> None:
    rng = np.random.default_rng(0)
    # x, y (m), direction (rad), length (m) and speed (m/s) of a push of the end effector.
    middle = np.array([0.10, 0.00, 0.4, 0.15, 0.10])
    spread = np.array([0.05, 0.05, 0.4, 0.05, 0.00])
    best = middle[None]
    for _ in range(ROUNDS):
        pushes = rng.normal(middle, spread, (CANDIDATES, 5))
        pushes[:, 3] = np.clip(pushes[:, 3], 0.01, 0.5)
        rolled = pushplan.rollout(TASK, "paddle", pushes, record="outcome")
        # A tool that is set down on the box has a small error because it moves nothing.
        broken = np.array([len(warnings) > 0 for warnings in rolled.warnings])
        best = pushes[np.argsort(rolled.errors + broken)[:KEPT]]
        middle, spread = best.mean(axis=0), best.std(axis=0)
        print(f"best error {1e3 * rolled.errors.min():6.2f} mm, mean of the best {middle.round(3)}")
    x, y, direction, length, speed = best[0]
    push = pushplan.Push([x, y], direction, length, speed)
    plan = pushplan.Plan.of(TASK, "paddle", [push], grip_yaw=0.0)
    verdict = pushplan.verify(plan, replays=8)
    print(verdict)
    assert verdict.nominal_ok


if __name__ == "__main__":
    main()
