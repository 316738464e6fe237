# Types of the compiled part of the package. The docstrings are those of the module, copied by
# `python crates/python/tests/stub_docs.py`.

import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Protocol, final, type_check_only

import numpy as np
import numpy.typing as npt
from typing_extensions import Never

from .files import TaskFile, ToolFile
from .progress import Progress

__all__ = [
    "Belief",
    "Design",
    "Motion",
    "Plan",
    "Push",
    "Recording",
    "Replay",
    "Rollouts",
    "Run",
    "Solution",
    "TableFit",
    "Task",
    "Tool",
    "ToolLibrary",
    "Trajectory",
    "Verdict",
    "allow_files_in",
    "design",
    "export_mcap",
    "export_mjcf",
    "fit",
    "import_task",
    "import_tool",
    "infer",
    "main",
    "predict",
    "recording_schema",
    "rollout",
    "run",
    "solve",
    "solve_all",
    "task_schema",
    "tool_schema",
    "verify",
    "__version__",
]

__version__: str

_Path = str | os.PathLike[str]
_Floats = npt.NDArray[np.float64]
_Effort = Literal["draft", "standard", "thorough"]
_OutOfRange = Literal["warn", "simulate", "refuse"]
_Progress = bool | Callable[[Progress], object] | None
_Status = Literal["solved", "fragile", "partial", "no_plan", "failed_verification"]

@final
class TableFit:
    """Table fit: friction, support and a change of the network's last layer, from recordings of one
    table. It is an argument of `solve` and `run`, and a result of `fit` and `run`.
    """
    @staticmethod
    def load(path: _Path) -> TableFit:
        """Reads a table fit.

        Parameters
        ----------
        path : str or path-like
            File that `save` or the command `pushplan fit --save-fit` wrote.

        Returns
        -------
        TableFit
            Table fit of the file.

        Raises
        ------
        FileError
            If the file is unreadable or invalid.
        """
    @staticmethod
    def parse(text: str) -> TableFit:
        """Restores a table fit from the text that pickle stores."""
    def save(self, path: _Path) -> None:
        """Writes the table fit (JSON).

        The file is replaced as a whole, so that no partial file remains after an error.

        Parameters
        ----------
        path : str or path-like
            File to write, in an existing folder.

        Raises
        ------
        FileError
            If the file cannot be written.
        """
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def pushes(self) -> int:
        """Number of recorded pushes of the fit."""
    @property
    def objects(self) -> list[str]:
        """Names of the pushed objects."""
    @property
    def friction(self) -> float | None:
        """Friction coefficient of tool and objects; `None` if the recordings do not determine it."""
    @property
    def support(self) -> float | None:
        """Support of the objects as a share of the corners' distance; `None` if the recordings do not
        determine it.
        """
    @property
    def noise(self) -> float:
        """Scale of the residual errors, metres."""
    @property
    def changes_network(self) -> bool:
        """Whether the fit changes the network's last layer."""
    def to_dict(self) -> dict[str, Any]:
        """Returns the table fit with the keys of its file."""
    def __eq__(self, other: object, /) -> bool: ...

