"""Poses in MCAP files of `pushplan export` and in ROS 2 bags (rosbag2 with MCAP storage)."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt

__all__ = ["own", "poses_of"]

_Floats = npt.NDArray[np.float64]

#: Time (s), x, y (m), heading (rad).
_Row = tuple[float, float, float, float]

_TREE = "tf2_msgs/msg/TFMessage"

#: Message types from which poses are read; for the last type, the topic is followed by `#` and the
#: child frame.
_POSES = {
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "nav_msgs/msg/Odometry",
    "geometry_msgs/msg/TransformStamped",
    _TREE,
}


def own(path: Path) -> dict[str, Any]:
    """Returns the recording in a file of `pushplan export`, with scene and tool of its plan."""
    plan: Any = None
    frames: list[dict[str, Any]] = []
    with path.open("rb") as file:
        reader = _reader(file)
        for attachment in reader.iter_attachments():
            if attachment.media_type == "application/json":
                plan = json.loads(attachment.data)
        for _, channel, message in reader.iter_messages(topics=["/state"]):
            if channel.message_encoding == "json":
                frames.append(json.loads(message.data))
    if plan is None or not frames:
        raise ValueError(
            f"{path}: found no plan of pushplan with its /state; for a ROS 2 bag, set `topics`"
        )
    steps = [step.get("push") for step in plan["plan"]["steps"]]
    names = {step["tool"] for step in steps if step}
    if None in steps or len(names) != 1:
        raise ValueError(
            f"{path}: a recording needs pushes with one tool; export a plan without other steps"
        )
    [tool] = [tool for tool in plan["tools"] if tool["name"] in names]
    written = []
    for k, frame in enumerate(frames):
        one = {
            "pusher": _degrees(frame["tool"]),
            "objects": [_degrees(thing) for thing in frame["objects"]],
        }
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
    """Returns for every name the times (s) and poses (x, y in m, heading in rad) of its topic."""
    found: dict[str, list[_Row]] = {name: [] for name in topics}
    wanted: dict[str, list[tuple[str, str]]] = {}
    for name, topic in topics.items():
        title, _, child = topic.partition("#")
        wanted.setdefault(title, []).append((name, child))
    with path.open("rb") as file:
        reader = _reader(file)
        known = _topics(reader)
        for title in wanted:
            if title in known and known[title] not in _POSES:
                kind = known[title] or "unknown"
                raise ValueError(
                    f"{path}: {title} has the type {kind}; expected one of "
                    f"{', '.join(sorted(_POSES))}"
                )
        for schema, channel, _, message in reader.iter_decoded_messages(topics=list(wanted)):
            for child, row in _poses(message.transforms if schema.name == _TREE else [message]):
                for name, asked in wanted[channel.topic]:
                    if not asked or asked == child:
                        found[name].append(row)
    for name, rows in found.items():
        if len(rows) < 2:
            there = ", ".join(f"{topic} ({kind})" for topic, kind in sorted(known.items()))
            raise ValueError(
                f"{path}: {topics[name]} has {len(rows)} poses for `{name}`; the file has {there}"
            )
    # A repeated stamp is the same pose.
    tables = {name: np.array(sorted(set(rows))) for name, rows in found.items()}
    return {name: (table[:, 0], table[:, 1:]) for name, table in tables.items()}


#: Keys of a task's scene that a recording also has.
_SCENE = {"objects", "table", "joints", "obstacles", "frictions", "push_height"}


def _degrees(pose: Any) -> list[float]:
    return [pose["x"], pose["y"], math.degrees(pose["heading"])]


def _poses(messages: Iterable[Any]) -> Iterator[tuple[str, _Row]]:
    """Yields the child frame (empty without one), the time and the pose of each message."""
    for message in messages:
        stamp, child = message.header.stamp, getattr(message, "child_frame_id", "")
        if hasattr(message, "transform"):
            place, turn = message.transform.translation, message.transform.rotation
        else:
            # In messages with a covariance, and in odometry, the pose is nested deeper.
            pose = getattr(message.pose, "pose", message.pose)
            place, turn = pose.position, pose.orientation
        heading = math.atan2(
            2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y * turn.y + turn.z * turn.z)
        )
        yield child, (stamp.sec + 1e-9 * stamp.nanosec, place.x, place.y, heading)


def _topics(reader: Any) -> dict[str, str]:
    """Returns the topics of a file with their types; empty if the file has no index."""
    summary = reader.get_summary()
    if summary is None:
        return {}
    kinds = {number: schema.name for number, schema in summary.schemas.items()}
    return {
        channel.topic: kinds.get(channel.schema_id, "") for channel in summary.channels.values()
    }


def _reader(file: IO[bytes]) -> Any:
    try:
        from mcap.reader import make_reader
        from mcap_ros2.decoder import DecoderFactory
    except ImportError as error:
        raise ImportError(
            "reading MCAP files needs two packages: pip install 'pushplan[mcap]'"
        ) from error
    return make_reader(file, decoder_factories=[DecoderFactory()])
