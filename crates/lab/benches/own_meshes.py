#!/usr/bin/env python3
"""Replays plans for imported meshes in MuJoCo with the meshes themselves.

    pip install mujoco numpy trimesh shapely mapbox-earcut scipy pyyaml
    python3 crates/lab/benches/own_meshes.py --program target/release/pushplan --out own [--seed 67]

Makes meshes of 13 kinds and imports each as an object, with a goal at 12 cm in any direction and a
tolerance of 2 cm. Each task is solved with all shipped tools. In the exported scene, convex pieces
of the mesh replace the solids of the object, with mass, centre and inertia of the mesh. The pieces
of a round mesh are the frusta of its outside. Exported scenes and those with meshes are replayed.
Lengths are in metres.
"""

import argparse
import json
import math
import subprocess
import sys
import zlib
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import SubElement

import numpy as np
import trimesh
import yaml
from contacts import transfer
from shapely.geometry import Polygon
from trimesh.convex import convex_hull
from trimesh.creation import extrude_polygon, revolve, torus

PLACE, WAY, TOLERANCE, DENSITY = np.array([0.5, 0.05]), 0.12, 0.02, 1000.0
THIN = 0.004  # thickness of walls
SECTIONS, TURNS = 40, 24  # sides of a round mesh, pieces of a handle


def turned(outer, inner=()):
    """Returns a round mesh with its frusta; profiles are radius and height."""
    angles = np.arange(SECTIONS) * math.tau / SECTIONS
    ring = lambda r, z: np.column_stack([r * np.cos(angles), r * np.sin(angles), 0 * angles + z])
    pairs = zip(outer, outer[1:], strict=False)
    pieces = [np.vstack([ring(*low), ring(*high)]) for low, high in pairs if high[1] > low[1]]
    return revolve(np.array([(0.0, 0.0), *outer, *inner]), sections=SECTIONS), pieces


def cup(outer, floor):
    """Returns a round mesh with an outer profile and walls above a floor."""
    inner = [(max(r - THIN, 1e-3), max(z, floor)) for r, z in reversed(outer)]
    return turned(outer, [*inner, (0.0, floor)])


def bowl(u):
    wide, high = u(0.05, 0.09), u(0.04, 0.07)
    base = wide * u(0.35, 0.6)
    shares = np.linspace(0, 1, 8)
    return cup([(base + (wide - base) * s**0.6, high * s) for s in shares], THIN)


def goblet(u):
    foot, stem, wide, high = u(0.03, 0.042), u(0.008, 0.014), u(0.035, 0.05), u(0.12, 0.16)
    under = high * u(0.35, 0.5)
    at = lambda share: under + share * (high - under)
    side = [(0.8 * wide, at(0.25)), (wide, at(0.5)), (0.95 * wide, high)]
    inner = [(r - THIN, z + 1e-3 * (z < high)) for r, z in reversed(side)]
    outer = [(foot, 0.0), (foot, 0.004), (stem, 0.012), (stem, under), *side]
    return turned(outer, [*inner, (0.0, under + 6e-3)])


def vase(u):
    base, wide, neck, high = u(0.025, 0.04), u(0.045, 0.065), u(0.02, 0.03), u(0.12, 0.18)
    shares = [(base, 0.0), (wide, 0.35), (0.97 * wide, 0.45), (neck, 0.75), (1.3 * neck, 1.0)]
    return cup([(r, share * high) for r, share in shares], THIN)


def bottle(u):
    wide, neck, high = u(0.03, 0.045), u(0.011, 0.016), u(0.15, 0.2)
    side = [(0.95 * wide, 0.0), (wide, 0.006), (wide, 0.6 * high), (neck, 0.78 * high)]
    return turned([*side, (neck, high)], [(0.0, high)])


def pot(u):
    base, wide, high = u(0.03, 0.04), u(0.05, 0.06), u(0.08, 0.11)
    return cup([(base, 0.0), (wide, high)], THIN)


def mushroom(u):
    stem, wide, high = u(0.02, 0.03), u(0.045, 0.06), u(0.06, 0.09)
    under = u(0.5, 0.7) * high
    cap = [(wide, under + 0.002), (0.8 * wide, under + 0.6 * (high - under)), (0.0, high)]
    return turned([(1.3 * stem, 0.0), (stem, under), *cap])