@final
class Tool:
    """Rigid tool of upright solids, which the end effector holds at its grip.

    Instances come from `Tool.load`, `Tool.parse`, `Tool.from_dict` and `ToolLibrary`. Two tools are
    equal if all their values are equal.
    """
    def __new__(cls, *_arguments: Never, **_named: Never) -> Tool: ...
    @staticmethod
    def load(path: _Path) -> Tool:
        """Reads a tool file (YAML).

        Parameters
        ----------
        path : str or path-like
            Tool file.

        Returns
        -------
        Tool
            Tool of the file.

        Raises
        ------
        FileError
            If the file is unreadable or invalid; it lists all faults.

        Examples
        --------
        >>> tool = pushplan.Tool.load("my-hook.yaml")
        """
    @staticmethod
    def parse(text: str, name: str = "tool") -> Tool:
        """Reads the text of a tool file.

        Parameters
        ----------
        text : str
            Content of the file (YAML).
        name : str, default "tool"
            File name in error messages.

        Returns
        -------
        Tool
            Tool of the text.

        Raises
        ------
        FileError
            If the text is invalid; it lists all faults.

        Examples
        --------
        >>> part = "{name: bar, size: [0.2, 0.04, 0.05], position: [0.1, 0]}"
        >>> tool = pushplan.Tool.parse(f"{{name: rod, friction: 0.4, parts: [{part}]}}")
        """
    @staticmethod
    def from_dict(mapping: ToolFile) -> Tool:
        """Builds a tool from a mapping with the keys of a tool file.

        Parameters
        ----------
        mapping : pushplan.files.ToolFile
            Mapping with lengths in metres and angles in degrees. NumPy arrays count as lists.

        Returns
        -------
        Tool
            Tool of the mapping.

        Raises
        ------
        FileError
            If a value is invalid; it lists all faults with their keys.
        TypeError
            If the mapping contains other types than a file.

        Examples
        --------
        >>> bar = {"name": "bar", "size": [0.2, 0.04, 0.05], "position": [0.1, 0]}
        >>> tool = pushplan.Tool.from_dict({"name": "rod", "friction": 0.4, "parts": [bar]})
        """
    @property
    def name(self) -> str:
        """Name of the tool, unique in a library."""
    @property
    def description(self) -> str:
        """Description for people, one line; may be empty."""
    @property
    def friction(self) -> float:
        """Friction value; the friction coefficient of a pair is the mean of its two values."""
    @property
    def grip(self) -> tuple[float, float, float]:
        """Pose of the end effector in the tool frame: x and y in metres, heading in radians."""
    def to_dict(self) -> ToolFile:
        """Returns the tool with the keys of a tool file, for `Tool.from_dict`.

        Examples
        --------
        >>> copy = {**tool.to_dict(), "name": "smooth-hook", "friction": 0.2}
        >>> tools = pushplan.ToolLibrary.shipped().with_tool(pushplan.Tool.from_dict(copy))
        """
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class ToolLibrary:
    """Collection of tools with unique names, sorted by name.

    `library[name]` returns a tool, and `name in library` checks for one.
    """
    def __new__(cls, *_arguments: Never, **_named: Never) -> ToolLibrary: ...
    @staticmethod
    def shipped() -> ToolLibrary:
        """Returns the tools shipped with the package.

        Examples
        --------
        >>> hook = pushplan.ToolLibrary.shipped()["hook"]
        """
    @staticmethod
    def load(folder: _Path) -> ToolLibrary:
        """Reads every tool file (`.yaml`, `.yml`) of a folder.

        Parameters
        ----------
        folder : str or path-like
            Folder with one file or more.

        Returns
        -------
        ToolLibrary
            Tools of the folder.

        Raises
        ------
        FileError
            If a file is unreadable or invalid; it lists all faults of all files.

        Examples
        --------
        >>> tools = pushplan.ToolLibrary.load("my-tools")
        """
    @staticmethod
    def of(tools: Sequence[Tool]) -> ToolLibrary:
        """Returns a library of the given tools.

        Parameters
        ----------
        tools : sequence of Tool
            Tools with different names.

        Returns
        -------
        ToolLibrary
            Library of these tools only.

        Raises
        ------
        FileError
            If two tools have the same name.

        Examples
        --------
        >>> shipped = pushplan.ToolLibrary.shipped()
        >>> few = pushplan.ToolLibrary.of([shipped["hook"], shipped["stick"]])
        """
    def with_tool(self, tool: Tool) -> ToolLibrary:
        """Returns a library that also contains a tool, in place of a tool of the same name.

        Parameters
        ----------
        tool : Tool
            Tool to add.

        Returns
        -------
        ToolLibrary
            New library; this one does not change.

        Examples
        --------
        >>> tools = pushplan.ToolLibrary.shipped().with_tool(tool)
        >>> solution = pushplan.solve(task, tools, effort="draft")
        """
    def with_folder(self, folder: _Path) -> ToolLibrary:
        """Returns a library that also contains the tools of a folder, in place of tools of the same
        names.

        Parameters
        ----------
        folder : str or path-like
            Folder with one tool file or more.

        Returns
        -------
        ToolLibrary
            New library; this one does not change.

        Raises
        ------
        FileError
            If a file is invalid, or two files have a tool of the same name.

        Examples
        --------
        >>> tools = pushplan.ToolLibrary.shipped().with_folder("my-tools")
        """
    @property
    def names(self) -> list[str]:
        """Names of the tools that push, sorted. Tools with a blade are found by their names."""
    def __getitem__(self, name: str, /) -> Tool: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Task:
    """Planning task: scene, robot, allowed pushes and goals.

    Lengths are metres, angles radians and masses kilograms. In files and mappings, keys that end in
    `_deg` are degrees. The robot's base is the origin, and x points forward from it. Instances come
    from `Task.load`, `Task.example`, `Task.parse`, `Task.from_dict` and `import_task`.
    """
    def __new__(cls, *_arguments: Never, **_named: Never) -> Task: ...
    @staticmethod
    def load(path: _Path, tools: ToolLibrary | None = None) -> Task:
        """Reads a task file (YAML).

        Parameters
        ----------
        path : str or path-like
            Task file.
        tools : ToolLibrary, optional
            Tools to check the names of the task against; by default names are not checked.

        Returns
        -------
        Task
            Task of the file.

        Raises
        ------
        FileError
            If the file is unreadable or invalid, or names a tool that `tools` lacks. It lists all
            faults.

        Examples
        --------
        >>> task = pushplan.Task.load("my-task.yaml")
        """
    @staticmethod
    def example(name: str, tools: ToolLibrary | None = None) -> Task:
        """Returns a task shipped with the package.

        Parameters
        ----------
        name : str
            Name of the task, one of `Task.examples()`.
        tools : ToolLibrary, optional
            Tools to check the names of the task against; by default names are not checked.

        Returns
        -------
        Task
            Shipped task.

        Raises
        ------
        FileError
            If no shipped task has this name, or the task names a tool that `tools` lacks.

        Examples
        --------
        >>> task = pushplan.Task.example("pull-back-behind-wall")
        """
    @staticmethod
    def examples() -> list[str]:
        """Returns the names of the shipped tasks."""
    @staticmethod
    def parse(text: str, name: str = "task") -> Task:
        """Reads the text of a task file.

        Parameters
        ----------
        text : str
            Content of the file (YAML).
        name : str, default "task"
            File name in error messages; also the name of a task that states none.

        Returns
        -------
        Task
            Task of the text.

        Raises
        ------
        FileError
            If the text is invalid; it lists all faults.
        """
    @staticmethod
    def from_dict(mapping: TaskFile) -> Task:
        """Builds a task from a mapping with the keys of a task file.

        Parameters
        ----------
        mapping : pushplan.files.TaskFile
            Mapping with lengths in metres, masses in kilograms and angles in degrees. NumPy arrays
            count as lists.

        Returns
        -------
        Task
            Task of the mapping.

        Raises
        ------
        FileError
            If a value is invalid; it lists all faults with their keys.
        TypeError
            If the mapping contains other types than a file.

        Examples
        --------
        >>> stricter = pushplan.Task.from_dict({**task.to_dict(), "robustness": 0.9})
        """
    @property
    def name(self) -> str:
        """Name of the task."""
    @property
    def description(self) -> str:
        """Description for people, one line; may be empty."""
    @property
    def objects(self) -> list[str]:
        """Names of the objects, in the order of arrays of poses."""
    @property
    def start(self) -> _Floats:
        """Poses of the objects at the start, `[objects, 3]`: x and y in metres, heading in radians."""
    @property
    def tools(self) -> list[str] | None:
        """Names of the tools to choose from; `None` stands for the whole library."""
    @property
    def goal_object(self) -> str:
        """Name of the object of the first goal."""
    @property
    def goal_objects(self) -> list[str]:
        """Names of the objects with goals, in the order of the goals."""
    @property
    def goal_position(self) -> tuple[float, float]:
        """Position of the first goal, metres, with all objects at the start."""
    @property
    def tolerance(self) -> float:
        """Maximum distance from the first goal that counts as success, metres."""
    @property
    def goal_heading(self) -> float | None:
        """Heading of the first goal, radians; `None` if it states none."""
    @property
    def heading_tolerance(self) -> float | None:
        """Maximum heading error that counts as success, radians; `None` without a heading."""
    @property
    def grip_yaws(self) -> list[float]:
        """Allowed rotations of the end effector against world +x, radians."""
    @property
    def push_length(self) -> float:
        """Default travel of a push, metres."""
    @property
    def push_speed(self) -> float:
        """Default speed of a push, m/s."""
    @property
    def max_pushes(self) -> int:
        """Maximum number of pushes in a plan."""
    @property
    def reach(self) -> tuple[float, float]:
        """Minimum and maximum distance of the end effector from the robot's base, metres."""
    @property
    def robustness(self) -> float:
        """Minimum share of the perturbed replays that must reach the goal, 0 to 1."""
    def at(self, poses: npt.ArrayLike) -> Task:
        """Returns the task with other initial poses, for planning from the current state.

        Joints move with their objects.

        Parameters
        ----------
        poses : array_like, `[objects, 3]`
            Poses of the objects: x and y in metres, heading in radians.

        Returns
        -------
        Task
            Task with these poses.

        Raises
        ------
        TypeError or ValueError
            If the array has another type or shape, a number is not finite, an object is more than
            2 m beyond the reach, or a heading is beyond 8 pi.

        Examples
        --------
        >>> seen = task.start + [0.01, 0.0, 0.1]
        >>> solution = pushplan.solve(task.at(seen), effort="draft")
        """
    def score(self, poses: npt.ArrayLike) -> float:
        """Returns the largest error of all goals in units of their tolerances; at most 1 is success.

        Parameters
        ----------
        poses : array_like, `[objects, 3]`
            Poses of the objects at rest: x and y in metres, heading in radians.
        """
    def reached(self, poses: npt.ArrayLike) -> list[bool]:
        """Returns for each goal whether the objects reach it at these poses, at rest.

        Parameters
        ----------
        poses : array_like, `[objects, 3]`
            Poses of the objects: x and y in metres, heading in radians.
        """
    def goal_subjects(self, poses: npt.ArrayLike) -> list[str]:
        """Returns for each goal the name of the object to which its error refers.

        A goal may allow several objects; the error then refers to the object that misses the goal.

        Parameters
        ----------
        poses : array_like, `[objects, 3]`
            Poses of the objects at rest: x and y in metres, heading in radians.
        """
    def goal_offsets(self, poses: npt.ArrayLike) -> _Floats:
        """Returns the offsets of the objects from their goals.

        Parameters
        ----------
        poses : array_like, `[objects, 3]`
            Poses of the objects at rest: x and y in metres, heading in radians.

        Returns
        -------
        ndarray, `[goals, 3]`
            Offset from the nearest goal position to the object, x and y in metres, and rotation
            from the goal heading, radians. Values without a criterion in the goal are 0.
        """
    def to_dict(self) -> TaskFile:
        """Returns the task with the keys of a task file, for `Task.from_dict`."""
    def to_yaml(self) -> str:
        """Returns the text of a task file (YAML)."""
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Push:
    """Straight push of the end effector.

    Parameters
    ----------
    start : sequence of float or None
        Position of the end effector at the start, `[x, y]` in metres. With `None` the push starts
        where the last one ended, or at the robot's home (chained pushes only).
    direction : float
        Direction of travel, radians from world +x, -4 pi to 4 pi.
    length : float, optional
        Travel, metres, above 0 and at most 2; by default the task's.
    speed : float, optional
        Speed, m/s, above 0 and at most 2; by default the task's.

    Raises
    ------
    TypeError or ValueError
        If an argument is no number, not finite or out of range.

    Examples
    --------
    >>> pushplan.Push([0.47, 0.02], math.pi, length=0.2)
    >>> pushplan.Push.before("can", math.pi, length=0.2)
    """
    def __new__(
        cls,
        start: Sequence[float] | _Floats | None,
        direction: float,
        length: float | None = None,
        speed: float | None = None,
    ) -> Push: ...
    @staticmethod
    def before(
        object: str,
        direction: float,
        offset: float = 0.0,
        length: float | None = None,
        speed: float | None = None,
    ) -> Push:
        """Creates a push that starts just before an object.

        Parameters
        ----------
        object : str
            Name of the object.
        direction : float
            Direction of travel, radians from world +x, -4 pi to 4 pi.
        offset : float, default 0
            Lateral offset of the object's centre from the centre line of the tool's face, metres,
            positive to the left.
        length : float, optional
            Travel, metres; by default the task's.
        speed : float, optional
            Speed, m/s; by default the task's.

        Returns
        -------
        Push
            Push whose start follows from the tool and the pose of the object.

        Raises
        ------
        TypeError or ValueError
            If an argument is no number, not finite or out of range.

        Examples
        --------
        >>> push = pushplan.Push.before("can", math.pi, length=0.15)
        """
    @property
    def start(self) -> tuple[float, float] | None:
        """Position of the end effector at the start, metres; `None` if the push does not state it."""
    @property
    def object(self) -> str | None:
        """Object before which the push starts; `None` unless `Push.before` created it."""
    @property
    def offset(self) -> float | None:
        """Lateral offset of `object`, metres; `None` unless `Push.before` created the push."""
    @property
    def direction(self) -> float:
        """Direction of travel, radians from world +x."""
    @property
    def length(self) -> float | None:
        """Travel, metres; `None` stands for the task's length."""
    @property
    def speed(self) -> float | None:
        """Speed, m/s; `None` stands for the task's speed."""
    def __eq__(self, other: Any, /) -> bool: ...
    def __ne__(self, other: Any, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Trajectory:
    """Motion of objects and tool under one model, frame by frame until all objects rest."""
    @property
    def model(self) -> str:
        """Name of the model that computed the motion."""
    @property
    def objects(self) -> list[str]:
        """Names of the objects, in the order of `poses`."""
    @property
    def times(self) -> _Floats:
        """Time of every frame since the start, seconds: `[frames]`."""
    @property
    def poses(self) -> _Floats:
        """Poses of all objects, `[frames, objects, 3]`: x and y in metres, heading in radians.
        Headings are continuous, without wrapping at pi.
        """
    @property
    def space(self) -> _Floats | None:
        """3-D poses of all objects, `[frames, objects, 7]`: x, y and z in metres, and the quaternion
        x, y, z, w. `None` if no object leaves the plane.
        """
    @property
    def raised(self) -> list[float]:
        """Rise of the levered edge at the end of each lever-up, metres."""
    @property
    def tool_poses(self) -> _Floats:
        """Poses of the tool frame, `[frames, 3]`: x and y in metres, heading in radians."""
    @property
    def error(self) -> float:
        """Final distance of the goal's object from the goal, metres."""
    @property
    def heading_error(self) -> float | None:
        """Final heading error, radians; `None` if the goal states no heading."""
    @property
    def reached(self) -> bool:
        """Whether the objects rest at the goal and no failure occurred before, such as a fall."""
    @property
    def warnings(self) -> list[str]:
        """Warnings about the reliability of the motion."""
    def __len__(self) -> int: ...
    @staticmethod
    def parse(text: str) -> Trajectory:
        """Restores a trajectory from the text that pickle stores."""
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Plan:
    """Plan of pushes or lever-ups for a task, with its prediction and verdict.

    A plan contains its task and its tools, so that prediction, verification and export need no
    other file. Instances come from `solve`, `Plan.load`, `Plan.parse` and `Plan.of`.
    """
    def __new__(cls, *_arguments: Never, **_named: Never) -> Plan: ...
    @staticmethod
    def load(path: _Path) -> Plan:
        """Reads a plan file (JSON).

        Parameters
        ----------
        path : str or path-like
            Plan file, written by `Plan.save` or by the command `pushplan solve`.

        Returns
        -------
        Plan
            Plan of the file, with its verdict.

        Raises
        ------
        FileError
            If the file is unreadable or invalid; it lists all faults.

        Examples
        --------
        >>> plan.save("best.plan.json")
        >>> verdict = pushplan.verify(pushplan.Plan.load("best.plan.json"))
        """
    @staticmethod
    def parse(text: str, name: str = "plan") -> Plan:
        """Reads the text of a plan file.

        Parameters
        ----------
        text : str
            Content of the file (JSON).
        name : str, default "plan"
            File name in error messages.

        Returns
        -------
        Plan
            Plan of the text, with its verdict.

        Raises
        ------
        FileError
            If the text is invalid; it lists all faults.
        """
    @staticmethod
    def of(
        task: Task,
        tool: Tool | str,
        pushes: Sequence[Push],
        *,
        grip_yaw: float | None = None,
        tools: ToolLibrary | None = None,
    ) -> Plan:
        """Builds a plan from given pushes, without a search.

        Parameters
        ----------
        task : Task
            Task of the plan.
        tool : Tool or str
            Tool, or the name of a tool in `tools`.
        pushes : sequence of Push
            Pushes, in order. A push that violates a rule of the task is allowed; see `violations`.
        grip_yaw : float, optional
            Rotation of the end effector against world +x, radians, -4 pi to 4 pi; by default the
            first grip yaw of the task with which the pushes are feasible.
        tools : ToolLibrary, optional
            Tools for a name in `tool`; by default the tools shipped with the package.

        Returns
        -------
        Plan
            Plan without prediction and verdict.

        Raises
        ------
        ActionError
            If a push is infeasible, for example because the object is unknown; `UnknownToolError`
            for an unknown name in `tool`.
        TypeError or ValueError
            If another argument has an invalid type or value.

        Examples
        --------
        >>> push = pushplan.Push.before("can", math.pi, length=0.15)
        >>> plan = pushplan.Plan.of(task, "l-hook", [push])
        """
    @property
    def task(self) -> Task:
        """Task of the plan."""
    @property
    def tool(self) -> Tool:
        """First tool of the plan. Raises `ValueError` for a plan without steps."""
    @property
    def tools(self) -> list[Tool]:
        """Tools in the order of their use."""
    @property
    def steps(self) -> list[dict[str, Any]]:
        """Steps in order, with the keys of a plan file: `{"push": ...}` or `{"lever_up": ...}`."""
    @property
    def levers(self) -> bool:
        """Whether the plan contains a lever-up."""
    @property
    def pushes(self) -> list[Push]:
        """Pushes in order."""
    @property
    def push_array(self) -> _Floats:
        """Pushes for `rollout`, `[pushes, 5]`: x and y of the end effector at the start (metres),
        direction (radians from world +x), length (metres) and speed (m/s).
        """
    @property
    def grip_yaw(self) -> float:
        """Rotation of the end effector against world +x, radians."""
    @property
    def form(self) -> Literal["placed", "chained"]:
        """Form of the pushes. `"placed"`: the robot lifts the tool after each push and sets it down
        for the next; `"chained"`: each push starts where the last one ended.
        """
    @property
    def lift(self) -> float:
        """Height of the tool's underside above the table, metres."""
    @property
    def model(self) -> str | None:
        """Name of the effect model of the prediction; `None` without a prediction."""
    @property
    def fit(self) -> TableFit | None:
        """Table fit that the model used; `None` without one."""
    @property
    def error(self) -> float | None:
        """Predicted distance of the goal's object from the goal, metres; `None` without one."""
    @property
    def trajectory(self) -> Trajectory | None:
        """Predicted motion, frame by frame; `None` unless the plan comes from `solve`."""
    @property
    def verdict(self) -> Verdict | None:
        """Verdict of the replays; `None` for a plan without verification."""
    @property
    def violations(self) -> list[str]:
        """Rules of the task that the pushes violate. Plans from `solve` violate none."""
    def graph(self, frame: int) -> dict[str, Any] | None:
        """Returns the input graph of the network for one frame of `trajectory`.

        Parameters
        ----------
        frame : int
            Index of the frame; the graph describes the step from `frame` to `frame + 1`.

        Returns
        -------
        dict or None
            Dictionary with `nodes` and `relations`. Nodes are objects, obstacles and parts of the
            tool, each with name, kind, pose, size and motion. Relations are contacts and joints
            between nodes, which they name by index. `None` past the last frame, without a
            prediction, and for plans with lever-ups or several tools.
        """
    def save(self, path: _Path) -> None:
        """Writes the plan file (JSON) for `Plan.load` and the command `pushplan verify`.

        The file is replaced as a whole, so that no partial file remains after an error.

        Parameters
        ----------
        path : str or path-like
            File to write, in an existing folder.

        Raises
        ------
        FileError
            If the file cannot be written.
        """
    def to_dict(self) -> dict[str, Any]:
        """Returns the plan with the keys of a plan file."""
    def to_mjcf(self) -> str:
        """Returns a MuJoCo scene (MJCF text) with the objects, the tool, the pushes and the goal."""
    def page(self) -> str:
        """Returns the interactive report of the plan: one HTML file that plays the replays offline.

        Replays that the plan lacks are computed first.
        """
    def _repr_html_(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Replay:
    """Replay of a plan in one engine."""
    @property
    def engine(self) -> Literal["planar", "3d"]:
        """Engine of the replay: `"planar"` (2-D) or `"3d"`."""
    @property
    def draw(self) -> int | None:
        """Number of the perturbation, from 1, equal in both engines; `None` for a nominal replay."""
    @property
    def error(self) -> float:
        """Final distance of the goal's object from the goal, metres."""
    @property
    def heading_error(self) -> float | None:
        """Final heading error, radians; `None` if the goal states no heading."""
    @property
    def reached(self) -> bool:
        """Whether the objects rest at the goal and no failure occurred before, such as a fall."""
    @property
    def poses(self) -> _Floats:
        """Final poses of all objects, `[objects, 3]`: x and y in metres, heading in radians."""
    @property
    def force(self) -> float | None:
        """Largest sustained force of the tool, newtons, to within a factor of two; `None` if unknown."""
    @property
    def warnings(self) -> list[str]:
        """Warnings of the replay, such as a toppled object."""
    @property
    def trajectory(self) -> Trajectory | None:
        """Motion, frame by frame; `None` for a perturbed replay."""

@final
class Verdict:
    """Verdict on a plan after nominal and perturbed replays in the 2-D and the 3-D engine."""
    @property
    def passed(self) -> bool:
        """Whether the plan violates no rule of its task and its nominal replays in both engines reach
        the goal at rest. The required share of the perturbed replays must also reach it.
        """
    @property
    def nominal_ok(self) -> bool:
        """Whether the nominal replays reach the goal, even if too few perturbed replays do."""
    @property
    def robustness(self) -> float | None:
        """Share of the perturbed replays that reach the goal, 0 to 1, in the engine with the lower
        share; `None` without perturbed replays.
        """
    @property
    def reason(self) -> str:
        """Verdict with its reason, one sentence."""
    @property
    def warnings(self) -> list[str]:
        """Warnings of the nominal replays."""
    @property
    def replays(self) -> list[Replay]:
        """Replays, the nominal ones first."""
    def to_dict(self) -> dict[str, Any]:
        """Returns the verdict with the keys of `pushplan verify --json`."""
    def page(self) -> str:
        """Returns the interactive report: one HTML file that plays the replays offline."""
    def _repr_html_(self) -> str: ...
    @staticmethod
    def parse(text: str) -> Verdict:
        """Restores a verdict from the text that pickle stores."""
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Solution:
    """Result of `solve`: status, ranked plans and statistics of the search."""
    @property
    def status(self) -> _Status:
        """Status of the solution.

        - `"solved"`: the first plan passes verification.
        - `"fragile"`: the first plan passes its nominal replays, but too few perturbed replays.
        - `"partial"`: the first plan passes for some of several goals.
        - `"no_plan"`: no candidate comes near enough to the goal; the first plan is the nearest.
        - `"failed_verification"`: every plan that the planner replayed was rejected.
        """
    @property
    def solved(self) -> bool:
        """Whether the first plan passes verification."""
    @property
    def timed_out(self) -> bool:
        """Whether the time limit ended the search early; the plans are then the best found so far."""
    @property
    def best(self) -> Plan | None:
        """Plan to use: the verified plan if solved, otherwise the nearest one. `None` only if no push
        is feasible.
        """
    @property
    def plans(self) -> list[Plan]:
        """Ranked plans, best first."""
    @property
    def task(self) -> Task:
        """Task of the solution."""
    @property
    def warnings(self) -> list[str]:
        """Warnings about the predictions of the first plan, most useful first."""
    @property
    def cause(self) -> str | None:
        """Cause of a missing or failed plan and its remedy; `None` if there is a plan or no cause was
        found.
        """
    def to_dict(self) -> dict[str, Any]:
        """Returns the solution with the keys of `pushplan solve --json`; times are wall-clock
        seconds.
        """
    def page(self) -> str:
        """Returns the interactive report: one HTML file that plays the plans offline. It also states
        why the planner rejected other plans.
        """
    def _repr_html_(self) -> str: ...
    @staticmethod
    def parse(text: str) -> Solution:
        """Restores a solution from the text that pickle stores."""
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Design:
    """Result of `design`: the proposed tool, and the solution with the existing tools."""
    @property
    def status(self) -> _Status:
        """Status with the proposed tool, or with the existing tools if there is no proposal; see
        `Solution.status` for the values.
        """
    @property
    def tool(self) -> Tool | None:
        """Proposed tool; the nearest one if no tool solves the task. `None` if no proposal is better
        than the existing tools.
        """
    @property
    def solution(self) -> Solution | None:
        """Solution with the proposed tool; `None` without a proposal."""
    @property
    def known(self) -> Solution:
        """Solution with all existing tools, also with tools that the task does not name."""
    def to_dict(self) -> dict[str, Any]:
        """Returns the design with the keys of `pushplan design --json`; times are wall-clock
        seconds.
        """

@final
class Rollouts:
    """Arrays of the rollouts of many candidates.

    Candidates take different numbers of frames. A shorter candidate repeats its last frame, in
    which all objects rest.
    """
    @property
    def poses(self) -> _Floats:
        """Poses of all objects, `[candidates, frames, objects, 3]`: x and y in metres, heading in
        radians. Headings are continuous, without wrapping at pi.
        """
    @property
    def tool_poses(self) -> _Floats:
        """Poses of the tool frame, `[candidates, frames, 3]`: x and y in metres, heading in radians."""
    @property
    def times(self) -> _Floats:
        """Time of every frame since the start, seconds: `[candidates, frames]`."""
    @property
    def frames(self) -> npt.NDArray[np.int64]:
        """Number of frames of each candidate: `[candidates]`."""
    @property
    def errors(self) -> _Floats:
        """Final distance of the goal's object from the goal, metres: `[candidates]`."""
    @property
    def heading_errors(self) -> _Floats:
        """Final heading error, radians, NaN if the goal states no heading: `[candidates]`."""
    @property
    def reached(self) -> npt.NDArray[np.bool_]:
        """Whether the objects rest at the goal and no failure occurred before: `[candidates]`."""
    @property
    def objects(self) -> list[str]:
        """Names of the objects, in the order of `poses`."""
    @property
    def warnings(self) -> list[list[str]]:
        """Warnings about each candidate's rollout: one list per candidate."""
    def __len__(self) -> int: ...

@final
class Recording:
    """Recording of one scene: poses of pusher and objects, frame by frame."""
    def __new__(cls, *_arguments: Never, **_named: Never) -> Recording: ...
    @staticmethod
    def load(path: _Path) -> Recording:
        """Reads a recording file (YAML, or JSON if the name ends in `.json`).

        Parameters
        ----------
        path : str or path-like
            Recording file.

        Returns
        -------
        Recording
            Recording of the file.

        Raises
        ------
        FileError
            If the file is unreadable or invalid; it lists all faults.

        Examples
        --------
        >>> recording = pushplan.Recording.load("pushes.json")
        """
    @staticmethod
    def parse(text: str, name: str = "recording") -> Recording:
        """Reads the text of a recording file.

        Parameters
        ----------
        text : str
            Content of the file (YAML, or JSON if `name` ends in `.json`).
        name : str, default "recording"
            File name in error messages.

        Returns
        -------
        Recording
            Recording of the text.

        Raises
        ------
        FileError
            If the text is invalid; it lists all faults.
        """
    @staticmethod
    def from_dict(mapping: dict[str, Any]) -> Recording:
        """Builds a recording from a mapping with the keys of a recording file.

        Parameters
        ----------
        mapping : dict
            Mapping with the keys of `recording_schema`. NumPy arrays count as lists.

        Returns
        -------
        Recording
            Recording of the mapping.

        Raises
        ------
        FileError
            If a value is invalid; it lists all faults with their keys.
        TypeError
            If the mapping contains other types than a file.
        """
    @property
    def name(self) -> str:
        """Name of the recording."""
    @property
    def objects(self) -> list[str]:
        """Names of the objects, in the order of arrays of poses."""
    @property
    def times(self) -> _Floats:
        """Time of every frame since the first, seconds: `[frames]`."""
    @property
    def poses(self) -> _Floats:
        """Poses of the objects, `[frames, objects, 3]`: x and y in metres, heading in radians."""
    @property
    def velocities(self) -> _Floats:
        """Velocities of the objects in the first frame, `[objects, 3]`: x and y in m/s, rotation in
        rad/s.
        """
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Belief:
    """Belief about joints between objects: probabilities of the joint types of every pair."""
    joint_types: tuple[str, str, str, str]
    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Pairs of objects within 3 cm of each other at the start, by name. Other pairs are assumed to
        have no joint.
        """
    @property
    def probabilities(self) -> _Floats:
        """Probabilities of `joint_types` for every pair of `pairs`: `[pairs, 4]`."""
    def scene(self) -> dict[str, Any]:
        """Returns the final scene with the most probable joints, with the keys of `scene` in a task
        file.
        """
    def to_dict(self) -> dict[str, Any]:
        """Returns the belief with the keys of `pushplan infer --json`."""

@final
class Motion:
    """Motion that a world executes. The robot sets the tool down at the start of the first stroke,
    moves it along all strokes, waits until the objects rest, and lifts it.
    """
    @property
    def tool(self) -> Tool:
        """Tool of the motion."""
    @property
    def lift(self) -> float:
        """Height of the tool's underside above the table, metres."""
    @property
    def end_effector(self) -> _Floats:
        """Poses of the end effector at start and end of every stroke, `[strokes, 6]`: x, y (metres),
        heading (radians), x, y, heading.
        """
    @property
    def tool_frame(self) -> _Floats:
        """Poses of the tool frame, in the format of `end_effector`."""
    @property
    def durations(self) -> list[float]:
        """Duration of each stroke, seconds."""

@type_check_only
class _World(Protocol):
    def look(self) -> npt.ArrayLike: ...
    def act(self, motion: Motion, /) -> Iterable[tuple[float, npt.ArrayLike]]: ...

@final
class Run:
    """Record of a closed-loop run: observations, beliefs, plans and pushes."""
    @staticmethod
    def parse(text: str) -> Run:
        """Restores a run from the text that pickle stores."""
    def __eq__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def end(self) -> Literal["reached", "budget_exhausted", "no_improving_push", "rule_broken"]:
        """Reason for the end: `"reached"`, `"budget_exhausted"` (all allowed pushes are made),
        `"no_improving_push"` (no push brings the object nearer to the goal) or `"rule_broken"` (an
        object breaks `keep` or `keep_out`).
        """
    @property
    def reached(self) -> bool:
        """Whether the goal is reached according to the observations."""
    @property
    def pushes(self) -> list[Push]:
        """Executed pushes in order."""
    @property
    def poses(self) -> _Floats:
        """Final poses in the belief, `[objects, 3]`: x and y in metres, heading in radians."""
    @property
    def fit(self) -> TableFit | None:
        """Table fit after the run; `None` without one, for example with `unknown` values."""
    @property
    def notes(self) -> list[str]:
        """Notes about inconsistent observations and motions that ended early, one sentence each."""
    def save(self, path: _Path) -> None:
        """Writes the trace of the run (`*.run.json`).

        The file is replaced as a whole, so that no partial file remains after an error.

        Parameters
        ----------
        path : str or path-like
            File to write, in an existing folder.

        Raises
        ------
        FileError
            If the file cannot be written.
        """
    def to_dict(self) -> dict[str, Any]:
        """Returns the run with the keys of its trace."""
    def page(self) -> str:
        """Returns the interactive report: one HTML file that plays the run offline."""
    def _repr_html_(self) -> str: ...

def run(
    task: Task,
    world: int | _World,
    tools: ToolLibrary | None = None,
    *,
    effort: _Effort = "draft",
    model: str | None = None,
    out_of_range: _OutOfRange = "warn",
    seed: int = 0,
    max_pushes: int = 12,
    samples: int = 16,
    min_success: float = 0.8,
    max_probes: int = 3,
    noise: tuple[float, float] | None = None,
    fit: TableFit | None = None,
    regulator: bool = True,
    threads: int = 0,
    progress: _Progress = None,
) -> Run:
    """Carries out a task in closed loop: plans, pushes, observes, updates its belief and plans again.

    Parameters
    ----------
    task : Task
        Task; its `unknown` values are estimated during the run.
    world : int or object
        Seed of a simulated world with hidden ground truth, or an object with these methods:
        `look()` returns the observed poses at rest, `[objects, 3]`: x and y in metres, heading in
        radians, NaN for a number without observation. `act(motion)` executes a `Motion` and returns
        pairs of a time since its start, seconds, and such an array; the last one is at rest. The
        optional `change_tool(tool)` is called before a motion with another tool.
    tools, effort, model, out_of_range, seed, threads
        Options of the planner, see `solve`.
    max_pushes : int, default 12
        Maximum number of pushes, at most 1000.
    samples : int, default 16
        Number of belief samples in which plans are evaluated, 1 to 1000.
    min_success : float, default 0.8
        Minimum share of the samples in which a plan must reach the goal, 0 to 1. Such a plan needs
        no exploratory pushes.
    max_probes : int, default 3
        Maximum number of exploratory pushes.
    noise : tuple of float, optional
        Standard deviations of the observations, metres and radians.
    fit : TableFit, optional
        Table fit of this table; the pushes of the run continue the fit.
    regulator : bool, default True
        Whether the belief regulator corrects the probabilities of joints.
    progress : bool or callable, optional
        Receiver of the stage and the number of executed motions, see `solve`.

    Returns
    -------
    Run
        Outcome, pushes and final belief.

    Raises
    ------
    TypeError or ValueError
        If an argument is invalid. The function also raises the errors of `solve` and any
        exception of `world`, which ends the run.

    Examples
    --------
    >>> task = pushplan.Task.example("hidden-hinge")
    >>> ran = pushplan.run(task, 1)
    >>> print(ran.end, len(ran.pushes))
    """
def solve(
    task: Task,
    tools: ToolLibrary | None = None,
    *,
    effort: _Effort = "standard",
    model: str | None = None,
    out_of_range: _OutOfRange = "warn",
    seed: int = 0,
    replays: int | None = None,
    robustness: float | None = None,
    time_limit: float | None = None,
    fit: TableFit | None = None,
    threads: int = 0,
    progress: _Progress = None,
) -> Solution:
    """Chooses a tool and pushes that solve a task, and verifies the plans.

    Parameters
    ----------
    task : Task
        Task to solve.
    tools : ToolLibrary, optional
        Tools to choose from; by default the tools shipped with the package.
    effort : {"draft", "standard", "thorough"}, default "standard"
        Size of the search.
    model : str, optional
        Effect model, such as "network", "prior" (the analytic model), "planar" or "3d". By default
        the model of the effort.
    out_of_range : {"warn", "simulate", "refuse"}, default "warn"
        Action outside the model's validity range: add a warning, simulate in 2-D instead, or raise
        `RefusedError`.
    seed : int, default 0
        Seed of the samples of refinement and of the perturbations.
    replays : int, optional
        Minimum number of perturbed replays of the winning plan in each engine, at most 100000; by
        default the effort's. The planner adds replays until the verdict is clear.
    robustness : float, optional
        Minimum share of the perturbed replays that must reach the goal, 0 to 1; by default the
        task's.
    time_limit : float, optional
        Maximum duration, seconds. The planner then returns the best plans found so far.
    fit : TableFit, optional
        Table fit from pushes recorded on this table.
    threads : int, default 0
        Number of worker threads, at most 1024; 0 means one per core. No result depends on it.
    progress : bool or callable, optional
        Function that is called with a `Progress` while the planner works, or True for a line on
        stderr, if that is a terminal. Progress changes no result.

    Returns
    -------
    Solution
        Status and ranked plans. A missing plan is not an error, see `Solution.status`.

    Raises
    ------
    FileError
        If the task names a tool that `tools` lacks.
    TaskError
        If a value of the task is invalid.
    ModelError
        If `model` is not the name of an effect model.
    RefusedError
        If `out_of_range` is "refuse" and the task is outside the model's validity range.
    TypeError or ValueError
        If another argument has an invalid type or value.

    Examples
    --------
    >>> task = pushplan.Task.example("pull-back-behind-wall")
    >>> solution = pushplan.solve(task, effort="draft", progress=True)
    >>> print(solution.status, solution.best)
    """
def solve_all(
    tasks: Sequence[Task],
    tools: ToolLibrary | None = None,
    *,
    effort: _Effort = "standard",
    model: str | None = None,
    out_of_range: _OutOfRange = "warn",
    seed: int = 0,
    replays: int | None = None,
    robustness: float | None = None,
    time_limit: float | None = None,
    fit: TableFit | None = None,
    threads: int = 0,
    progress: _Progress = None,
) -> list[Solution]:
    """Solves several tasks in parallel, with the results of `solve` for each task.

    Parameters
    ----------
    tasks : sequence of Task
        Tasks to solve.
    tools, effort, model, out_of_range, seed, replays, robustness, time_limit, fit, threads
        Options for every task, see `solve`.
    progress : bool or callable, optional
        Receiver of the number of solved tasks, see `solve`.

    Returns
    -------
    list of Solution
        Solutions in the order of the tasks.

    Raises
    ------
    PushplanError, TypeError or ValueError
        For the first task that `solve` would reject, or an invalid argument.

    Examples
    --------
    >>> tasks = [task.at(task.start + [0.01 * k, 0.0, 0.0]) for k in range(3)]
    >>> solutions = pushplan.solve_all(tasks, effort="draft", progress=True)
    >>> print(sum(solution.solved for solution in solutions))
    """
def design(
    task: Task,
    tools: ToolLibrary | None = None,
    *,
    parts: int = 3,
    candidates: int = 1000,
    effort: _Effort = "standard",
    seed: int = 0,
    time_limit: float | None = None,
    threads: int = 0,
    progress: _Progress = None,
) -> Design:
    """Proposes a tool of cuboids for a pushing task.

    The tool solves a task that no tool of `tools` solves, or solves it with a larger margin. Its
    plan is verified like any other.

    Parameters
    ----------
    task : Task
        Task that the tool should solve.
    tools : ToolLibrary, optional
        Existing tools; by default the tools shipped with the package.
    parts : int, default 3
        Maximum number of parts of the tool.
    candidates : int, default 1000
        Number of screened tools, 1 to 1000000.
    time_limit : float, optional
        Seconds after which the best proposal so far is returned.
    effort, seed, threads
        Options of the planner, see `solve`.
    progress : bool or callable, optional
        Receiver of the stage and the number of screened tools, see `solve`.

    Returns
    -------
    Design
        Proposal, and the solution with the existing tools.

    Raises
    ------
    FileError, TaskError, TypeError or ValueError
        If the task or an argument is invalid.

    Examples
    --------
    >>> design = pushplan.design(task, candidates=200)
    >>> if design.tool is not None:
    ...     tools = pushplan.ToolLibrary.shipped().with_tool(design.tool)
    """
def predict(
    plan: Plan, model: str = "network", *, out_of_range: _OutOfRange = "warn", threads: int = 0
) -> Trajectory:
    """Predicts the motion of the objects under a plan, frame by frame.

    Parameters
    ----------
    plan : Plan
        Plan to predict. A table fit of the plan applies if `model` is the plan's own model.
    model : str, default "network"
        Effect model, such as "network", "prior" (the analytic model), "planar" or "3d".
    out_of_range : {"warn", "simulate", "refuse"}, default "warn"
        Action outside the model's validity range, see `solve`.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Returns
    -------
    Trajectory
        Predicted motion, with the warnings of the model.

    Raises
    ------
    ModelError
        If `model` is not the name of an effect model.
    RefusedError
        If `out_of_range` is "refuse" and the plan is outside the model's validity range.
    TypeError or ValueError
        If another argument has an invalid value.

    Examples
    --------
    >>> trajectory = pushplan.predict(plan, "3d")
    >>> print(trajectory.poses.shape, trajectory.reached)
    """
def verify(
    plan: Plan,
    *,
    replays: int = 8,
    seed: int = 0,
    robustness: float | None = None,
    time_limit: float | None = None,
    threads: int = 0,
) -> Verdict:
    """Verifies a plan by nominal and perturbed replays in the 2-D and the 3-D engine.

    Perturbed replays have small errors of starts, frictions, support and contact height. The
    verifier adds replays until the verdict is clear.

    Parameters
    ----------
    plan : Plan
        Plan to verify.
    replays : int, default 8
        Minimum number of perturbed replays in each engine, at most 100000.
    seed : int, default 0
        Seed of the perturbations.
    robustness : float, optional
        Minimum share of the perturbed replays that must reach the goal, 0 to 1; by default the
        task's.
    time_limit : float, optional
        Maximum duration, seconds. Replays that are unfinished then do not pass.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Returns
    -------
    Verdict
        Verdict with all replays.

    Raises
    ------
    TypeError or ValueError
        If an argument has an invalid value.

    Examples
    --------
    >>> verdict = pushplan.verify(solution.best, replays=32)
    >>> print(verdict.passed, verdict.robustness)
    """
def rollout(
    task: Task,
    tool: Tool | str,
    pushes: npt.ArrayLike,
    *,
    grip_yaw: npt.ArrayLike | None = None,
    start: npt.ArrayLike | None = None,
    model: str = "network",
    out_of_range: _OutOfRange = "warn",
    record: Literal["frames", "outcome"] = "frames",
    tools: ToolLibrary | None = None,
    threads: int = 0,
) -> Rollouts:
    """Predicts many candidates with one tool, and returns the results as arrays.

    Parameters
    ----------
    task : Task
        Task with the scene and the goal.
    tool : Tool or str
        Tool, or the name of a tool in `tools`.
    pushes : array_like, `[candidates, pushes, 5]` or `[candidates, 5]`
        Pushes of every candidate, such as `Plan.push_array`: x and y of the end effector at the
        start (metres), direction (radians from world +x), length (metres) and speed (m/s).
    grip_yaw : float or array_like, `[candidates]`, default 0
        Rotation of the end effector against world +x, radians.
    start : array_like, `[objects, 3]` or `[candidates, objects, 3]`, optional
        Poses of the objects at the start, at rest: x and y in metres, heading in radians. By
        default the poses of the task.
    model : str, default "network"
        Effect model, such as "network", "prior" (the analytic model), "planar" or "3d".
    out_of_range : {"warn", "simulate", "refuse"}, default "warn"
        Action outside the model's validity range: add a warning, simulate in 2-D instead, or return
        no prediction, with a warning.
    record : {"frames", "outcome"}, default "frames"
        Recorded frames: all of them, or only the last one.
    tools : ToolLibrary, optional
        Tools for a name in `tool`; by default the tools shipped with the package.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Returns
    -------
    Rollouts
        Poses, times and errors of all candidates.

    Raises
    ------
    UnknownToolError
        If `tools` contains no tool named `tool`.
    ModelError
        If `model` is not the name of an effect model.
    TypeError or ValueError
        If an argument has an invalid type, shape or value.

    Examples
    --------
    >>> pushes = np.array([[0.47, 0.02, 3.14, 0.20, 0.10], [0.47, 0.02, 3.14, 0.05, 0.10]])
    >>> rolled = pushplan.rollout(task, "l-hook", pushes, record="outcome")
    >>> best = pushes[rolled.errors.argmin()]
    """
def fit(recordings: Sequence[Recording], *, threads: int = 0) -> TableFit:
    """Fits friction, support and the network's last layer to recorded pushes.

    Fifty or more pushes of one object give the best results.

    Parameters
    ----------
    recordings : sequence of Recording
        Recordings of one table.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Returns
    -------
    TableFit
        Fit for `solve` and `run`.

    Raises
    ------
    TypeError or ValueError
        If an argument is invalid, or no object moves in the recordings.

    Examples
    --------
    >>> recordings = [pushplan.Recording.load("pushes.json")]
    >>> solution = pushplan.solve(task, fit=pushplan.fit(recordings), effort="draft")
    """
def infer(
    recording: Recording,
    *,
    model: str = "prior",
    noise: float = 0.001,
    heading_noise: float = 0.01,
    mass_ranges: Sequence[tuple[float, float]] | None = None,
    threads: int = 0,
) -> Belief:
    """Infers joints between objects, and optionally ranges of their masses, from a recording.

    Joints that the recording states are ignored.

    Parameters
    ----------
    recording : Recording
        Recorded pushes.
    model : str, default "prior"
        Effect model that predicts every hypothesis; "prior" is the analytic model.
    noise : float, default 0.001
        Standard deviation of the recorded positions, metres, 0 to 0.5.
    heading_noise : float, default 0.01
        Standard deviation of the recorded headings, radians, 0 to 0.5.
    mass_ranges : sequence of tuple of float, optional
        Candidate ranges of masses, kg, lightest first, such as `[(0.2, 0.5), (1, 2)]`. The belief
        then states the range of every object that another object touched, and stated masses are
        ignored.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Returns
    -------
    Belief
        Probabilities of the joint types of every pair, and of the mass ranges.

    Raises
    ------
    ModelError
        If `model` is not the name of an effect model.
    TypeError or ValueError
        If another argument has an invalid type or value.

    Examples
    --------
    >>> belief = pushplan.infer(pushplan.Recording.load("pushes.json"))
    >>> print(belief.pairs, belief.probabilities)
    """
def main(arguments: Sequence[str]) -> int:
    """Runs a command line and returns its exit code. The first argument is the program's name. Ctrl-C
    is then handled by the command.
    """
def allow_files_in(folder: _Path) -> None:
    """Allows the URDF files of arms to name meshes in and below a folder, until the process ends.

    Otherwise, meshes must be in or below the folder of the URDF. A task cannot allow a folder,
    because tasks may come from other people.

    Parameters
    ----------
    folder : str or path-like
        Folder, such as the one that contains the packages named by `package://`.

    Examples
    --------
    >>> pushplan.allow_files_in("ros/share")
    """
def import_tool(
    path: _Path,
    *,
    body: str | None = None,
    name: str | None = None,
    friction: float = 0.5,
    root: _Path | None = None,
    unit: float | None = None,
) -> Tool:
    """Imports a tool from a MuJoCo (MJCF), ROS (URDF) or mesh (STL, OBJ) file.

    The command `pushplan import --help` lists the supported elements. Small differences between
    file and tool give warnings of the class `UserWarning`.

    Parameters
    ----------
    path : str or path-like
        File to import.
    body : str, optional
        Body of the tool, with all bodies fixed to it; by default the only body of the file.
    name : str, optional
        Name of the tool; by default from the file.
    friction : float, default 0.5
        Friction value of bodies that state none.
    root : str or path-like, optional
        Folder that must contain all files to which the file refers; by default its own folder.
    unit : float, optional
        Unit of a mesh file, metres, such as 0.001 for millimetres; by default metres, or the unit
        that makes it an object on a table.

    Returns
    -------
    Tool
        Imported tool.

    Raises
    ------
    FileError
        If the file is unreadable, or pushplan cannot express a part of it.
    ValueError
        If `unit` is not a number above 0.

    Examples
    --------
    >>> tool = pushplan.import_tool("hook.xml", friction=0.4)
    """
def import_task(
    path: _Path,
    *,
    bodies: Sequence[str] | None = None,
    name: str | None = None,
    friction: float = 0.5,
    shift: tuple[float, float] = ...,
    free: Sequence[str] | None = None,
    density: float | None = None,
    root: _Path | None = None,
    unit: float | None = None,
    fixed: bool = False,
    strict: bool = False,
) -> Task:
    """Imports a task with the objects and obstacles of a MuJoCo (MJCF), ROS (URDF) or mesh file.

    Robot and tools of the task are placeholders. The goal is the position of the first object,
    unless `export_mjcf` wrote the file. Small differences between file and task give warnings of
    the class `UserWarning`.

    Parameters
    ----------
    path : str or path-like
        File to import.
    bodies : sequence of str, optional
        Bodies to import as objects; by default all bodies that move freely.
    name : str, optional
        Name of the task; by default from the file.
    friction : float, default 0.5
        Friction value of bodies that state none.
    shift : tuple of float, default (0, 0)
        Translation of everything on the table, x and y in metres.
    free : sequence of str, optional
        Bodies that become free objects although the file fixes them.
    density : float, optional
        Density of bodies that state no mass, kg/m^3; by default 1000, with unknown masses.
    root : str or path-like, optional
        Folder that must contain all files to which the file refers; by default its own folder.
    unit : float, optional
        Unit of a mesh file, metres; by default metres, or the unit that makes it an object on a
        table.
    fixed : bool, default False
        Whether free bodies to which others are jointed are fixed, like a cabinet against a wall.
    strict : bool, default False
        Whether a missing unit, mass or free body is an error instead of an assumption.

    Returns
    -------
    Task
        Imported task.

    Raises
    ------
    FileError
        If the file is unreadable, or pushplan cannot express a part of it.
    ValueError
        If `density` or `unit` is not a number above 0.

    Examples
    --------
    >>> task = pushplan.import_task("scene.xml", shift=(0.1, 0.0))
    """
def export_mjcf(plan: Plan, path: _Path) -> None:
    """Writes a plan as a MuJoCo scene (MJCF) with pushes and goal: the text of `Plan.to_mjcf`.

    Parameters
    ----------
    plan : Plan
        Plan to export.
    path : str or path-like
        File to write, in an existing folder. It is replaced as a whole, so that no partial file
        remains after an error.

    Raises
    ------
    FileError
        If the file cannot be written.

    Examples
    --------
    >>> pushplan.export_mjcf(plan, "best.xml")
    """
def export_mcap(
    plan: Plan,
    path: _Path,
    *,
    trajectory: Trajectory | None = None,
    model: str = "3d",
    threads: int = 0,
) -> None:
    """Writes a plan and its motion as MCAP, for viewers such as Foxglove and Rerun.

    Solids are `foxglove.SceneUpdate` messages on `/scene`. Poses are `foxglove.FrameTransforms` on
    `/tf` and plain numbers on `/state`. The plan file is an attachment.

    Parameters
    ----------
    plan : Plan
        Plan to export.
    path : str or path-like
        File to write, in an existing folder. It is replaced as a whole, so that no partial file
        remains after an error.
    trajectory : Trajectory, optional
        Motion to write, from `predict` or a replay of a verdict; by default the prediction of
        `model`.
    model : str, default "3d"
        Model of the default motion.
    threads : int, default 0
        Number of worker threads; 0 means one per core.

    Raises
    ------
    FileError
        If the file cannot be written.
    ModelError
        If `model` is not the name of an effect model.
    TypeError or ValueError
        If an argument has an invalid type, or `trajectory` belongs to another task.

    Examples
    --------
    >>> pushplan.export_mcap(plan, "best.mcap", trajectory=pushplan.predict(plan))
    """
def tool_schema() -> dict[str, Any]:
    """Returns the JSON schema (draft 2020-12) of tool files and of mappings for `Tool.from_dict`.

    Examples
    --------
    >>> keys = pushplan.tool_schema()["properties"]
    """
def task_schema() -> dict[str, Any]:
    """Returns the JSON schema (draft 2020-12) of task files and of mappings for `Task.from_dict`.

    Examples
    --------
    >>> keys = pushplan.task_schema()["properties"]
    """
def recording_schema() -> dict[str, Any]:
    """Returns the JSON schema (draft 2020-12) of recordings and of mappings for `Recording.from_dict`.

    Examples
    --------
    >>> keys = pushplan.recording_schema()["properties"]
    """
