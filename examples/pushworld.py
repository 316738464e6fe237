"""Converts PushWorld puzzles to tasks: a grid of cells becomes a table of boxes.

PushWorld (Kansky et al. 2023, https://github.com/google-deepmind/pushworld) is a benchmark of
puzzles in text. A cell is empty (``.``), a wall (``W``), a wall for the agent alone (``AW``), the
agent (``A``), a movable (``M0``), its goal (``G0``), or several of these joined by ``+``. The task
file uses metres:

- a cell is 80 mm; rows lie along x, away from the robot, and columns along -y;
- an object of n cells is n times 80 mm minus 16 mm long, so that 8 mm of play remain on each side;
- the tool is a plate that fits into one cell and is set down from above; shape and position of the
  agent are therefore ignored, and walls for the agent alone become keep-out regions of the plate;
- with `--as-played` the tool is the agent: it begins at its cells, stays down, and each push starts
  where the last one ended;
- an object is at its goal within 30 mm and 20 degrees.

    python examples/pushworld.py "At Crossroads.pwp" --out puzzles
    pushplan solve puzzles/at-crossroads.yaml --more-tools puzzles/tools
    python examples/pushworld.py "At Crossroads.pwp" --as-played --out played
    pushplan solve played/at-crossroads.yaml --more-tools played/tools
"""

import argparse
import json
import re
from collections import defaultdict
from pathlib import Path
from typing import Any

import pushplan

Cells = set[tuple[int, int]]

#: Side of a cell, play on either side of an object, height of objects and walls, metres.
CELL, PLAY, HEIGHT, WALL = 0.08, 0.008, 0.05, 0.10
#: Distance of the nearest cells from the robot's base, metres.
NEAREST = 0.36
#: Mass of a cell of an object, kg.
MASS = 0.1

#: Tool: a plate that fits into a cell beside an object.
PLATE = pushplan.Tool.from_dict(
    {
        "name": "plate",
        "description": "An upright plate under the grip, as wide as the object of one cell.",
        "friction": 0.5,
        "parts": [{"name": "plate", "size": [0.03, 0.06, 0.06], "position": [0, 0]}],
    }
)

#: Puzzle for a call without files: a row that must be cleared first.
SHOWN = """
 .  .  .  .  .  .  .
 A  .  M0 .  M1 .  G0
 .  .  .  .  .  .  .
"""


def read(text: str) -> tuple[dict[str, Cells], tuple[int, int]]:
    """Returns the cells (row, column) of every name, and its numbers of rows and columns."""
    rows = [line.split() for line in text.splitlines() if line.strip()]
    if not rows or len({len(row) for row in rows}) != 1:
        raise ValueError("a puzzle needs rows, all with the same number of cells")
    cells: dict[str, Cells] = defaultdict(set)
    for row, line in enumerate(rows):
        for column, cell in enumerate(line):
            for name in cell.upper().split("+"):
                if not re.fullmatch(r"\.|W|AW|A|[MG]\d+", name):
                    raise ValueError(
                        f"row {row + 1}, column {column + 1}: `{name}` is no cell; expected "
                        "`.`, W, AW, A, M0 or G0"
                    )
                cells[name].add((row, column))
    del cells["."]
    for goal in (name for name in cells if name.startswith("G")):
        if "M" + goal[1:] not in cells:
            raise ValueError(f"`{goal}` has no movable; add `M{goal[1:]}`")
    return cells, (len(rows), len(rows[0]))


Rectangle = tuple[int, int, int, int]


def apart(cells: Cells) -> list[Rectangle]:
    """Returns disjoint rectangles (first and last row, first and last column) of these cells."""
    left, found = set(cells), []
    while left:
        found.append(max(spanned(left), key=area))
        left -= inside(found[-1])
    return found


def solids(cells: Cells) -> list[Rectangle]:
    """Returns rectangles that contain every pair of adjacent cells, so that they stay connected
    when they shrink."""
    full = [one for one in spanned(cells) if not any(grown(one, cells))]
    open_pairs, found = pairs(cells), [max(full, key=area)]
    while open_pairs := open_pairs - pairs(inside(found[-1])):
        found.append(max(full, key=lambda one: len(open_pairs & pairs(inside(one)))))
    return found


