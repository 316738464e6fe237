"""Tags rendered by MuJoCo are located correctly, within the stated covariance."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pushplan

os.environ.setdefault("MUJOCO_GL", "egl")
cv2 = pytest.importorskip("cv2")
mujoco = pytest.importorskip("mujoco")
poses = pytest.importorskip("pushplan.poses")

WIDTH, HEIGHT, FIELD = 1280, 960, 45.0
#: Tags on the table, with white margins: ids, centres, and the edge of the black square, metres.
TABLE = {0: (0.25, -0.3), 1: (0.85, -0.3), 2: (0.25, 0.3), 3: (0.85, 0.3)}
EDGE = 0.06
#: White margin around a tag, relative to its edge.
MARGIN = 1.5
TASK: Any = {
    "scene": {
        "objects": [
            {"name": "can", "shape": {"cylinder": {"radius": 0.04, "height": 0.1}},
             "mass": 0.4, "friction": 0.4, "position": [0.5, 0.1]},
            {"name": "box", "shape": {"cuboid": {"size": [0.12, 0.08, 0.06]}},
             "mass": 0.4, "friction": 0.4, "position": [0.6, -0.1]},
        ]
    },
    "robot": {"reach": {"min": 0.1, "max": 0.9}},
    "tools": "all",
    "goal": {"object": "can", "position": [0.6, 0.1], "tolerance": 0.02},
}


def scene(folder: Path, eye: Any, at: npt.NDArray[np.float64]) -> Any:
    """A table with tags, a can and a box with tags on top, and a camera a metre or so away."""
    kinds, geoms = [], []
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    squares = [(k, (x, y, 0.0), 0.0, EDGE) for k, (x, y) in TABLE.items()]
    squares += [(7, (*at[0, :2], 0.1), at[0, 2], 0.04), (8, (*at[1, :2], 0.06), at[1, 2], 0.05)]
    for k, place, yaw, edge in squares:
        black = 400
        white = round(black * (MARGIN - 1) / 2)
        image = cv2.copyMakeBorder(
            cv2.aruco.generateImageMarker(dictionary, k, black),
            *[white] * 4,
            cv2.BORDER_CONSTANT,
            value=255,
        )
        cv2.imwrite(str(folder / f"tag{k}.png"), image)
        half = edge / 2 * (black + 2 * white) / black
        kinds.append(
            f'<texture name="t{k}" type="2d" file="{folder}/tag{k}.png"/>'
            f'<material name="m{k}" texture="t{k}" specular="0" reflectance="0"/>'
        )
        geoms.append(
            f'<geom type="plane" size="{half} {half} 1" '
            f'pos="{place[0]} {place[1]} {place[2] + 1e-4}" '
            f'euler="0 0 {math.degrees(yaw)}" material="m{k}"/>'
        )
    axes = looking(eye)
    text = f"""<mujoco><visual><global offwidth="{WIDTH}" offheight="{HEIGHT}"/>
      <quality offsamples="8"/>
      <headlight ambient="0.6 0.6 0.6" diffuse="0.4 0.4 0.4" specular="0 0 0"/></visual>
      <asset>{"".join(kinds)}</asset><worldbody>
      <geom type="plane" size="2 2 0.1" rgba="0.6 0.6 0.6 1"/>
      <geom type="cylinder" size="0.04 0.05" pos="{at[0, 0]} {at[0, 1]} 0.05" rgba="0.8 0.2 0.2 1"/>
      <geom type="box" size="0.06 0.04 0.03" pos="{at[1, 0]} {at[1, 1]} 0.03"
        euler="0 0 {math.degrees(at[1, 2])}" rgba="0.2 0.2 0.8 1"/>
      {"".join(geoms)}
      <camera name="eye" pos="{eye[0]} {eye[1]} {eye[2]}" fovy="{FIELD}"
        xyaxes="{" ".join(map(str, axes[:, 0]))} {" ".join(map(str, -axes[:, 1]))}"/>
      </worldbody></mujoco>"""
    return mujoco.MjModel.from_xml_string(text)


def looking(eye: Any) -> npt.NDArray[np.float64]:
    """Returns the axes (x right, y down, z ahead) of a camera towards the table, as columns."""
    ahead = np.array([0.55, 0.0, 0.05]) - np.asarray(eye)
    ahead /= np.linalg.norm(ahead)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(ahead, right), ahead])


def render(model: Any) -> npt.NDArray[np.uint8]:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    try:
        renderer = mujoco.Renderer(model, HEIGHT, WIDTH)
    except Exception as error:  # noqa: BLE001 - whatever a machine without graphics raises
        pytest.skip(f"MuJoCo cannot render here: {error}")
    with renderer:
        renderer.update_scene(data, "eye")
        return np.ascontiguousarray(renderer.render())


def camera() -> Any:
    focal = HEIGHT / 2 / math.tan(math.radians(FIELD) / 2)
    # MuJoCo's pixel coordinates refer to corners, OpenCV's to centres.
    matrix = [[focal, 0, WIDTH / 2 - 0.5], [0, focal, HEIGHT / 2 - 0.5], [0, 0, 1]]
    return poses.Camera(matrix)


TAGS = [poses.Tag(7, "can", 0.04), poses.Tag(8, "box", 0.05)]


def drawn(rng: np.random.Generator) -> tuple[Any, Any]:
    turn = rng.uniform(-math.pi, math.pi)
    out, up = rng.uniform(0.3, 0.7), rng.uniform(0.75, 0.95)
    eye = np.array([0.55 + out * math.cos(turn), out * math.sin(turn), up])
    at = np.array([
        [rng.uniform(0.4, 0.52), rng.uniform(0.08, 0.2), rng.uniform(-3, 3)],
        [rng.uniform(0.55, 0.7), rng.uniform(-0.2, -0.08), rng.uniform(-3, 3)],
    ])
    return eye, at


def test_rendered_tags_are_found_within_the_stated_error(tmp_path: Path) -> None:
    task = pushplan.Task.from_dict(TASK)
    # Not in the set from which poses.PIXELS was chosen.
    rng = np.random.default_rng(1000)
    squares = []
    for _ in range(12):
        eye, at = drawn(rng)
        image = render(scene(tmp_path, eye, at))
        placed = camera().placed(image, TABLE, EDGE)
        assert np.linalg.norm(-placed.turn.T @ placed.shift - eye) < 0.012
        seen = poses.look(task, image, placed, TAGS)
        assert seen.missing == ()
        off = seen.poses - at
        off[:, 2] = np.arctan2(np.sin(off[:, 2]), np.cos(off[:, 2]))
        assert np.linalg.norm(off[:, :2], axis=1).max() < 0.002, off
        assert np.abs(off[:, 2]).max() < math.radians(1.0), off
        squares += [one @ np.linalg.solve(known, one) for one, known in zip(off, seen.covariance)]
        assert all(0 < value < 0.01 for value in seen.noise)
        assert task.at(seen.poses).start == pytest.approx(seen.poses)
    # Squares of three normal variables: 3 on average, below 7.8 in 95 of 100 cases.
    assert 0.5 < np.mean(squares) < 6.0, squares
    assert np.mean(np.array(squares) < 7.81) >= 0.8, squares


def test_an_object_that_is_not_seen_stays_and_is_named(tmp_path: Path) -> None:
    task = pushplan.Task.from_dict(TASK)
    eye, at = drawn(np.random.default_rng(6))
    there = camera().at(eye, looking(eye))
    turned = [[math.cos(a), -math.sin(a)] for a in [at[0, 2]]]
    points = TAGS[0].corners(0.1)
    c, s = turned[0][0], -turned[0][1]
    world = points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + np.array([*at[0, :2], 0.0])
    seen = poses.look(task, {7: there.project(world)}, there, TAGS)
    assert seen.missing == ("box",)
    assert seen.poses[1] == pytest.approx(np.array(task.start)[1])
    off = seen.poses[0] - at[0]
    assert np.abs(off).max() < 1e-6
    # Corners that fit no pose are not an observation.
    wrong = there.project(world) + np.array([[0, 0], [30, 0], [0, -30], [0, 0]])
    assert set(poses.look(task, {7: wrong}, there, TAGS).missing) == {"can", "box"}
    with pytest.raises(ValueError, match="which the task does not have"):
        poses.look(task, {}, there, [poses.Tag(1, "cup", 0.04)])
    with pytest.raises(ValueError, match="no family"):
        poses.detect(np.zeros((9, 9), np.uint8), "qr")
