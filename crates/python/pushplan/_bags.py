"""Poses in MCAP files: those that `pushplan export` wrote, and bags of ROS 2 (rosbag2 with MCAP storage)."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["own", "poses_of"]

_Floats = npt.NDArray[np.float64]

#: Of these messages poses are read; of the last the topic is followed by `#` and the child frame.
_POSES = {
    "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped", "nav_msgs/msg/Odometry",
    "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage",
}
_CHILD = {"nav_msgs/msg/Odometry", "geometry_msgs/msg/TransformStamped"}


def own(path: Path) -> dict[str, Any]:
    """The recording in a file of `pushplan export --format mcap`: scene and tool are those of its plan."""
    plan: Any = None
    frames: list[dict[str, Any]] = []
    reader = _reader(path)
    for attachment in reader.iter_attachments():
        if attachment.media_type == "application/json":
            plan = json.loads(attachment.data)
    for _, channel, message in reader.iter_messages(topics=["/state"]):
        if channel.message_encoding == "json":
            frames.append(json.loads(message.data))
    if plan is None or not frames:
        raise ValueError(f"{path}: no plan of pushplan and its /state; name `topics` of a bag of ROS")
    steps = [step.get("push") for step in plan["plan"]["steps"]]
    names = {step["tool"] for step in steps if step}
    if None in steps or len(names) != 1:
        raise ValueError(f"{path}: a recording is of pushes with one tool")
    [tool] = [tool for tool in plan["tools"] if tool["name"] in names]
    written = []
    for k, frame in enumerate(frames):
        one = {"pusher": _degrees(frame["tool"]), "objects": [_degrees(thing) for thing in frame["objects"]]}
        before = frames[k - 1]["push"] if k else frame["push"]
        if frame["push"] != before and steps[frame["push"]]["form"] == "placed":
            one["lifted"] = True
        written.append(one)
    scene = {key: value for key, value in plan["task"]["scene"].items() if key in _SCENE}
    return {
        "schema_version": 1,
        "kind": "recording",
        "name": path.stem,
        "scene": scene,
        "pusher": {"tool": tool, "lift": steps[0]["lift"]},
        "times": [frame["time"] for frame in frames],
        "frames": written,
    }


def poses_of(path: Path, topics: Mapping[str, str]) -> dict[str, tuple[_Floats, _Floats]]:
    """Of every name the times (s) and poses (x, y in metres, heading in radians) that its topic has."""
    found: dict[str, list[tuple[float, float, float, float]]] = {name: [] for name in topics}
    wanted: dict[str, list[tuple[str, str]]] = {}
    for name, topic in topics.items():
        title, _, child = topic.partition("#")
        wanted.setdefault(title, []).append((name, child))
    known: dict[str, str] = {}
    for schema, channel, message in _reader(path).iter_messages():
        kind = "" if schema is None else schema.name
        known[channel.topic] = kind
        if channel.topic not in wanted:
            continue
        if kind not in _POSES or channel.message_encoding != "cdr":
            raise ValueError(f"{path}: {channel.topic} is {kind or 'unknown'}, not one of {', '.join(sorted(_POSES))}")
        for child, row in _messages(kind, message.data):
            for name, asked in wanted[channel.topic]:
                if not asked or asked == child:
                    found[name].append(row)
    for name, rows in found.items():
        if len(rows) < 2:
            there = ", ".join(f"{topic} ({kind})" for topic, kind in sorted(known.items()))
            raise ValueError(f"{path}: {topics[name]} has {len(rows)} poses for `{name}`; there are {there}")
    # A stamp that comes twice is the same pose.
    tables = {name: np.array(sorted(set(rows))) for name, rows in found.items()}
    return {name: (table[:, 0], table[:, 1:]) for name, table in tables.items()}


#: Keys of a task's scene that a recording has, too.
_SCENE = {"objects", "table", "joints", "obstacles", "frictions", "push_height"}


def _degrees(pose: Any) -> list[float]:
    return [pose["x"], pose["y"], math.degrees(pose["heading"])]


def _messages(kind: str, data: bytes) -> Iterator[tuple[str, tuple[float, float, float, float]]]:
    """The child frame, if there is one, the time and the pose of a message."""
    cdr = _Cdr(data)
    for _ in range(cdr.take("I") if kind == "tf2_msgs/msg/TFMessage" else 1):
        time = cdr.take("i") + 1e-9 * cdr.take("I")
        cdr.text()
        child = cdr.text() if kind in _CHILD or kind == "tf2_msgs/msg/TFMessage" else ""
        x, y, _, qx, qy, qz, qw = (cdr.take("d") for _ in range(7))
        heading = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        yield child, (time, x, y, heading)


class _Cdr:
    """Numbers and texts in the order of a message, aligned to their size."""

    def __init__(self, data: bytes) -> None:
        self.order = "<" if data[1] & 1 else ">"
        self.data, self.at = data[4:], 0

    def take(self, kind: str) -> Any:
        size = struct.calcsize(kind)
        self.at += -self.at % size
        [value] = struct.unpack_from(self.order + kind, self.data, self.at)
        self.at += size
        return value

    def text(self) -> str:
        length = self.take("I")
        text = self.data[self.at : self.at + length]
        self.at += length
        return text.rstrip(b"\0").decode("utf-8", "replace")


def _reader(path: Path) -> Any:
    try:
        from mcap.reader import make_reader
    except ImportError as error:
        raise ImportError("MCAP needs the package mcap: pip install 'pushplan[mcap]'") from error
    # Open as long as it is read.
    return make_reader(path.open("rb"))