def taper(u):
    base, top, high = u(0.05, 0.06), u(0.03, 0.04), u(0.07, 0.11)
    return turned([(base, 0.0), (top, high)], [(0.0, high)])


def dish(u):
    wide = u(0.08, 0.11)
    return cup([(0.55 * wide, 0.0), (wide, u(0.018, 0.03))], THIN)


def mug(u):
    wide, high = u(0.035, 0.045), u(0.08, 0.1)
    body, pieces = cup([(wide, 0.0), (wide, high)], THIN)
    handle = torus(u(0.02, 0.026), 0.006, major_sections=TURNS, minor_sections=12)
    handle.apply_transform(trimesh.transformations.rotation_matrix(math.pi / 2, [1, 0, 0]))
    angles = np.arctan2(handle.vertices[:, 2], handle.vertices[:, 0])
    handle.apply_translation([wide + 0.004, 0, high / 2])
    width = math.tau / TURNS
    for k in range(TURNS):
        off = np.abs((angles - (k + 0.5) * width + math.pi) % math.tau - math.pi)
        pieces.append(handle.vertices[off < 0.6 * width])
    return trimesh.util.concatenate([body, handle]), pieces


def bevelled(u):
    sides, high, bevel = [u(0.06, 0.12), u(0.05, 0.1)], u(0.04, 0.1), u(0.003, 0.008)
    levels = [(0.0, bevel), (bevel, 0.0), (high - bevel, 0.0), (high, bevel)]
    signs = [(x, y) for x in (-1, 1) for y in (-1, 1)]
    points = [
        [x * (sides[0] / 2 - by), y * (sides[1] / 2 - by), z] for x, y in signs for z, by in levels
    ]
    mesh = convex_hull(np.array(points))
    return mesh, [mesh.vertices]


def hexagon(u):
    radius = u(0.035, 0.06)
    angles = np.arange(6) * math.pi / 3
    corners = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    # In halves, because MuJoCo finds too few contacts below one mesh of six corners to rest.
    halves = [corners[:4], corners[[3, 4, 5, 0]]]
    return upright(corners, halves, u(0.04, 0.1))


def bracket(u):
    a, b, w = u(0.08, 0.14), u(0.07, 0.12), u(0.02, 0.03)
    outline = [(0, 0), (a, 0), (a, w), (w, w), (w, b), (0, b)]
    return upright(outline, [box(0, a, 0, w), box(0, w, w, b)], u(0.04, 0.08))


def tee(u):
    a, b, w = u(0.1, 0.15) / 2, u(0.09, 0.13), u(0.025, 0.035)
    h = w / 2
    outline = [(-a, 0), (a, 0), (a, w), (h, w), (h, b), (-h, b), (-h, w), (-a, w)]
    return upright(outline, [box(-a, a, 0, w), box(-h, h, w, b)], u(0.04, 0.07))


def box(left, right, near, far):
    return [(left, near), (right, near), (right, far), (left, far)]


def upright(outline, parts, high):
    """Returns a mesh with vertical sides, and its pieces above convex parts of the outline."""
    ends = lambda part: np.vstack([np.column_stack([part, np.full(4, z)]) for z in (0.0, high)])
    return extrude_polygon(Polygon(outline), high), [ends(part) for part in parts]


KINDS = [
    bowl, goblet, vase, bottle, bracket, mug, bevelled, tee, hexagon, pot, mushroom, taper, dish,
]


def made(seed, count, folder):
    """Writes the meshes, and returns them with their pieces by name."""
    rng = np.random.default_rng(seed)
    found = {}
    for k in range(count):
        kind = KINDS[k % len(KINDS)]
        mesh, pieces = kind(rng.uniform)
        mesh.merge_vertices()
        if mesh.volume < 0:
            mesh.invert()
        middle = np.append(mesh.bounds[:, :2].mean(axis=0), 0.0)
        mesh.apply_translation(-middle)
        name = f"{k:02}-{kind.__name__}"
        mesh.export(folder / f"{name}.stl")
        found[name] = mesh, [piece - middle for piece in pieces]
    return found


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True)


