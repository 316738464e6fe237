"""Planner of this package as a program of the board."""

from __future__ import annotations

import json
import sys
import time
from typing import Any, Literal

from .. import PushplanError, Solution, Task, Tool, ToolLibrary, design, solve

__all__ = ["answered", "play"]


def answered(
    request: dict[str, Any], effort: Literal["draft", "standard", "thorough"]
) -> dict[str, Any]:
    """Returns the answer to a request."""
    began = time.process_time()
    found: dict[str, Any] = {"id": request["id"], "status": "unknown"}
    limit = request["budget"].get("seconds")
    try:
        task = Task.from_dict(request["task"])
        tools = ToolLibrary.of([Tool.from_dict(tool) for tool in request["tools"]])
        solution: Solution | None
        if request.get("new_tools"):
            proposal = design(task, tools, effort=effort, time_limit=limit, threads=1)
            solution = proposal.solution or proposal.known
        else:
            solution = solve(task, tools, effort=effort, time_limit=limit, threads=1)
    except PushplanError as error:
        return found | {"note": f"{type(error).__name__}: {error}"}
    if solution.solved and solution.best is not None:
        plan = solution.best.to_dict()
        found |= {"status": "solved", "plan": {key: plan[key] for key in ("plan", "tools")}}
    else:
        found["note"] = solution.cause or solution.status
    rollouts = solution.to_dict().get("statistics", {}).get("rollouts", 0)
    cost = {"processor_s": round(time.process_time() - began, 3), "rollouts": rollouts}
    return found | {"cost": cost}


def play(effort: Literal["draft", "standard", "thorough"]) -> None:
    """Answers the requests of the standard input until it ends."""
    for line in sys.stdin:
        print(json.dumps(answered(json.loads(line), effort)), flush=True)
