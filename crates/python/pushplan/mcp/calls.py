"""Calls of the server: one function for each tool, from arguments to an answer.

Every answer has the keys `status`, `evidence`, `cause` and `repairs`. The functions read and write
no files; they run in the worker process.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Optional, cast

import pushplan
from pushplan import Plan, Progress, Solution, Task

from . import repairs
from .declared import PROPERTIES
from .drawing import png, svg
from .edits import Edit
from .inputs import Given, InputError, library_of, plan_of, task_of, tool_of
from .steps import next_push

__all__ = ["Answer", "Context", "answer"]

Answer = dict[str, Any]
if TYPE_CHECKING:
    _Effort = Literal["draft", "standard", "thorough"]

#: Share of the time limit for the first search; the rest is for verified repairs.
FIRST = 0.6
#: Maximum size of pictures, pixels.
PIXELS = 1024


@dataclass(frozen=True)
class Context:
    """Limits of a call, and the receiver of its progress."""

    #: Maximum duration of a call, seconds.
    time_limit: float
    #: Number of worker threads.
    threads: int
    progress: Callable[[Progress], object]


def answer(name: str, arguments: dict[str, Any], context: Context) -> Answer:
    """Returns the answer of a call; invalid arguments are answered, too."""
    try:
        unknown = sorted(set(arguments) - set(PROPERTIES[name]))
        if unknown:
            known = ", ".join(f"`{key}`" for key in PROPERTIES[name])
            raise InputError(f"unknown argument `{unknown[0]}`; use {known}")
        found = _CALLS[name](_Arguments(arguments, context))
    except (InputError, pushplan.PushplanError, ValueError, TypeError, OverflowError) as error:
        found = _answer("invalid", cause=str(error))
    return cast(Answer, _finite(found))


class _Arguments:
    """Arguments of a call with their checks."""

    def __init__(self, given: dict[str, Any], context: Context) -> None:
        self.given, self.context = given, context
        self.begin = time.monotonic()
        self.limit = self.number("time_limit", context.time_limit, 0.1, context.time_limit)
        self.library = library_of(given.get("tools"))

    def number(self, key: str, default: float, low: float, high: float) -> float:
        value = self.given.get(key)
        if value is None:
            return default
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise InputError(f"`{key}` must be a number from {low:g} to {high:g}")
        if not low <= value <= high:
            raise InputError(f"`{key}` must be from {low:g} to {high:g}, found {value:g}")
        return float(value)

    def whole(self, key: str, default: int, low: int, high: int) -> int:
        value = self.number(key, default, low, high)
        if value != int(value):
            raise InputError(f"`{key}` must be a whole number, found {value:g}")
        return int(value)

    def choice(self, key: str, default: str, *values: str) -> str:
        value = self.given.get(key)
        if value is None:
            return default
        if value not in values:
            raise InputError(f"`{key}` must be one of {', '.join(values)}")
        return str(value)

    def flag(self, key: str, default: bool) -> bool:
        value = self.given.get(key)
        if value is not None and not isinstance(value, bool):
            raise InputError(f"`{key}` must be true or false")
        return default if value is None else value

    @property
    def effort(self) -> _Effort:
        return cast("_Effort", self.choice("effort", "standard", "draft", "standard", "thorough"))

    @property
    def seed(self) -> int:
        return self.whole("seed", 0, 0, 2**31)

    def left(self) -> float:
        return self.limit - (time.monotonic() - self.begin)

    def task(self) -> Given[Task]:
        return task_of(self.given.get("task"), self.library)

    def trial(self, effort: Optional[_Effort]) -> repairs.Trial:
        """Returns the means to verify repairs, with solving if an effort is given."""
        until = self.begin + self.limit
        if effort is None:
            return repairs.Trial(self.library, None, until)

        def solve(task: Task, seconds: float) -> str:
            return self.solve(task, effort, seconds).status

        return repairs.Trial(self.library, solve, until)

    def solve(self, task: Task, effort: _Effort, seconds: float) -> Solution:
        return pushplan.solve(
            task,
            self.library,
            effort=effort,
            seed=self.seed,
            time_limit=max(seconds, 0.01),
            threads=self.context.threads,
            progress=self.context.progress,
        )


def _answer(
    status: str,
    evidence: Optional[dict[str, Any]] = None,
    cause: Optional[str] = None,
    found: Optional[list[repairs.Repair]] = None,
    **more: Any,
) -> Answer:
    listed = [repair.to_json() for repair in found or []]
    return {"status": status, "evidence": evidence or {}, "cause": cause, "repairs": listed, **more}


def _invalid(given: Given[Any], found: Optional[list[repairs.Repair]] = None) -> Answer:
    count = len(given.faults)
    first = given.faults[0]
    cause = f"{count} fault{'s' if count > 1 else ''}; the first is: {first['message']}"
    return _answer("invalid", {"faults": given.faults}, cause, found)


def _check(arguments: _Arguments) -> Answer:
    kind = arguments.choice("kind", "task", "task", "tool", "plan")
    given: Given[Any]
    if kind == "task":
        given = arguments.task()
        if given.faults and given.mapping is not None:
            return _invalid(given, repairs.of_faults(given.mapping, arguments.trial(None)))
    else:
        read: Callable[[object], Given[Any]] = tool_of if kind == "tool" else plan_of
        given = read(arguments.given.get(kind))
    return _invalid(given) if given.faults else _answer("valid", {"faults": []})


def _solved(arguments: _Arguments, effort: _Effort, with_plan: bool) -> Answer:
    given = arguments.task()
    repair = arguments.flag("repair", True)
    if given.value is None:
        found = None
        if repair and given.mapping is not None:
            found = repairs.of_faults(given.mapping, arguments.trial(effort))
        return _invalid(given, found)
    first = FIRST if repair else 1.0
    solution = arguments.solve(given.value, effort, first * arguments.limit)
    status = solution.status
    found = None
    if repair and status != "solved" and given.mapping is not None:
        found = repairs.of_solution(given.mapping, status, solution, arguments.trial(effort))
    more: dict[str, Any] = {}
    best = solution.best
    if with_plan and best is not None:
        more["plan"] = compact(best)
    return _answer(status, _evidence(solution), _cause(solution), found, **more)


def _solve(arguments: _Arguments) -> Answer:
    return _solved(arguments, arguments.effort, with_plan=True)


def _why(arguments: _Arguments) -> Answer:
    return _solved(arguments, "draft", with_plan=False)


def _cause(solution: Solution) -> Optional[str]:
    if solution.status == "solved":
        return None
    if solution.cause:
        return solution.cause
    if solution.timed_out:
        return "the time limit ended the search; raise `time_limit`"
    best = solution.best
    if best is not None and best.verdict is not None:
        return best.verdict.reason
    return "no feasible push was found"


def _evidence(solution: Solution) -> dict[str, Any]:
    found: dict[str, Any] = {"timed_out": solution.timed_out, "warnings": solution.warnings}
    best = solution.best
    if best is not None:
        found["tools"] = [tool.name for tool in best.tools]
        found["predicted_error"] = best.error
        if best.verdict is not None:
            found |= _of_verdict(best.verdict)
    return found


def _of_verdict(verdict: pushplan.Verdict) -> dict[str, Any]:
    nominal = [
        {"engine": one.engine, "reached": one.reached, "error": one.error, "force": one.force}
        for one in verdict.replays
        if one.draw is None
    ]
    return {
        "verdict": verdict.reason,
        "passed": verdict.passed,
        "robustness": verdict.robustness,
        "nominal_replays": nominal,
        "replays": len(verdict.replays),
    }


def compact(plan: Plan) -> dict[str, Any]:
    """Returns a plan file without its replays, which `verify` computes again."""
    return {**plan.to_dict(), "verdict": None}


def _verify(arguments: _Arguments) -> Answer:
    given = plan_of(arguments.given.get("plan"))
    if given.value is None:
        return _invalid(given)
    verdict = pushplan.verify(
        given.value,
        replays=arguments.whole("replays", 8, 0, 1000),
        seed=arguments.seed,
        time_limit=arguments.limit,
        threads=arguments.context.threads,
    )
    status = "passed" if verdict.passed else "fragile" if verdict.nominal_ok else "failed"
    evidence = {**_of_verdict(verdict), "violations": given.value.violations}
    return _answer(status, evidence, None if verdict.passed else verdict.reason)


def _design(arguments: _Arguments) -> Answer:
    given = arguments.task()
    if given.value is None:
        mapping = given.mapping
        trial = arguments.trial(None)
        return _invalid(given, None if mapping is None else repairs.of_faults(mapping, trial))
    found = pushplan.design(
        given.value,
        arguments.library,
        parts=arguments.whole("parts", 3, 1, 6),
        candidates=arguments.whole("candidates", 200, 1, 10000),
        effort=arguments.effort,
        seed=arguments.seed,
        time_limit=arguments.limit,
        threads=arguments.context.threads,
        progress=arguments.context.progress,
    )
    more: dict[str, Any] = {"known_tools": found.known.status}
    solution = found.solution or found.known
    status = solution.status
    if found.tool is not None:
        more["tool"] = found.tool.to_dict()
    repaired = None
    if solution.best is not None:
        plan = more["plan"] = compact(solution.best)
        repaired = _with_tools(given.value, plan, status)
    return _answer(status, _evidence(solution), _cause(solution), repaired, **more)


def _with_tools(task: Task, plan: dict[str, Any], status: str) -> Optional[list[repairs.Repair]]:
    """Adds the tools of a plan to its task, and returns this change, if the task lacks them."""
    used = [tool["name"] for tool in plan["tools"]]
    more = [name for name in used if name not in (task.tools or used)]
    if not more:
        return None
    mapping: dict[str, Any] = dict(task.to_dict())
    edit = Edit("set", "tools", mapping["tools"], [*mapping["tools"], *more])
    mapping["tools"] = edit.new
    plan["task"] = {**plan["task"], "tools": edit.new}
    reason = "`tools` does not name the tool of the plan"
    return [repairs.Repair([edit], "plan", reason, (0, 0), status, mapping)]


def _draw(arguments: _Arguments) -> Answer:
    size = arguments.whole("size", 512, 64, PIXELS)
    plan: Optional[Plan] = None
    if arguments.given.get("plan") is not None:
        of_plan = plan_of(arguments.given["plan"])
        if of_plan.value is None:
            return _invalid(of_plan)
        plan = of_plan.value
        task = plan.task
    else:
        given = arguments.task()
        if given.value is None:
            return _invalid(given)
        task = given.value
    evidence = {"objects": list(task.objects), "pushes": len(plan.pushes) if plan else 0}
    return _answer("drawn", evidence, svg=svg(task, plan, size), png=png(task, plan, size))


def _run_step(arguments: _Arguments) -> Answer:
    given = arguments.task()
    if given.value is None:
        mapping = given.mapping
        trial = arguments.trial(None)
        return _invalid(given, None if mapping is None else repairs.of_faults(mapping, trial))
    context = arguments.context
    status, cause, evidence, more = next_push(
        given.value,
        arguments.library,
        arguments.given.get("observations"),
        seed=arguments.seed,
        max_pushes=arguments.whole("max_pushes", 12, 1, 50),
        threads=context.threads,
        progress=context.progress,
    )
    return _answer(status, evidence, cause, **more)


_CALLS: dict[str, Callable[[_Arguments], Answer]] = {
    "check": _check,
    "why": _why,
    "solve": _solve,
    "verify": _verify,
    "design": _design,
    "draw": _draw,
    "run_step": _run_step,
}


def _finite(value: Any) -> Any:
    """Replaces numbers that JSON cannot state by `None`."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {str(key): _finite(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(one) for one in value]
    if value is None or isinstance(value, (str, int, float)):
        return value
    return json.loads(json.dumps(value, default=str))
