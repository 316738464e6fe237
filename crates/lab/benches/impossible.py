#!/usr/bin/env python3
"""Writes unsolvable tasks of 26 kinds, each impossible by construction.

    python3 crates/lab/benches/impossible.py --out impossible --count 10 --seed 1
    python3 crates/lab/benches/impossible.py --out impossible --solve target/release/pushplan
    python3 crates/lab/benches/impossible.py --out impossible --solve target/release/pushplan --run

A planner that solves one of them is wrong, also in closed loop (`--run`), where masses and
frictions are random and unknown. An error before planning is also correct. Lengths are in metres,
masses in kilograms. Only Python is needed. The exit code is 0 if no task is solved.
"""

import math
import sys

from drawn import Draw, chosen, counts, num, solve, solver, table


def gap_by_little(d, turn=0.0):
    d.turn, r = turn, d.u(0.03, 0.05)
    d.can(0.45, d.u(-0.02, 0.02), r)
    d.gap(0.55, 2 * r - d.u(0.0002, 0.002))
    d.goal(0.56 + r + d.u(0.03, 0.08), 0.0)


def turned_gap(d):
    gap_by_little(d, d.u(-0.8, 0.8))


def prism_gap(d):
    r, n = d.u(0.04, 0.06), d.rng.choice([3, 5, 6, 8])
    corners = [[r * math.cos(math.tau * k / n), r * math.sin(math.tau * k / n)] for k in range(n)]
    across = lambda a: [x * math.cos(a) + y * math.sin(a) for x, y in corners]
    narrow = min(max(across(a)) - min(across(a)) for a in (k * math.pi / 720 for k in range(720)))
    listed = ", ".join(f"[{num(x)}, {num(y)}]" for x, y in corners)
    d.thing("can", f"prism: {{corners: [{listed}], height: 0.08}}", 0.43, 0.0, d.u(-60, 60))
    d.gap(0.55, narrow * d.u(0.7, 0.97))
    d.goal(0.64, 0.0)


def closed_pen(d):
    r, size = d.u(0.025, 0.04), d.u(0.14, 0.2)
    thick = d.u(0.001, 0.02)
    d.can(0.68 - size / 2 - thick - r - 0.02, 0.0, r)
    d.pen(0.68, 0.0, size, size, thick)
    d.goal(0.68, 0.0)


def kerb(d):
    r, size = d.u(0.025, 0.04), d.u(0.14, 0.2)
    d.can(0.68 - size / 2 - 0.01 - r - 0.02, 0.0, r)
    d.pen(0.68, 0.0, size, size, 0.01, d.u(0.004, 0.015))
    d.goal(0.68, 0.0)


def thing_inside_a_kerb(d):
    size = d.u(0.2, 0.3)
    d.can(0.55, 0.0, d.u(0.025, 0.04))
    d.pen(0.55, 0.0, size, size, 0.01, d.u(0.004, 0.015))
    d.goal(0.55 + size / 2 + 0.08, d.u(-0.05, 0.05))


def goal_in_a_block(d):
    r = d.u(0.025, 0.04)
    d.can(0.45, 0.0, r)
    d.wall(0.68, 0.0, 0.14, 0.14)
    d.goal(0.68 + d.u(-0.04, 0.04), d.u(-0.04, 0.04), 0.01)


def wedge(d):
    r = d.u(0.03, 0.045)
    d.can(0.45, 0.0, r)
    for sign in (-1, 1):
        d.wall(0.58, sign * (r + 0.018), 0.3, 0.02, 0.12, -sign * 10)
        d.wall(0.72, sign * (r * 0.7 + 0.6), 0.02, 1.2)
    d.goal(0.8, 0.0)


def pocket_without_room(d):
    a, room = d.u(0.06, 0.09), d.u(0.002, 0.006)
    d.box(0.6, 0.0, a, a)
    inner = a + 2 * room
    d.wall(0.6 + inner / 2 + 0.01, 0.0, 0.02, inner + 0.04)
    for sign in (-1, 1):
        d.wall(0.6 - 0.01, sign * (inner / 2 + 0.01), inner + 0.02, 0.02)
    d.goal(0.6 - a - 0.06, d.u(-0.03, 0.03))


def pen_smaller_than_tools(d):
    r = d.u(0.02, 0.03)
    inner = 2 * r + d.u(0.024, 0.034)
    d.can(0.6, -(inner / 2 - r - 0.003), r)
    d.pen(0.6, 0.0, inner, inner, 0.02)
    d.goal(0.6, inner / 2 - r - 0.003, 0.005)


