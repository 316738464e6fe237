"""Import of MuJoCo models that are already loaded: see :func:`scene_from`."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Optional
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

import numpy as np
import numpy.typing as npt

from . import _native

__all__ = ["scene_from"]

#: Types of geoms and joints, and flags, by MuJoCo's numbers.
_GEOMS = ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"]
_JOINTS = ["free", "ball", "slide", "hinge"]
_MESH, _FREE, _WORLD = 7, 0, 0

_Floats = npt.NDArray[np.float64]
_Pose = tuple[_Floats, _Floats]


def scene_from(
    model: Any,
    data: Any = None,
    *,
    bodies: Optional[Sequence[str]] = None,
    name: Optional[str] = None,
    friction: float = 0.5,
    shift: tuple[float, float] = (0.0, 0.0),
    free: Optional[Sequence[str]] = None,
    density: Optional[float] = None,
) -> _native.Task:
    """Imports a task with the objects and obstacles of a loaded MuJoCo model.

    The model may come from a file, a text, `mujoco.MjSpec` or another library. It is written as an
    MJCF file, and errors and warnings state lines of that file.

    Parameters
    ----------
    model : mujoco.MjModel
        Loaded model.
    data : mujoco.MjData, optional
        State with the poses of bodies and joints; by default the initial state of the model. Joint
        limits count from this state.
    bodies, name, friction, shift, free, density
        Options of the import, see :func:`import_task`.

    Returns
    -------
    Task
        Imported task.

    Raises
    ------
    FileError
        If pushplan cannot express a part of the model.

    Examples
    --------
    >>> model = mujoco.MjModel.from_xml_path("scene.xml")
    >>> task = pushplan.scene_from(model, free=["box"])
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.xml"
        ElementTree.indent(written := _Written(model, data).root)
        ElementTree.ElementTree(written).write(path, encoding="unicode")
        return _native.import_task(
            path,
            bodies=bodies,
            name=name,
            friction=friction,
            shift=shift,
            free=free,
            density=density,
        )


