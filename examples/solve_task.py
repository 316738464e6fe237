"""Builds a task and a tool in code, chooses a tool and pushes, and keeps plan and page.

    python examples/solve_task.py [FOLDER]
"""

import sys
from pathlib import Path

import pushplan
from pushplan.files import TaskFile, ToolFile

# Metres, kilograms, degrees: the keys of task and tool files.
TASK: TaskFile = {
    "name": "can-behind-box",
    "scene": {
        "objects": [
            {
                "name": "can",
                "shape": {"cylinder": {"radius": 0.05, "height": 0.10}},
                "mass": 0.4,
                "friction": 0.4,
                "position": [0.62, 0.10],
            }
        ],
        "obstacles": [{"name": "box", "size": [0.03, 0.10, 0.12], "position": [0.36, 0.20]}],
    },
    "robot": {"reach": {"min": 0.1, "max": 0.7}},
    "tools": "all",
    "goal": {"object": "can", "position": [0.45, 0.10], "tolerance": 0.02},
}

HOOK: ToolFile = {
    "name": "long-hook",
    "friction": 0.4,
    "parts": [
        {"name": "handle", "size": [0.42, 0.04, 0.05], "position": [0.26, 0]},
        {"name": "bar", "size": [0.16, 0.04, 0.05], "position": [0.43, 0.08], "yaw_deg": 90},
    ],
}


def main(folder: Path) -> None:
    task = pushplan.Task.of(TASK)
    tools = pushplan.ToolLibrary.shipped().with_tool(pushplan.Tool.of(HOOK))
    solution = pushplan.solve(task, tools)
    print(solution)
    best = solution.best
    assert solution.solved and best is not None
    verdict = pushplan.verify(best, disturbed=32)
    print(f"{verdict.robustness:.0%} of disturbed replays reach the goal")
    folder.mkdir(exist_ok=True)
    best.save(folder / f"{task.name}.plan.json")
    (folder / f"{task.name}.html").write_text(solution.page(), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "plans"))