def crate_between_posts(d):
    a = d.u(0.16, 0.22)
    d.box(0.42, 0.0, a, a, 0.12, mass=d.u(1.0, 4.0))
    spacing = a * d.u(0.8, 0.97) + 0.03
    for k in range(-5, 5):
        d.wall(0.6, (k + 0.5) * spacing, 0.03, 0.03, 0.2)
    d.goal(0.6 + 0.02 + a / 2 + 0.04, 0.0)


def penned_partner(d):
    d.can(0.5, 0.0, 0.03)
    d.can(0.61, 0.0, 0.03, name="partner")
    d.joints.append("{between: [can, partner], kind: fixed}")
    # A fork of walls around the partner, open only where the joint passes, which has no body.
    for sign in (-1, 1):
        d.wall(0.61, sign * 0.045, 0.08, 0.02)
        d.wall(0.56, sign * 0.035, 0.015, 0.04)
    d.wall(0.66, 0.0, 0.015, 0.11)
    d.goal(0.5 - d.u(0.06, 0.1), d.u(-0.08, 0.08))


def joint_limits(d):
    penned_partner(d)
    # A partner that cannot rotate in its pen as far as the goal requires.
    d.objects.pop()
    d.box(0.61, 0.0, 0.06, 0.06, name="partner")
    d.joints[:] = [
        "{between: [partner, can], kind: revolute, at: [0.61, 0], "
        f"limits_deg: [-{num(d.u(3, 8))}, {num(d.u(3, 8))}]}}"
    ]
    d.goals.clear()
    angle = d.rng.choice([-1, 1]) * d.u(0.6, 1.0)
    d.goal(0.61 - 0.11 * math.cos(angle), 0.11 * math.sin(angle), 0.015)


def no_room_for_two(d):
    r = d.u(0.035, 0.05)
    d.can(0.5, 0.12, r)
    d.can(0.5, -0.12, r, name="cup")
    apart = 2 * r - d.u(0.015, 0.03)
    d.goal(0.65, apart / 2, 0.005)
    d.goal(0.65, -apart / 2, 0.005, "cup")
    d.pushes = "length: 0.25, directions: 8, max_count: 3"


def lane(d, width):
    for sign in (-1, 1):
        d.wall(0.62, sign * (width / 2 + 0.01), 0.9, 0.02)


def heading_in_a_lane(d):
    a, b = d.u(0.14, 0.2), d.u(0.04, 0.06)
    d.box(0.5, 0.0, a, b)
    lane(d, d.u(1.2 * b, 0.8 * a))
    d.goal(0.65, 0.0, 0.03, heading=90)


def square_in_a_lane(d):
    a = d.u(0.06, 0.09)
    d.box(0.5, 0.0, a, a)
    lane(d, a * d.u(1.08, 1.28))
    d.goal(0.62, 0.0, 0.03, heading=45)


def weak_arm(d):
    d.can(0.5, 0.0, 0.05, 0.12, mass=d.u(15, 60))
    d.robot += f", max_force: {num(d.u(3, 20))}"
    d.goal(0.6, d.u(-0.05, 0.05))


def crate_behind(d):
    d.can(0.45, 0.0, 0.035)
    d.box(0.57, 0.0, 0.1, 0.1, 0.12, "crate", d.u(30, 80))
    lane(d, 0.112)
    d.robot += f", max_force: {num(d.u(5, 25))}"
    d.goal(0.6, 0.0)


def goal_off_the_table(d):
    d.table += ", size: [0.6, 0.8], position: [0.5, 0]"
    d.can(0.6, 0.0, 0.04)
    d.goal(0.83 + d.u(0, 0.05), d.u(-0.1, 0.1))


def over_the_edge(d):
    # A wall across the whole table; the gaps at its ends are narrower than half the can.
    r = d.u(0.03, 0.045)
    d.table += ", size: [0.7, 0.5], position: [0.6, 0]"
    d.can(0.48, d.u(-0.08, 0.08), r)
    d.wall(0.6, 0.0, 0.03, 0.5 - 2 * d.u(0.2, 0.8) * r)
    d.goal(0.72, d.u(-0.08, 0.08))


def topples(d):
    a = d.u(0.025, 0.035)
    d.table = "friction: 1.0"
    d.box(0.5, 0.0, a, a, d.u(0.26, 0.34))
    d.pushes += f", lift: {num(d.u(0.16, 0.2))}"
    d.goal(0.62, d.u(-0.05, 0.05))