def pairs(cells: Cells) -> set[tuple[tuple[int, int], tuple[int, int]]]:
    """Returns the pairs of adjacent cells."""
    near = [
        ((row, column), other)
        for row, column in cells
        for other in ((row + 1, column), (row, column + 1))
    ]
    return {pair for pair in near if pair[1] in cells}


def spanned(cells: Cells) -> list[Rectangle]:
    """Returns all rectangles within these cells."""
    found = []
    for top, left in sorted(cells):
        right = max(column for _, column in cells)
        for bottom in range(top, 1 + max(row for row, _ in cells)):
            width = next((k for k in range(left, right + 1) if (bottom, k) not in cells), right + 1)
            right = width - 1
            found += [(top, bottom, left, column) for column in range(left, right + 1)]
            if right < left:
                break
    return found


def inside(one: Rectangle) -> Cells:
    top, bottom, left, right = one
    return {(row, column) for row in range(top, bottom + 1) for column in range(left, right + 1)}


def area(one: Rectangle) -> int:
    return len(inside(one))


def grown(one: Rectangle, cells: Cells) -> list[bool]:
    """Returns for each side whether the rectangle could grow by a row or column there."""
    top, bottom, left, right = one
    sides = [(top - 1, bottom, left, right), (top, bottom + 1, left, right)]
    sides += [(top, bottom, left - 1, right), (top, bottom, left, right + 1)]
    return [inside(side) <= cells for side in sides]


class Table:
    """Positions of the cells of a puzzle on the table."""

    def __init__(self, rows: int, columns: int) -> None:
        self.rows, self.columns = rows, columns

    def place(self, one: Rectangle) -> tuple[list[float], list[float]]:
        """Returns centre and extents of a rectangle of cells, metres."""
        top, bottom, left, right = one
        x = NEAREST + 0.5 * CELL * (top + bottom + 1)
        y = 0.5 * CELL * (self.columns - left - right - 1)
        extents = [CELL * (bottom - top + 1), CELL * (right - left + 1)]
        return [round(x, 4), round(y, 4)], [round(extent, 4) for extent in extents]

    def movable(self, name: str, cells: Cells) -> dict[str, Any]:
        """Returns an object of these cells, positioned at its largest rectangle."""
        found: list[dict[str, Any]] = []
        for one in solids(cells):
            middle, size = self.place(one)
            shape = {
                "cuboid": {"size": [round(extent - 2 * PLAY, 4) for extent in size] + [HEIGHT]}
            }
            found.append({"shape": shape, "position": middle})
        whole = {"name": name, **found[0], "mass": round(MASS * len(cells), 3), "friction": 0.3}
        x, y = whole["position"]
        parts = [
            {
                **part,
                "position": [round(part["position"][0] - x, 4), round(part["position"][1] - y, 4)],
            }
            for part in found[1:]
        ]
        return {**whole, "parts": parts} if parts else whole

    def walls(self, cells: Cells) -> list[dict[str, Any]]:
        """Returns the walls of these cells and the walls around the table."""
        around = [(-1, -1, -1, self.columns), (self.rows, self.rows, -1, self.columns)]
        around += [(0, self.rows - 1, -1, -1), (0, self.rows - 1, self.columns, self.columns)]
        found = []
        for k, one in enumerate(apart(cells) + around):
            middle, size = self.place(one)
            found.append({"name": f"wall-{k + 1}", "size": [*size, WALL], "position": middle})
        return found

    def closed(self, cells: Cells) -> list[dict[str, Any]]:
        """Returns the keep-out regions of the tool."""
        found = []
        for k, one in enumerate(apart(cells)):
            middle, size = self.place(one)
            area = {"rectangle": {"size": size}}
            found.append(
                {"name": f"closed-{k + 1}", "area": area, "position": middle, "for": ["tool"]}
            )
        return found


