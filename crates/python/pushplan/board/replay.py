"""Replays of plans in MuJoCo, by the scripts of the export."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType

from .. import Plan, PushplanError
from .sketch import Ends

__all__ = ["Replayed", "replayed", "require_mujoco"]

#: Failure of a plan that breaks nothing but ends elsewhere.
MISSES = "misses the goal"

#: Loaded scripts by name.
_SCRIPTS: dict[str, ModuleType] = {}


@dataclass(frozen=True)
class Replayed:
    """End of a replay."""

    #: Failure; `None` if the plan works.
    failure: str | None
    #: Final poses of objects; empty for levering.
    ends: Ends = field(default_factory=dict)
    #: Version of the engine.
    mujoco: str = ""

    @property
    def is_sound(self) -> bool:
        """Whether the plan at most misses its goal."""
        return self.failure in (None, MISSES)


def replayed(plan: Plan) -> Replayed:
    """Replays a plan in MuJoCo.

    Raises
    ------
    PushplanError
        If the package mujoco is missing, or the plan cannot be exported.
    """
    scene = plan.to_mjcf()
    in_space = "lever.py" in scene
    module = _script("lever.py" if in_space else "replay.py", plan)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plan.xml"
        path.write_text(scene)
        if in_space:
            found = module.decided(lambda finer: module.Scene(str(path), finer).run())
            return Replayed(found["failure"], {}, found["mujoco"])
        found = module.replay(path)
    ends = {
        name.removeprefix("object/"): (pose[0], pose[1], pose[2])
        for name, pose in found["poses"].items()
    }
    return Replayed(found["failure"], ends, found["mujoco"])


def require_mujoco() -> None:
    """Checks that MuJoCo is installed.

    Raises
    ------
    PushplanError
        If it is not.
    """
    if importlib.util.find_spec("mujoco") is None:
        raise PushplanError("the board needs MuJoCo; run `pip install 'pushplan[board]'`")


def _script(name: str, plan: Plan) -> ModuleType:
    """Returns the script that the export of a plan writes beside its scene."""
    if name not in _SCRIPTS:
        require_mujoco()
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "plan.json"
            plan.save(file)
            words = ["pushplan", "export", str(file), "--out", folder, "--threads", "1"]
            done = subprocess.run(
                [sys.executable, "-m", *words], capture_output=True, text=True, check=False
            )
            if done.returncode != 0:
                raise PushplanError(f"the plan cannot be exported: {done.stderr.strip()}")
            spec = importlib.util.spec_from_file_location(f"_{name[:-3]}", Path(folder) / name)
            assert spec and spec.loader
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
        _SCRIPTS[name] = module
    return _SCRIPTS[name]
