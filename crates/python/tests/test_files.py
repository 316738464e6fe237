"""Files, texts and mappings obey the same rules, and faults state their location."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints, is_typeddict

import numpy as np
import pytest

import pushplan
from pushplan import files

TEXT = """\
scene:
  objects:
    - {name: can, shape: {cylinder: {radius: 0.05, height: 0.1}}, masss: 0.4, friction: 0.4, position: [0.62, 0.1]}
robot: {reach: {min: 0.1, max: 0.7}}
tools: all
goal: {object: cup, position: [0.45, 0.1], tolerance: 2}
"""


def test_all_faults_of_a_file_with_line_and_column(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(TEXT)
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.Task.load(path)
    faults = raised.value.faults
    found = {(fault.line, fault.column) for fault in faults}
    assert {(3, 67), (6, 16), (6, 55)} == found, raised.value
    slip = next(fault for fault in faults if fault.line == 3)
    assert slip.file == str(path)
    assert "masss" in slip.message and slip.advice == "did you mean `mass`?"
    assert f"{path}:3:67: error: " in str(raised.value)
    # A handler for the base class catches it as well.
    assert isinstance(raised.value, (pushplan.PushplanError, ValueError))


def test_faults_are_the_words_of_the_command(tmp_path: Path, command: Any) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(TEXT)
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.Task.load(path)
    checked = command("check", path)
    assert checked.returncode == 3
    assert str(raised.value) in checked.stderr + checked.stdout


def test_faults_of_a_mapping_name_its_keys(task: pushplan.Task) -> None:
    keys: Any = task.to_dict()
    keys["scene"]["objects"][0]["mass"] = math.nan
    keys["scene"]["objects"][0]["colour"] = "red"
    keys["goal"]["tolerance"] = np.float64(5.0)
    keys["robot"]["reach"]["max"] = "far"
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.Task.from_dict(keys)
    assert {fault.key for fault in raised.value.faults} == {
        "scene.objects[0].mass",
        "scene.objects[0].colour",
        "goal.tolerance",
        "robot.reach.max",
    }
    assert all(fault.line is None for fault in raised.value.faults)
    assert "task: goal.tolerance: error: " in str(raised.value)


def test_what_no_file_can_hold_is_refused(task: pushplan.Task) -> None:
    keys: Any = task.to_dict()
    build: Any = pushplan.Task.from_dict
    with pytest.raises(TypeError, match="robustness: expected numbers"):
        build({**keys, "robustness": {0.5}})
    with pytest.raises(TypeError, match="keys must be strings"):
        build({1: 2})
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(ValueError, match="deeper"):
        build({**keys, "tools": endless})
    wrong: list[Any] = [{}, [], 3, None, "scene"]
    for one in wrong:
        with pytest.raises(pushplan.FileError):
            build(one)


def test_mappings_and_files_are_the_same_task(root: Path) -> None:
    for path in sorted(root.glob("tasks/*.yaml")):
        task = pushplan.Task.load(path)
        again = pushplan.Task.from_dict(task.to_dict())
        assert again.to_dict() == task.to_dict(), path
        assert pushplan.Task.parse(task.to_yaml()).to_dict() == task.to_dict(), path
    for name in pushplan.ToolLibrary.shipped().names:
        tool = pushplan.ToolLibrary.shipped()[name]
        assert pushplan.Tool.from_dict(tool.to_dict()) == tool


def test_examples_are_the_shipped_tasks(root: Path) -> None:
    files = {path.stem: path for path in root.glob("tasks/**/*.yaml")}
    assert sorted(pushplan.Task.examples()) == sorted(files)
    for name, path in files.items():
        assert pushplan.Task.example(name).to_dict() == pushplan.Task.load(path).to_dict()
    with pytest.raises(pushplan.FileError, match="there is no such task"):
        pushplan.Task.example("pul-back")
    few = pushplan.ToolLibrary.of([pushplan.ToolLibrary.shipped()["stick"]])
    with pytest.raises(pushplan.FileError, match="unknown tool"):
        pushplan.Task.example("pull-back", few)


def test_arrays_are_taken_as_lists(task: pushplan.Task) -> None:
    keys: Any = task.to_dict()
    keys["goal"]["position"] = np.array([0.6, 0.14])
    assert pushplan.Task.from_dict(keys).goal_position == (0.6, 0.14)


def test_a_tool_of_ones_own_is_chosen_from() -> None:
    tool = pushplan.Tool.from_dict(
        {
            "name": "long-hook",
            "friction": 0.4,
            "parts": [
                {"name": "handle", "size": [0.42, 0.04, 0.05], "position": [0.26, 0.0]},
                {
                    "name": "bar",
                    "size": [0.16, 0.04, 0.05],
                    "position": [0.43, 0.08],
                    "yaw_deg": 90,
                },
            ],
        }
    )
    library = pushplan.ToolLibrary.shipped().with_tool(tool)
    assert "long-hook" in library and library["long-hook"] == tool
    assert len(library) == len(pushplan.ToolLibrary.shipped()) + 1
    # A tool replaces one of the same name, also a shipped one.
    smooth = pushplan.Tool.from_dict({**tool.to_dict(), "name": "stick", "friction": 0.1})
    replaced = library.with_tool(smooth)
    assert replaced["stick"] == smooth != library["stick"] and replaced.names == library.names
    assert replaced["screwdriver"] == library["screwdriver"]
    with pytest.raises(pushplan.FileError, match="already has a tool of this name"):
        pushplan.ToolLibrary.of([tool, tool])
    with pytest.raises(KeyError, match="no tool is called `spoon`"):
        library["spoon"]
    with pytest.raises(pushplan.FileError, match="separate pieces"):
        pushplan.Tool.from_dict(
            {
                "name": "apart",
                "friction": 0.4,
                "parts": [
                    {"name": "a", "size": [0.1, 0.1, 0.1], "position": [0.0, 0.0]},
                    {"name": "b", "size": [0.1, 0.1, 0.1], "position": [0.5, 0.0]},
                ],
            }
        )


def test_tools_that_the_task_names_are_checked_where_they_are_given(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(TEXT.replace("masss", "mass").replace("cup", "can").replace(" 2}", " 0.02}"))
    text = path.read_text().replace("tools: all", "tools: [hok]")
    path.write_text(text)
    with pytest.raises(pushplan.FileError) as raised:
        pushplan.Task.load(path, pushplan.ToolLibrary.shipped())
    [fault] = raised.value.faults
    assert (fault.line, fault.advice) == (5, "did you mean `hook`?")
    with pytest.raises(pushplan.FileError, match="unknown tool `hok`"):
        pushplan.solve(pushplan.Task.load(path))


@pytest.mark.parametrize(
    ("schema", "keys"),
    [
        (pushplan.task_schema(), files.TaskFile),
        (pushplan.tool_schema(), files.ToolFile),
    ],
)
def test_the_types_have_the_keys_of_the_schema(schema: dict[str, Any], keys: Any) -> None:
    least = {files.TaskFile: 30, files.ToolFile: 12}
    assert compared(schema, keys) > least[keys]


def compared(schema: dict[str, Any], keys: Any) -> int:
    """Compares a map of the schema with a typed dictionary; returns the number of keys."""
    assert set(schema["properties"]) == set(get_type_hints(keys)), keys
    # In a variant every key is optional, but exactly one is required.
    assert set(schema.get("required", [])) == set(keys.__required_keys__), keys
    count = 0
    for name, hint in get_type_hints(keys).items():
        count += 1
        for inner, kind in zip(maps_in(schema["properties"][name]), types_in(hint), strict=True):
            count += compared(inner, kind)
    return count


def maps_in(schema: dict[str, Any]) -> list[dict[str, Any]]:
    if "properties" in schema:
        return [schema]
    inner = [*schema.get("anyOf", []), *schema.get("oneOf", [])]
    inner += [schema["items"]] if isinstance(schema.get("items"), dict) else []
    return [found for one in inner for found in maps_in(one)]


def types_in(hint: Any) -> list[Any]:
    if is_typeddict(hint):
        return [hint]
    if get_origin(hint) is None:
        return []
    return [found for one in get_args(hint) for found in types_in(one)]
