"""Valid and invalid logs of trackers."""

from __future__ import annotations

import math
import pickle
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import pushplan
from pushplan import logs

BOX = {"name": "box", "shape": {"cuboid": {"size": [0.09, 0.09, 0.02]}}, "mass": 0.8}
STATED: dict[str, Any] = {
    "scene": {"objects": [BOX]},
    "pusher": {"cylinder": {"radius": 0.005, "height": 0.05}},
    "time": "t",
    "poses": {"pusher": ("tip_x", "tip_y"), "box": ("x", "y", "yaw")},
    "length": "mm",
    "angle": "rad",
}
Row = list[float]


def rows() -> list[Row]:
    """Returns a log in which a finger pushes a box by 5 cm and rotates it by 0.3 rad, past pi."""
    found = []
    for k in range(101):
        tip = 0.001 * k
        box = max(0.1, tip + 0.0505)
        turn = math.pi - 0.1 + 0.3 * max(0.0, box - 0.1) / 0.05
        wrapped = (turn + math.pi) % math.tau - math.pi
        found.append([0.02 * k, 1e3 * tip, 0.0, 1e3 * box, 0.0, wrapped])
    return found


def written(path: Path, table: list[Row]) -> Path:
    lines = ["t,tip_x,tip_y,x,y,yaw", *(",".join(map(repr, row)) for row in table)]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_log_in_millimetres_and_radians_is_a_recording(tmp_path: Path) -> None:
    path = written(tmp_path / "log.csv", rows())
    recording = logs.read_csv(path, **STATED)
    assert (recording.name, recording.objects, len(recording)) == ("log", ["box"], 101)
    assert recording.poses[-1, 0, 0] == pytest.approx(0.1505)
    turned = recording.poses[:, 0, 2]
    assert np.abs(np.diff(turned)).max() < 0.1, "turns are counted"
    assert turned[-1] - turned[0] == pytest.approx(0.303, abs=1e-3)
    again = pickle.loads(pickle.dumps(recording))
    assert again.poses == pytest.approx(recording.poses, abs=1e-12)
    part = logs.read_csv(path, **STATED, end=1.0)
    assert len(part) == 51
    assert np.all(part.velocities == 0.0)
    # Cut in the middle, the recording begins with the current velocity.
    late = logs.read_csv(path, **STATED, start=1.5)
    assert late.velocities[0] == pytest.approx([0.05, 0.0, 0.3], abs=1e-6)
    again = pickle.loads(pickle.dumps(late))
    assert again.velocities == pytest.approx(late.velocities, abs=1e-12)
    stated = {**STATED, "scene": {"objects": [{**BOX, "velocity": [0.04, 0]}]}}
    assert logs.read_csv(path, **stated, start=1.5).velocities[0, 0] == 0.04
    logs.write_json(tmp_path / "log.recording.json", path, **STATED)
    assert len(pushplan.Recording.load(tmp_path / "log.recording.json")) == 101


def edited(change: Callable[[int, Row], Row | None]) -> list[Row]:
    found = [change(k, list(row)) for k, row in enumerate(rows())]
    return [row for row in found if row is not None]


def set_at(column: int, value: Callable[[int, float], float]) -> list[Row]:
    def change(k: int, row: Row) -> Row:
        row[column] = value(k, row[column])
        return row

    return edited(change)