class _Written:
    """MJCF of the imported parts of a model."""

    def __init__(self, model: Any, data: Any) -> None:
        import mujoco  # type: ignore[import-not-found,import-untyped,unused-ignore]

        now = mujoco.MjData(model)
        if data is not None:
            now.qpos[:], now.mocap_pos[:], now.mocap_quat[:] = (
                data.qpos,
                data.mocap_pos,
                data.mocap_quat,
            )
        mujoco.mj_kinematics(model, now)
        self.model, self.now = model, now
        self.paired = {*map(int, model.pair_geom1), *map(int, model.pair_geom2)}
        self.root = Element("mujoco", model=_text(model, "names", 0))
        SubElement(self.root, "compiler", angle="radian")
        self._option()
        meshes = sorted(
            {int(model.geom_dataid[g]) for g in range(model.ngeom) if model.geom_type[g] == _MESH}
        )
        asset = SubElement(self.root, "asset")
        for mesh in meshes:
            self._mesh(asset, mesh)
        custom = SubElement(self.root, "custom")
        for numeric in map(model.numeric, range(model.nnumeric)):
            SubElement(custom, "numeric", name=numeric.name, data=_numbers(numeric.data))
        world = SubElement(self.root, "worldbody")
        elements = {_WORLD: world}
        for body in range(1, model.nbody):
            elements[body] = self._body(elements[int(model.body_parentid[body])], body)
        for geom in range(model.ngeom):
            self._geom(elements[int(model.geom_bodyid[geom])], geom)
        self._contact()
        for section, count in [
            ("equality", model.neq),
            ("tendon", model.ntendon),
            ("actuator", model.nu),
        ]:
            if count:
                # Their content does not matter, because none is imported.
                SubElement(SubElement(self.root, section), "general")

    def _option(self) -> None:
        import mujoco  # type: ignore[import-not-found,import-untyped,unused-ignore]

        chosen = self.model.opt
        option = SubElement(
            self.root, "option", gravity=_numbers(chosen.gravity), wind=_numbers(chosen.wind),
            density=repr(float(chosen.density)), viscosity=repr(float(chosen.viscosity)),
        )
        flag = SubElement(option, "flag")
        for kind in ("gravity", "contact", "constraint", "limit"):
            if chosen.disableflags & getattr(mujoco.mjtDisableBit, f"mjDSBL_{kind.upper()}"):
                flag.set(kind, "disable")

    def _mesh(self, asset: Element, mesh: int) -> None:
        model = self.model
        corners, faces = (
            getattr(model, f"mesh_{of}")[getattr(model, f"mesh_{of}adr")[mesh] :][
                : getattr(model, f"mesh_{of}num")[mesh]
            ]
            for of in ("vert", "face")
        )
        SubElement(
            # As in the file, before MuJoCo rotated them to their principal axes.
            asset,
            "mesh",
            name=f"mesh {mesh}",
            vertex=_numbers(
                (corners @ _matrix(model.mesh_quat[mesh]).T + model.mesh_pos[mesh]).ravel()
            ),
            face=" ".join(map(str, faces.ravel())),
        )

    def _body(self, parent: Element, body: int) -> Element:
        model, now = self.model, self.now
        above = int(model.body_parentid[body])
        place, turn = _seen((now.xpos[body], now.xquat[body]), (now.xpos[above], now.xquat[above]))
        element = SubElement(
            parent,
            "body",
            name=model.body(body).name or f"body {body}",
            pos=_numbers(place),
            quat=_numbers(turn),
        )
        if model.body_mocapid[body] >= 0:
            element.set("mocap", "true")
        if model.body_gravcomp[body]:
            element.set("gravcomp", repr(float(model.body_gravcomp[body])))
        if model.body_mass[body] > 0:
            SubElement(
                element,
                "inertial",
                mass=repr(float(model.body_mass[body])),
                pos=_numbers(model.body_ipos[body]),
                quat=_numbers(model.body_iquat[body]),
                diaginertia=_numbers(model.body_inertia[body]),
            )
        first = int(model.body_jntadr[body])
        for joint in range(first, first + int(model.body_jntnum[body])):
            self._joint(element, joint)
        return element

    def _joint(self, body: Element, joint: int) -> None:
        model, kind = self.model, int(self.model.jnt_type[joint])
        if kind == _FREE:
            SubElement(body, "freejoint")
            return
        motion = int(model.jnt_dofadr[joint])
        element = SubElement(
            body, "joint", name=model.joint(joint).name or f"joint {joint}", type=_JOINTS[kind],
            pos=_numbers(model.jnt_pos[joint]), axis=_numbers(model.jnt_axis[joint]),
            # Current joint position: the body is moved there, and limits count from zero.
            ref=repr(float(self.now.qpos[model.jnt_qposadr[joint]])),
            stiffness=_numbers(np.ravel(model.jnt_stiffness[joint])),
            damping=_numbers(np.ravel(model.dof_damping[motion])),
            frictionloss=repr(float(model.dof_frictionloss[motion])),
        )
        if model.jnt_limited[joint]:
            element.set("limited", "true")
            element.set("range", _numbers(model.jnt_range[joint]))

    def _geom(self, body: Element, geom: int) -> None:
        model, kind = self.model, int(self.model.geom_type[geom])
        place, turn = model.geom_pos[geom], model.geom_quat[geom]
        if kind == _MESH:
            mesh = int(model.geom_dataid[geom])
            back = _seen(
                (np.zeros(3), np.array([1.0, 0, 0, 0])),
                (model.mesh_pos[mesh], model.mesh_quat[mesh]),
            )
            place, turn = place + _matrix(turn) @ back[0], _product(turn, back[1])
        element = SubElement(
            body, "geom", type=_GEOMS[kind], pos=_numbers(place), quat=_numbers(turn),
            contype=str(model.geom_contype[geom]), conaffinity=str(model.geom_conaffinity[geom]),
            condim=str(model.geom_condim[geom]), group=str(model.geom_group[geom]),
            priority=str(model.geom_priority[geom]), friction=_numbers(model.geom_friction[geom]),
        )
        if model.geom(geom).name or geom in self.paired:
            element.set("name", self._name(geom))
        if kind == _MESH:
            element.set("mesh", f"mesh {mesh}")
        else:
            element.set("size", _numbers(model.geom_size[geom]))

    def _contact(self) -> None:
        model = self.model
        contact = SubElement(self.root, "contact")
        for pair in range(model.npair):
            SubElement(
                contact,
                "pair",
                geom1=self._name(int(model.pair_geom1[pair])),
                geom2=self._name(int(model.pair_geom2[pair])),
                friction=_numbers(model.pair_friction[pair]),
            )
        for signature in map(int, model.exclude_signature):
            names = [
                model.body(body).name or f"body {body}"
                for body in (signature >> 16, signature & 0xFFFF)
            ]
            SubElement(contact, "exclude", body1=names[0], body2=names[1])

    def _name(self, geom: int) -> str:
        return self.model.geom(geom).name or f"geom {geom}"


def _seen(pose: _Pose, frame: _Pose) -> _Pose:
    """Returns a position and a rotation (w x y z) relative to another frame."""
    back = frame[1] * np.array([1.0, -1.0, -1.0, -1.0])
    return _matrix(back) @ (pose[0] - frame[0]), _product(back, pose[1])


def _product(one: _Floats, other: _Floats) -> _Floats:
    (a, *v), (b, *w) = one, other
    return np.array([a * b - np.dot(v, w), *(a * np.array(w) + b * np.array(v) + np.cross(v, w))])


def _matrix(turn: _Floats) -> _Floats:
    w, *v = turn
    x, y, z = v
    across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + 2 * w * across + 2 * across @ across)


def _numbers(values: Iterable[Any]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _text(model: Any, of: str, at: int) -> str:
    """Returns a text of the model that ends with a zero byte."""
    whole: bytes = getattr(model, of)
    return whole[at : whole.index(b"\0", at)].decode("utf-8", "replace")