def planned(program, name, out):
    """Imports and solves a mesh, and returns the exported scene; `None` without a plan."""
    task = out / f"{name}.yaml"
    density, shift = f"--density={DENSITY}", "--shift=" + ",".join(map(str, PLACE))
    mesh = out / f"{name}.stl"
    run(program, "import", mesh, "--as", "objects", density, shift, "--out", task)
    keys = yaml.safe_load(task.read_text())
    thing = keys["scene"]["objects"][0]
    turn = zlib.crc32(name.encode()) / 2**32 * math.tau
    turns = [turn + k * math.tau / 16 for k in range(16)]
    goals = [thing["position"] + WAY * np.array([math.cos(a), math.sin(a)]) for a in turns]
    goal = next(goal for goal in goals if 0.4 < np.hypot(*goal) < 0.62)
    keys["goal"] = {
        "object": thing["name"], "position": goal.tolist(), "tolerance": TOLERANCE,
    }
    keys["robot"] = {"reach": {"min": 0.1, "max": 0.9}}
    task.write_text(yaml.safe_dump(keys))
    if run(program, "solve", task, "--out", out).returncode:
        return None
    run(program, "export", out / f"{name}.plan.json", "--out", out / "as-exported")
    return (out / "as-exported" / f"{name}.xml").read_text()


def with_mesh(text, name, mesh, pieces):
    """Returns the exported scene with the pieces of the mesh in place of the object's solids."""
    root = ElementTree.fromstring(text)
    whole = f"object/{name}"
    body = next(one for one in root.iter("body") if one.get("name") == whole)
    ours = {geom.get("name") for geom in body.iter("geom")}
    for child in [child for child in body if child.tag != "freejoint"]:
        body.remove(child)
    numbers = lambda key: np.array([float(word) for word in body.get(key, "0 0 0").split()])
    words = lambda values: " ".join(repr(float(value)) for value in np.ravel(values))
    turn = np.linalg.inv(trimesh.transformations.euler_matrix(*numbers("euler")))
    here = turn @ trimesh.transformations.translation_matrix([*PLACE, 0.0] - numbers("pos"))
    mesh = mesh.copy().apply_transform(here)
    mesh.density = DENSITY
    rows = mesh.moment_inertia
    SubElement(
        body, "inertial", pos=words(mesh.center_mass), mass=repr(float(mesh.mass)),
        fullinertia=words([*rows.diagonal(), rows[0, 1], rows[0, 2], rows[1, 2]]),
    )
    asset = root.find("asset")
    asset = SubElement(root, "asset") if asset is None else asset
    names = [whole, *(f"{whole}/own-{k}" for k in range(1, len(pieces)))]
    for own, piece in zip(names, pieces, strict=True):
        points = trimesh.transform_points(piece, here)
        SubElement(asset, "mesh", name=f"own {own}", vertex=words(points))
        SubElement(body, "geom", name=own, mass="0", type="mesh", mesh=f"own {own}")
    transfer(root.find("contact"), ours, names)
    root.find("option/flag").set("multiccd", "enable")
    return ElementTree.tostring(root, encoding="unicode")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="pushplan")
    parser.add_argument("--out", type=Path, default=Path("own"))
    parser.add_argument("--seed", type=int, default=67)
    parser.add_argument("--count", type=int, default=50)
    options = parser.parse_args()
    out = options.out
    for folder in ("as-exported", "own"):
        (out / folder).mkdir(parents=True, exist_ok=True)
        for old in (out / folder).glob("*.xml"):
            old.unlink()
    for name, (mesh, pieces) in made(options.seed, options.count, out).items():
        scene = planned(options.program, name, out)
        print(name, "no plan" if scene is None else "solved", file=sys.stderr, flush=True)
        if scene is not None:
            (out / "own" / f"{name}.xml").write_text(with_mesh(scene, name, mesh, pieces))
    print("| solids | meshes | planned | reach their goals | failures |")
    print("| --- | --: | --: | --: | --- |")
    for folder in ("as-exported", "own"):
        done = run(sys.executable, out / "as-exported" / "replay.py", out / folder)
        rows = [json.loads(line) for line in done.stdout.splitlines()]
        reached = sum(row["reached"] for row in rows)
        failures = Counter(row["failure"] for row in rows if not row["reached"])
        failures = ", ".join(f"{count} {name}" for name, count in failures.most_common())
        print(f"| {folder} | {options.count} | {len(rows)} | {reached} | {failures} |")


if __name__ == "__main__":
    main()