def task_of(
    text: str, name: str, pushes: int = 32, agent: pushplan.Tool | None = None
) -> pushplan.Task:
    """Converts a puzzle to a task, for the plate or as played by its agent."""
    cells, (rows, columns) = read(text)
    table = Table(rows, columns)
    movables = sorted((one for one in cells if one.startswith("M")), key=lambda one: int(one[1:]))
    goals = []
    for goal in sorted(one for one in cells if one.startswith("G")):
        largest = solids(cells[goal])[0]
        at = {"object": "m" + goal[1:], "position": table.place(largest)[0], "tolerance": 0.03}
        goals.append({**at, "heading_deg": 0, "heading_tolerance_deg": 20})
    robot: dict[str, Any] = {"reach": {"min": 0, "max": 9}, "base": "none"}
    rules: dict[str, Any] = {"length": 0.5, "max_count": pushes, "grip_yaws_deg": [0, 90]}
    if agent:
        robot["home"] = table.place(solids(cells["A"])[0])[0]
        rules |= {"form": "chained", "grip_yaws_deg": [0]}
    task: dict[str, Any] = {
        "name": name,
        "description": "A puzzle of PushWorld.",
        "scene": {
            "table": {"friction": 0.3},
            "objects": [table.movable(one.lower(), cells[one]) for one in movables],
            "obstacles": table.walls(cells.get("W", set())),
        },
        "robot": robot,
        "tools": [agent.name if agent else "plate"],
        "pushes": rules,
        "goal": goals[0] if len(goals) == 1 else goals,
    }
    if "AW" in cells:
        task["keep_out"] = table.closed(cells["AW"])
    return pushplan.Task.from_dict(task)  # type: ignore[arg-type]


def agent_of(text: str, name: str) -> pushplan.Tool:
    """Returns the agent of a puzzle as a tool, with the end effector at its largest rectangle."""
    cells, (rows, columns) = read(text)
    if not cells.get("A"):
        raise ValueError("the puzzle has no agent `A`, so that it cannot be played")
    table = Table(rows, columns)
    found = [table.place(one) for one in solids(cells["A"])]
    home = found[0][0]
    parts: list[Any] = [
        {
            "name": f"part-{k + 1}",
            "size": [round(extent - 2 * PLAY, 4) for extent in extents] + [HEIGHT],
            "position": [round(at - base, 4) for at, base in zip(middle, home, strict=True)],
        }
        for k, (middle, extents) in enumerate(found)
    ]
    return pushplan.Tool.from_dict(
        {
            "name": f"agent-of-{name}",
            "description": "The agent of a puzzle.",
            "friction": 0.3,
            "parts": parts,
        }
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument(
        "puzzles", nargs="*", type=Path, help="puzzle files; by default a built-in puzzle"
    )
    parser.add_argument("--out", type=Path, default=Path("pushworld"), help="folder for the files")
    parser.add_argument(
        "--pushes", type=int, help="maximum number of pushes [default: 32, as played 64]"
    )
    parser.add_argument(
        "--as-played", action="store_true", help="play with the agent, which stays down"
    )
    chosen = parser.parse_args()
    pushes = chosen.pushes or (64 if chosen.as_played else 32)
    for path in chosen.puzzles:
        name = re.sub(r"[^a-z0-9]+", "-", path.stem.lower())
        text = path.read_text()
        agent = agent_of(text, name) if chosen.as_played else None
        task = task_of(text, name, pushes, agent)
        file = chosen.out / f"{name}.yaml"
        (chosen.out / "tools").mkdir(parents=True, exist_ok=True)
        tool = agent or PLATE
        # JSON is also YAML.
        (chosen.out / f"tools/{tool.name}.yaml").write_text(json.dumps(tool.to_dict(), indent=1))
        file.write_text(task.to_yaml())
        print(file)
    if not chosen.puzzles:
        solution = pushplan.solve(
            task_of(SHOWN, "shown"), pushplan.ToolLibrary.of([PLATE]), effort="draft"
        )
        print(solution)
        assert solution.solved


if __name__ == "__main__":
    main()