def over_its_head(d):
    height = d.u(0.03, 0.05)
    d.can(0.5, 0.0, 0.04, height)
    d.box(0.7, 0.35, 0.08, 0.08, 0.15, "tower")
    d.pushes += f", lift: {num(height + d.u(0.001, 0.03))}"
    d.goal(0.62, d.u(-0.05, 0.05))


def hand_in_a_block(d):
    long = d.u(0.45, 0.6)
    d.can(0.5, -0.05, 0.012, 0.06)
    d.pen(0.5, 0.0, d.u(0.1, 0.11), long, 0.02, d.u(0.16, 0.3))
    d.goal(0.5, 0.05, 0.01)


def home_in_a_ring(d):
    d.can(0.6, 0.0, 0.04)
    d.pushes = "form: chained, length: 0.2, directions: 8, max_count: 3"
    size = d.u(0.12, 0.2)
    d.pen(0.3, 0.0, size, size, 0.02)
    d.robot = "home: [0.3, 0], reach: {min: 0.1, max: 0.95}"
    d.tools = "[finger, paddle]"
    d.goal(0.68, 0.0)


def ring_of_pegs(d):
    r, n = d.u(0.03, 0.04), 12
    d.can(0.42, 0.0, r)
    side = 2 * r * d.u(0.75, 0.95) + 0.012
    ring = side / (2 * math.sin(math.pi / n))
    for k in range(n):
        d.wall(
            0.68 + ring * math.cos(math.tau * (k + 0.5) / n),
            ring * math.sin(math.tau * (k + 0.5) / n),
            0.012,
            0.012,
            0.12,
            360 * (k + 0.5) / n,
        )
    d.goal(0.68, 0.0)


def long_box_locked_in(d):
    # A corner that is too tight: a box longer than 2.83 w does not pass between two lanes of width
    # w.
    w = d.u(0.065, 0.08)
    a, b = w * d.u(2.9, 3.3), 0.8 * w
    d.box(0.5, 0.0, a, b)
    end = 0.5 + a / 2 + 0.03
    d.wall(end + w + 0.01, 0.25, 0.02, 0.5 + w + 0.04)
    d.wall((0.32 + end + w) / 2, -(w / 2 + 0.01), end + w - 0.32, 0.02)
    d.wall((0.32 + end) / 2, w / 2 + 0.01, end - 0.32, 0.02)
    d.wall(end - 0.01, w / 2 + 0.25, 0.02, 0.46)
    d.goal(end + w / 2, w / 2 + a / 2 + 0.05, 0.03)
    d.pushes = "length: 0.25, directions: 8, max_count: 3"


KINDS = [
    gap_by_little,
    turned_gap,
    prism_gap,
    closed_pen,
    kerb,
    thing_inside_a_kerb,
    goal_in_a_block,
    wedge,
    pocket_without_room,
    pen_smaller_than_tools,
    crate_between_posts,
    penned_partner,
    joint_limits,
    no_room_for_two,
    heading_in_a_lane,
    square_in_a_lane,
    weak_arm,
    crate_behind,
    goal_off_the_table,
    over_the_edge,
    topples,
    over_its_head,
    hand_in_a_block,
    home_in_a_ring,
    ring_of_pegs,
    long_box_locked_in,
]


def main():
    parser = solver(__doc__)
    parser.add_argument(
        "--run",
        action="store_true",
        help="run the tasks in closed loop, with unknown masses and frictions",
    )
    arguments = parser.parse_args()
    verb = ["run", "--world", "1"] if arguments.run else ["solve"]
    wrong, found = 0, {}
    for name, kind in chosen(KINDS, arguments):
        codes = found[name] = []
        for k in range(arguments.count):
            draw = Draw(f"{arguments.seed} {name} {k}")
            kind(draw)
            if arguments.run:
                draw.more.append("unknown: [masses, frictions]")
            path = arguments.out / f"{name}-{k:02}.yaml"
            draw.write(path)
            if arguments.solve:
                options = "--effort", arguments.effort
                code, text = solve(arguments.solve, path, *options, verb=verb)
                codes.append(code)
                if code == 0 and (not arguments.run or ": reached" in text.splitlines()[0]):
                    wrong += 1
                    print(f"  {path.name}: {text.splitlines()[0]}", flush=True)
        if arguments.solve:
            print(f"{name}: {counts(codes)}", flush=True)
    if arguments.solve:
        print(f"{wrong} called solved\n\n{table(found)}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
