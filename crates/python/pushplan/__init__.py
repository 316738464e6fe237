"""Planner of tool use: chooses a tool and pushes that bring objects to goals, and verifies plans.

    import pushplan

    task = pushplan.Task.example("pull-back-behind-wall")
    solution = pushplan.solve(task)
    print(solution.status, solution.best)

Lengths are metres, angles radians, masses kilograms and times seconds. Keys of files and mappings
that end in ``_deg`` are degrees. The table is the plane z = 0, and x points forward from the
robot's base at the origin. Results do not depend on the number of threads.
"""

from typing import TYPE_CHECKING, Any

from ._native import (
    Belief,
    Design,
    Motion,
    Plan,
    Push,
    Recording,
    Replay,
    Rollouts,
    Run,
    Solution,
    TableFit,
    Task,
    Tool,
    ToolLibrary,
    Trajectory,
    Verdict,
    __version__,
    allow_files_in,
    design,
    export_mcap,
    export_mjcf,
    fit,
    import_task,
    import_tool,
    infer,
    predict,
    recording_schema,
    rollout,
    run,
    solve,
    solve_all,
    task_schema,
    tool_schema,
    verify,
)
from .errors import (
    ActionError,
    Fault,
    FileError,
    ModelError,
    PushplanError,
    RefusedError,
    TaskError,
    UnknownToolError,
)
from .progress import Progress

if TYPE_CHECKING:
    from .loaded import scene_from

# Type checkers would accept every name of a module with this function.
if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """Imports `scene_from` on first use: NumPy takes three times as long as the rest."""
        if name == "scene_from":
            from .loaded import scene_from

            return scene_from
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__() -> list[str]:
        """Returns the names of the module, with `scene_from`."""
        return sorted({*globals(), "scene_from"})


__all__ = [
    "ActionError",
    "Belief",
    "Design",
    "Fault",
    "FileError",
    "ModelError",
    "Motion",
    "Plan",
    "Progress",
    "Push",
    "PushplanError",
    "Recording",
    "RefusedError",
    "Replay",
    "Rollouts",
    "Run",
    "Solution",
    "TableFit",
    "Task",
    "TaskError",
    "Tool",
    "ToolLibrary",
    "Trajectory",
    "UnknownToolError",
    "Verdict",
    "__version__",
    "allow_files_in",
    "design",
    "export_mcap",
    "export_mjcf",
    "fit",
    "import_task",
    "import_tool",
    "infer",
    "predict",
    "recording_schema",
    "rollout",
    "run",
    "scene_from",
    "solve",
    "solve_all",
    "task_schema",
    "tool_schema",
    "verify",
]
