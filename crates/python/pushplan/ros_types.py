"""Builds the types of the action `pushplan_interfaces/action/Push` without a ROS 2 workspace.

    pip install 'pushplan[ros]' 'empy<4' catkin_pkg lark
    python -m pushplan.ros_types ~/pushplan_types
    PYTHONPATH=~/pushplan_types python -m pushplan.ros TASK

The module needs a C and a C++ compiler. ROS's own generators, from its wheels, write code that is
compiled to one module for the middleware Fast DDS. In a workspace, build a package of interfaces
with `action/Push.action` from this package instead.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Optional

import numpy as np

__all__ = ["build", "main"]

PACKAGE = "pushplan_interfaces"
#: Interfaces on which an action depends.
NEEDS = ("action_msgs", "builtin_interfaces", "service_msgs", "unique_identifier_msgs")
LIBRARIES = (
    "rcutils", "rmw", "rosidl_runtime_c", "rosidl_typesupport_c", "rosidl_typesupport_fastrtps_c",
    "rosidl_typesupport_fastrtps_cpp", "fastcdr",
)


def build(folder: str | Path) -> Path:
    """Builds the package `pushplan_interfaces` in a folder for `PYTHONPATH`; returns the folder.

    Raises
    ------
    RuntimeError
        If a library of ROS is missing, or the compiler fails.
    """
    folder = Path(folder).absolute()
    prefix = Path(sys.prefix)
    # Folders of the generators' templates.
    os.environ.setdefault("AMENT_PREFIX_PATH", str(prefix))
    package = folder / PACKAGE
    package.mkdir(parents=True, exist_ok=True)
    _generate(package, prefix)
    (package / "__init__.py").touch()
    headers = [prefix / "include", *(prefix / "include").iterdir(), folder]
    headers += [Path(sysconfig.get_path("include")), Path(np.get_include())]
    flags = ["-O1", "-fPIC", *(f"-I{path}" for path in headers if path.is_dir())]
    libraries = [_library(prefix, name) for name in LIBRARIES]
    for name in NEEDS:
        for kind in (
            "rosidl_generator_c",
            "rosidl_generator_py",
            "rosidl_typesupport_fastrtps_c",
            "rosidl_typesupport_c",
        ):
            libraries.append(_library(prefix, f"{name}__{kind}"))
    with tempfile.TemporaryDirectory() as made:
        objects: list[str] = []
        for source in sorted([*package.rglob("*.c"), *package.rglob("*.cpp")]):
            compiler = ["cc"] if source.suffix == ".c" else ["c++", "-std=c++17"]
            objects.append(f"{made}/{len(objects)}.o")
            _run([*compiler, *flags, "-c", source, "-o", objects[-1]])
        module = (
            package / f"{PACKAGE}_s__rosidl_typesupport_c{sysconfig.get_config_var('EXT_SUFFIX')}"
        )
        _run(["c++", "-shared", *objects, *libraries, f"-Wl,-rpath,{prefix / 'lib'}", "-o", module])
    return folder


def _generate(package: Path, prefix: Path) -> None:
    from rosidl_adapter.action import convert_action_to_idl  # type: ignore[import-not-found,unused-ignore]
    from rosidl_generator_c.cli import GenerateC  # type: ignore[import-not-found,unused-ignore]
    from rosidl_generator_py.cli import GeneratePython  # type: ignore[import-not-found,unused-ignore]
    from rosidl_typesupport_c.cli import GenerateCTypesupport  # type: ignore[import-not-found,unused-ignore]
    from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport  # type: ignore[import-not-found,unused-ignore]

    convert_action_to_idl(
        Path(__file__).parent, PACKAGE, Path("action/Push.action"), package / "action"
    )
    one: dict[str, Any] = {"typesupport_implementations": ["rosidl_typesupport_fastrtps_c"]}
    for generator in [
        GenerateC("c"),
        GenerateFastRTPSCTypesupport("fastrtps_c"),
        # A single implementation needs no type support library.
        GenerateCTypesupport("c", **one),
        GeneratePython("py", typesupport_implementations=["rosidl_typesupport_c"]),
    ]:
        generator.generate(
            PACKAGE, [f"{package}:action/Push.idl"], [str(prefix / "share")], package
        )


def _library(prefix: Path, name: str) -> Path:
    found = sorted((prefix / "lib").glob(f"lib{name}.so*"))
    if not found:
        raise RuntimeError(f"lib{name} is missing in {prefix / 'lib'}: pip install 'pushplan[ros]'")
    return found[0]


def _run(command: Sequence[str | Path]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{command[0]} failed:\n{done.stderr}")


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Builds the types in a folder given on the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m pushplan.ros_types",
        description="Builds the types of the ROS 2 action `Push`.",
    )
    parser.add_argument("folder", type=Path, help="folder for PYTHONPATH")
    print(build(parser.parse_args(arguments).folder))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
