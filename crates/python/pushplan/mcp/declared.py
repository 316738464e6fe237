"""Declarations of the tools: names, descriptions and JSON schemas of their arguments."""

from __future__ import annotations

from typing import Any

__all__ = ["DESCRIPTIONS", "FILES", "OUTPUT", "PROPERTIES", "SAVED", "schema"]

_TASK = {
    "description": "Task: the text of a task file (YAML), or an object with the same keys. Lengths "
    "are metres, masses kilograms, keys that end in `_deg` degrees. The resource "
    "pushplan://schema/task states every key.",
    "type": ["string", "object"],
}
_PLAN = {
    "description": "Plan: the value of `plan` in an answer of `solve` or `design`.",
    "type": ["string", "object"],
}
_TOOLS = {
    "description": "Tools in addition to the shipped ones, each a text of a tool file or an object "
    "with its keys; see the resource pushplan://schema/tool.",
    "type": "array",
    "items": {"type": ["string", "object"]},
}
_LIMIT = {
    "description": "Maximum duration, seconds; by default the maximum of the server.",
    "type": "number",
    "minimum": 0.1,
}
_EFFORT = {
    "description": "Size of the search; default standard.",
    "enum": ["draft", "standard", "thorough"],
}
_SEED = {"description": "Seed of samples and perturbations; default 0.", "type": "integer"}
_REPAIR = {
    "description": "Whether to search for repairs that were verified; default true.",
    "type": "boolean",
}
_ROW = {"type": "array", "items": {"type": ["number", "null"]}, "minItems": 3, "maxItems": 3}


def _whole(text: str, low: int, high: int) -> dict[str, Any]:
    return {"description": text, "type": "integer", "minimum": low, "maximum": high}


#: Arguments of each tool that reach the planner.
PROPERTIES: dict[str, dict[str, Any]] = {
    "check": {
        "task": _TASK,
        "tool": {"description": "Tool file to check.", "type": ["string", "object"]},
        "plan": _PLAN,
        "kind": {
            "description": "Kind of the checked input; default task.",
            "enum": ["task", "tool", "plan"],
        },
        "tools": _TOOLS,
        "time_limit": _LIMIT,
    },
    "why": {
        "task": _TASK, "tools": _TOOLS, "seed": _SEED, "repair": _REPAIR, "time_limit": _LIMIT,
    },
    "solve": {
        "task": _TASK, "tools": _TOOLS, "effort": _EFFORT, "seed": _SEED, "repair": _REPAIR,
        "time_limit": _LIMIT,
    },
    "verify": {
        "plan": _PLAN,
        "replays": _whole("Minimum number of perturbed replays per engine; default 8.", 0, 1000),
        "seed": _SEED,
        "time_limit": _LIMIT,
    },
    "design": {
        "task": _TASK,
        "tools": _TOOLS,
        "parts": _whole("Maximum number of parts of the new tool; default 3.", 1, 6),
        "candidates": _whole("Number of screened tools; default 200.", 1, 10000),
        "effort": _EFFORT,
        "seed": _SEED,
        "time_limit": _LIMIT,
    },
    "draw": {
        "task": _TASK,
        "plan": {**_PLAN, "description": "Plan to draw instead of a task."},
        "size": _whole("Width and height of the picture, pixels; default 512.", 64, 1024),
        "tools": _TOOLS,
        "time_limit": _LIMIT,
    },
    "run_step": {
        "task": _TASK,
        "observations": {
            "description": "Observed poses at rest, oldest first: before the first push and after "
            "each push. Each is a list of poses [x, y, heading] in metres and radians, in the "
            "order of the task's objects, or an object with a pose for each name. By default the "
            "start of the task.",
            "type": "array",
            "items": {
                "anyOf": [
                    {"type": "array", "items": _ROW},
                    {"type": "object", "additionalProperties": _ROW},
                ]
            },
        },
        "tools": _TOOLS,
        "max_pushes": _whole("Maximum number of pushes of the loop; default 12.", 1, 50),
        "seed": _SEED,
        "time_limit": _LIMIT,
    },
}  # fmt: skip

#: Arguments that name files in the folder of the server: the argument that a file replaces.
FILES: dict[str, str] = {"task_file": "task", "plan_file": "plan", "tool_file": "tool"}

#: Keys of an answer that `save_as` writes, by tool.
SAVED = {"solve": "plan", "design": "plan", "draw": "svg"}

DESCRIPTIONS: dict[str, str] = {
    "check": "Check a task, a tool or a plan. Lists every fault with place and remedy, and a "
    "repair that was applied and checked again.",
    "why": "Explain why a task has no plan: the limit that prevents one, and repairs after which "
    "a plan was found and verified. Fast.",
    "solve": "Choose a tool and pushes that bring the objects to their goals, and verify the plan "
    "by replays in two physics engines. Only the status `solved` states that the plan works. "
    "Without a plan, the answer has the cause and repairs that were verified.",
    "verify": "Replay a plan in two physics engines, as written and with small perturbations.",
    "design": "Propose a new tool for a task that no tool solves.",
    "draw": "Draw a task or a plan from above: an SVG text and a PNG image.",
    "run_step": "Choose the next push of a closed loop from the observations so far, for objects "
    "whose masses, frictions or joints are unknown. Execute the push, observe, and call again "
    "with all observations.",
}

_EDIT = {
    "type": "object",
    "properties": {
        "action": {"enum": ["rename", "set", "remove"]},
        "path": {"type": "string", "description": "Key, such as scene.objects[0].friction."},
        "from": {"description": "Old key, value or item; null if the key is new."},
        "to": {"description": "New key or value; null for remove."},
    },
    "required": ["action", "path", "from", "to"],
}

#: Schema of all answers.
OUTPUT: dict[str, Any] = {
    "type": "object",
    "properties": {
        "status": {"type": "string"},
        "evidence": {"type": "object", "description": "Faults, or results of the replays."},
        "cause": {
            "type": ["string", "null"],
            "description": "Cause of an invalid input or a missing plan; null without one.",
        },
        "repairs": {
            "type": "array",
            "description": "Repairs that were applied and improved the result, best first.",
            "items": {
                "type": "object",
                "properties": {
                    "edits": {"type": "array", "items": _EDIT},
                    "changes": {
                        "enum": ["text", "plan", "robot", "scene"],
                        "description": "Subject of the change: a slip in the text, a limit of the "
                        "plan, the robot, or bodies on the table.",
                    },
                    "reason": {"type": "string"},
                    "verified": {
                        "type": "object",
                        "description": "Faults before and after the repair, and the status of "
                        "solving the repaired task; null if it was only checked.",
                    },
                    "task": {"type": "object", "description": "Repaired task."},
                },
                "required": ["edits", "changes", "reason", "verified", "task"],
            },
        },
    },
    "required": ["status", "evidence", "cause", "repairs"],
}


def schema(name: str, with_files: bool) -> dict[str, Any]:
    """Returns the schema of a tool's arguments; with a folder, they may name files in it."""
    properties = dict(PROPERTIES[name])
    if with_files:
        for key, replaced in FILES.items():
            if replaced in properties:
                text = f"File of the {replaced} in the folder of the server, instead of it."
                properties[key] = {"description": text, "type": "string"}
        if name in SAVED:
            text = f"File in the folder of the server to which `{SAVED[name]}` is written."
            properties["save_as"] = {"description": text, "type": "string"}
    return {"type": "object", "properties": properties, "additionalProperties": False}