@pytest.mark.parametrize(
    ("table", "stated", "message"),
    [
        (rows(), {"length": "m"}, "check `length`, here `m`"),
        (
            [[a, b / 1e3, c, d / 1e3, e, f] for a, b, c, d, e, f in rows()],
            {},
            "check `length`, here `mm`",
        ),
        (rows(), {"angle": "deg"}, "wraps at pi; set `angle` to `rad`"),
        (set_at(5, lambda k, yaw: math.degrees(yaw)), {}, "set `angle` to `deg`"),
        (rows(), {"clock": "ns"}, "check the unit of time, `clock`"),
        (edited(lambda k, row: None if 60 <= k < 80 else row), {}, ":62: 0.42 s are missing"),
        (set_at(0, lambda k, t: 0.0 if k == 50 else t), {}, ":52: the time does not increase"),
        (set_at(1, lambda k, x: math.nan if k == 3 else x), {}, ":5: `tip_x` is 'nan'"),
        (rows(), {"time": "time"}, "no column time; the file has t, tip_x"),
        (
            rows(),
            {"poses": {"pusher": ("tip_x", "tip_y")}},
            "must have the keys pusher, box, found pusher",
        ),
    ],
)
def test_invalid_logs_are_reported(
    tmp_path: Path, table: list[Row], stated: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        logs.read_csv(written(tmp_path / "log.csv", table), **{**STATED, **stated})


def test_stale_poses_and_small_angles_are_reported(tmp_path: Path) -> None:
    def frozen(k: int, row: Row) -> Row:
        return [*row[:3], *rows()[60][3:]] if 60 <= k < 80 else row

    with pytest.raises(ValueError, match="the pose of `box` is constant for 0.38 s"):
        logs.read_csv(written(tmp_path / "log.csv", edited(frozen)), **STATED)
    small = set_at(5, lambda k, yaw: 0.002 * k)
    with pytest.warns(UserWarning, match="if they are radians"):
        logs.read_csv(written(tmp_path / "log.csv", small), **{**STATED, "angle": "deg"})


def bag(path: Path, table: list[Row], late: float = 0.0) -> Path:
    """Writes the log as a bag of rosbag2 with an independent library.

    The rotation of the box is a quaternion, and its stamps are shifted by `late`, seconds.
    """
    support = pytest.importorskip("mcap_ros2.writer")
    stamp = "int32 sec\nuint32 nanosec\n"
    header = "builtin_interfaces/Time stamp\nstring frame_id\n"
    line = "=" * 80 + "\n"
    vector = "float64 x\nfloat64 y\nfloat64 z\n"
    shared = (
        f"{line}MSG: std_msgs/Header\n{header}{line}MSG: builtin_interfaces/Time\n{stamp}"
        f"{line}MSG: geometry_msgs/Quaternion\n{vector}float64 w\n"
    )
    pose = (
        f"std_msgs/Header header\ngeometry_msgs/Pose pose\n{line}MSG: geometry_msgs/Pose\n"
        f"geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
        f"{line}MSG: geometry_msgs/Point\n{vector}{shared}"
    )
    tf = (
        f"geometry_msgs/TransformStamped[] transforms\n{line}MSG: geometry_msgs/TransformStamped\n"
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"
        f"{line}MSG: geometry_msgs/Transform\ngeometry_msgs/Vector3 translation\n"
        f"geometry_msgs/Quaternion rotation\n{line}MSG: geometry_msgs/Vector3\n{vector}{shared}"
    )

    def head(time: float) -> Any:
        nanos = round(1e9 * (100.0 + time))
        return {"stamp": {"sec": nanos // 10**9, "nanosec": nanos % 10**9}, "frame_id": "table"}

    with path.open("wb") as file:
        writer = support.Writer(file)
        poses = writer.register_msgdef("geometry_msgs/msg/PoseStamped", pose)
        frames = writer.register_msgdef("tf2_msgs/msg/TFMessage", tf)
        for time, tip_x, tip_y, x, y, yaw in table:
            nanos = round(1e9 * (100.0 + time))
            still = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
            at = {"x": tip_x / 1e3, "y": tip_y / 1e3, "z": 0.1}
            message = {"header": head(time), "pose": {"position": at, "orientation": still}}
            writer.write_message("/tip/pose", poses, message, log_time=nanos, publish_time=nanos)
            turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
            transforms = [
                {
                    "header": head(time + late),
                    "child_frame_id": child,
                    "transform": {"translation": at, "rotation": turn},
                }
                for child, at in [
                    ("camera", {"x": 9.0, "y": 9.0, "z": 9.0}),
                    ("box", {"x": x / 1e3, "y": y / 1e3, "z": 0.01}),
                ]
            ]
            writer.write_message(
                "/tf", frames, {"transforms": transforms}, log_time=nanos, publish_time=nanos
            )
        writer.finish()
    return path


ROS: dict[str, Any] = {
    "scene": STATED["scene"],
    "pusher": STATED["pusher"],
    "topics": {"box": "/tf#box", "pusher": "/tip/pose"},
}


def test_a_bag_of_ros_is_the_same_recording(tmp_path: Path) -> None:
    wanted = logs.read_csv(written(tmp_path / "log.csv", rows()), **STATED)
    found = logs.read_mcap(bag(tmp_path / "log.mcap", rows()), **ROS)
    assert (found.name, found.objects) == ("log", ["box"])
    assert found.times == pytest.approx(wanted.times, abs=1e-6)
    assert found.poses == pytest.approx(wanted.poses, abs=1e-6)
    # Poses with stamps off by half a step are interpolated in time.
    late = logs.read_mcap(bag(tmp_path / "late.mcap", rows(), late=0.01), **ROS)
    assert len(late) == len(wanted) - 1
    assert late.poses[:, 0, 0] == pytest.approx(np.maximum(0.1, late.poses[:, 0, 0]))
    assert late.poses[-1, 0, 0] == pytest.approx(
        (wanted.poses[-2, 0, 0] + wanted.poses[-1, 0, 0]) / 2, abs=1e-6
    )
    part = logs.read_mcap(tmp_path / "log.mcap", **ROS, end=1.0)
    assert len(part) == 51
    with pytest.raises(ValueError, match=r"/tf \(tf2_msgs/msg/TFMessage\)"):
        logs.read_mcap(
            tmp_path / "log.mcap", **{**ROS, "topics": {"box": "/tf#bottle", "pusher": "/tip/pose"}}
        )
    with pytest.raises(ValueError, match="must have the keys pusher, box, found box"):
        logs.read_mcap(tmp_path / "log.mcap", **{**ROS, "topics": {"box": "/tf#box"}})
    with pytest.raises(ValueError, match="no plan of pushplan"):
        logs.read_mcap(tmp_path / "log.mcap")


def test_an_exported_plan_is_read_back(tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    task = pushplan.Task.example("pull-back-twice")
    plan = pushplan.solve(task, effort="draft").best
    assert plan is not None and len(plan.pushes) == 2
    predicted = pushplan.predict(plan, "planar")
    pushplan.export_mcap(plan, tmp_path / "plan.mcap", trajectory=predicted)
    recording = logs.read_mcap(tmp_path / "plan.mcap")
    assert recording.objects == predicted.objects
    assert recording.times == pytest.approx(predicted.times, abs=1e-9)
    assert recording.poses == pytest.approx(predicted.poses, abs=1e-9)
    # A new prediction reproduces the content of the file.
    (tmp_path / "bad.mcap").write_bytes(b"no such thing")
    with pytest.raises(Exception, match="(?i)mcap|magic"):
        logs.read_mcap(tmp_path / "bad.mcap")
