"""Judge of submitted plans: the rules of the task, then a replay in MuJoCo.

Only the steps and the new tools of a submission count. The board supplies the task and all other
tools.
"""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Sequence
from typing import Any, cast

from .. import Plan, PushplanError, Task, Tool, ToolLibrary, verify
from ..files import TaskFile, ToolFile
from .draw import Draw
from .replay import replayed, require_mujoco
from .sketch import Ends

__all__ = ["NEW_TOOL", "WORLDS", "broken_rule", "judged", "plan_of", "worlds"]

#: Number of hidden worlds in which a plan for unknown physics must work.
WORLDS = 5
#: Factors by which masses and frictions of these worlds differ from the stated ones, at most.
MASSES, FRICTIONS = 1.6, 1.25

#: Limits of a new tool: number of parts, and extent of a part in metres.
NEW_TOOL = {"parts": 3, "extent": 0.5}


def plan_of(
    task: Task, steps: Sequence[dict[str, Any]], new_tools: Sequence[ToolFile] = ()
) -> Plan:
    """Returns the plan of some steps, with the tools that they name.

    Raises
    ------
    PushplanError
        If the steps are invalid, or name unknown tools.
    """
    shipped = ToolLibrary.shipped()
    own = {tool["name"]: tool for tool in new_tools}
    tools = []
    for name in dict.fromkeys(_tool_of(step) for step in steps):
        if name not in own and name not in shipped:
            raise PushplanError(f"the plan uses the tool `{name}`, which the task does not offer")
        tools.append(own[name] if name in own else shipped[name].to_dict())
    plan = {"steps": list(steps)}
    whole = {"schema_version": 2, "kind": "plan", "plan": plan, "tools": tools}
    return Plan.parse(json.dumps(whole | {"task": task.to_dict()}))


def judged(task: Task, hidden: list[Task], plan: object, new_tools: int = 0) -> str | None:
    """Returns the reason why a submitted plan fails, or `None` if it works.

    Parameters
    ----------
    task : Task
        Task of the board.
    hidden : list of Task
        Worlds with other masses and frictions in which the plan must also work.
    plan : object
        Submitted plan with the keys of a plan file.
    new_tools : int, default 0
        Number of tools of its own that the plan may use.
    """
    require_mujoco()
    try:
        if not isinstance(plan, dict):
            return "no plan: `plan` must hold the content of a plan file"
        return _fault(task, hidden, plan, new_tools)
    except (PushplanError, ArithmeticError, LookupError, TypeError, ValueError) as error:
        return f"invalid plan: {type(error).__name__}: {error}"


def _fault(task: Task, hidden: list[Task], plan: dict[str, Any], new_tools: int) -> str | None:
    """Returns the reason why a plan fails."""
    steps = plan["plan"]["steps"]
    shipped = ToolLibrary.shipped()
    own = [tool for tool in plan.get("tools", []) if tool["name"] not in shipped]
    if len(own) > new_tools:
        return f"{len(own)} tools that the task does not offer; {new_tools} allowed"
    for tool in own:
        if fault := _fault_of(tool):
            return fault
    if fault := broken_rule(plan_of(task, steps, own)):
        return fault
    for one in hidden or [task]:
        end = replayed(plan_of(one, steps, own))
        failure = end.failure or _moved(one, end.ends)
        if failure is not None:
            return failure
    return None


def broken_rule(plan: Plan) -> str | None:
    """Returns the rule of the task that a plan breaks, whatever its pushes move."""
    verdict = verify(plan, replays=0, threads=1)
    return verdict.reason if verdict.to_dict()["verdict"].get("forbidden") else None


def worlds(task: Task, key: str) -> list[Task]:
    """Returns the task in worlds with other masses and frictions, a function of the key."""
    found = []
    for k in range(WORLDS):
        draw = Draw("world", key, k)
        mapping = cast(dict[str, Any], copy.deepcopy(task.to_dict()))
        mapping.pop("unknown", None)
        scene = mapping["scene"]
        for thing in scene["objects"]:
            thing["mass"] = round(thing["mass"] * _factor(draw, MASSES), 4)
            thing["friction"] = round(thing["friction"] * _factor(draw, FRICTIONS), 4)
        top = scene["table"]
        top["friction"] = round(top["friction"] * _factor(draw, FRICTIONS), 4)
        found.append(Task.from_dict(cast(TaskFile, mapping)))
    return found


def _moved(task: Task, ends: Ends) -> str | None:
    """Returns the failure of a plan that displaces an object that must stay."""
    keep = task.to_dict().get("keep")
    if keep is None:
        return None
    for name, start in zip(task.objects, task.start):
        kept = name in keep["objects"] and name in ends
        if kept and math.dist(start[:2], ends[name][:2]) > keep.get("within", 0.005):
            return f"moves `{name}`, which must stay"
    return None


def _factor(draw: Draw, most: float) -> float:
    """Draws a factor between 1 / `most` and `most`."""
    return math.exp(draw.number(-1, 1) * math.log(most))


def _tool_of(step: dict[str, Any]) -> str:
    """Returns the name of the tool of a step."""
    [(_, details)] = step.items()
    return str(details["tool"])


def _fault_of(tool: dict[str, Any]) -> str | None:
    """Returns the reason why a new tool is not allowed."""
    parts = Tool.from_dict(cast(ToolFile, tool)).to_dict().get("parts", [])
    most, extent = NEW_TOOL["parts"], NEW_TOOL["extent"]
    if "blade" in tool or not 1 <= len(parts) <= most:
        return f"the new tool must have 1 to {most:.0f} parts and no blade"
    sizes = [side for part in parts for side in part.get("size", [math.inf])]
    if max(sizes) > extent:
        return f"parts of the new tool must be cuboids of at most {extent} m"
    return None
