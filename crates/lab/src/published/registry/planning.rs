//! Tables of plans.

use super::super::table::{ALL, Published, table};
use super::inputs::{PLANS, RUNS};

/// Results of tool choices.
const CHOICES: &[&str] = &["choice", "2-D", "3-D", "largest", "≤ 5 cm#1", "pushes"];

/// Tables of plans.
#[rustfmt::skip] // a table in a few lines each
pub const TABLES: &[Published] = &[
    table("random-tasks", "random-tasks.md", (9, 600, "tasks"), PLANS,
        "pushplan-lab random --count 600", &[
            ("By kind and method", &["kind", "tasks", "solved", "within, 3-D", "predicted, mean",
            "3-D, mean", "3-D, median", "3-D, p95"], &["| prior,", "network"]),
            ("By kind and method", &["kind", "method", "within, 3-D", "3-D, mean"],
            &["| all | random", "| all | do nothing"]),
            ("Cost of planning", &["kind", "fragile", "pushes", "attempts", "rollouts", "search",
            "refinement", "verification", "time", "time, p95"], ALL),
        ]),
    table("shipped-tasks", "shipped-tasks.md", (3, 51, "tasks"), PLANS,
        "pushplan bench tasks tasks/*.yaml", &[
            ("tasks solved", &["task", "status", "tool", "2-D", "3-D", "allowed", "time"],
            &["no plan", "| 2 |"]),
        ]),
    table("everyday", "everyday.md", (30, 300, "tasks"), PLANS,
        "KIND=everyday crates/lab/benches/mujoco runs/everyday 300 7", &[]),
    table("impossible", "impossible.md", (24, 130, "tasks"), PLANS,
        "python3 crates/lab/benches/impossible.py --out runs/impossible --count 5 \
         --solve pushplan || [ $? = 1 ]", &[]),
    table("around", "impossible.md", (10, 120, "tasks"), PLANS,
        "python3 crates/lab/benches/around.py --out runs/around --count 10 --seed 11 \
         --solve pushplan || [ $? = 1 ]", &[]),
    table("edited", "impossible.md", (3, 300, "edited plans"), PLANS,
        "python3 crates/lab/benches/edited.py runs/mujoco/plans --out runs/edited \
         --verify pushplan || [ $? = 1 ]", &[]),
    table("tool-choice", "tool-choice.md", (10, 118, "tasks"), PLANS,
        "pushplan bench tools --tasks all", &[
            ("All tool poses together", CHOICES, ALL),
            ("Each tool pose alone", &["tool, choice", "3-D", "≤ 5 cm#1", "pushes"],
            &[", planned"]),
        ]),
    table("tool-choice-scattered", "tool-choice-scattered.md", (10, 142, "tasks"), PLANS,
        "pushplan bench tools --layout scattered --tasks all", &[
            ("All tool poses together", CHOICES, ALL),
        ]),
    table("tool-choice-single", "tool-choice-scattered.md", (2, 48, "tasks"), PLANS,
        "pushplan bench tools --form single --tasks 48", &[
            ("All tool poses together", CHOICES, ALL),
            ("Each tool pose alone", &["tool, choice", "3-D", "≤ 5 cm#1", "pushes"],
            &[", oracle", ", planned"]),
        ]),
    table("refinement", "refinement.md", (3, 200, "tasks"), PLANS,
        "pushplan-lab refinement --model network", &[
            ("", &["plans", "solved", "on all supports", "predicted", "2-D", "3-D", "median", "p95",
            "replays per task", "rollouts"], ALL),
        ]),
    table("designed-tools", "designed-tools.md", (12, 40, "tasks"), PLANS,
        "python crates/lab/benches/design.py --out runs/designed --solve pushplan --mujoco python",
            &[]),
    table("push-t", "benchmarks.md", (15, 50, "games"), PLANS,
        "python examples/push_t.py --seeds 100000 100050", &[
            ("", ALL, &["covered, "]),
        ]),
    table("pushworld", "benchmarks.md", (55, 196, "puzzles"), PLANS,
        "for set in level1 'level1 --as-played' levels2to4 'levels2to4 --seconds 40'; do python \
         crates/lab/benches/puzzles.py $set --solve pushplan --mujoco python; done", &[
            ("", ALL, &[" of "]),
        ]),
    table("puzzles", "benchmarks.md", (15, 90, "puzzles"), PLANS,
        "for kind in goals swap heap; do for n in 2 4 8; do python crates/lab/benches/puzzles.py \
         --kind $kind --objects $n --count 10 --solve pushplan --mujoco python; done; done", &[
            ("", ALL, &[" of "]),
        ]),
    table("kinder", "benchmarks.md", (35, 50, "episodes of an environment"), PLANS,
        "for name in DynPushT2D-t1 DynPushPullHook2D-o0 DynPushPullHook2D-o1 \
         DynPushPullHook2D-o5 PushPullHook2D StickButton2D-b1 StickButton2D-b2 StickButton2D-b3 \
         StickButton2D-b5 StickButton2D-b10; do python examples/kinder_2d.py $name --seeds 1000 \
         1050; done", &[
            ("", ALL, &["reached, median"]),
        ]),
    table("tool-tasks", "tool-tasks.md", (54, 260, "tasks"), PLANS,
        "python crates/lab/benches/board.py --out runs/board", &[
            ("Programs", ALL, ALL),
            ("Kinds", ALL, ALL),
        ]),
    table("agent-calls", "agents.md", (5, 1000, "calls"), PLANS,
        "python crates/python/tests/mcp_fuzz.py --count 1000 --seed 20261130", &[]),
    table("agent-repairs", "agents.md", (13, 200, "broken tasks"), PLANS,
        "python crates/lab/benches/repairs.py --count 200 --seed 10320 || [ $? = 1 ]", &[]),
    table("robot-arms", "robot-arms.md", (8, 49, "tasks an arm"), PLANS,
        "python crates/lab/benches/arms.py --effort draft --out runs/arms", &[
            ("", ALL, &["pinocchio_agrees"]),
        ]),
    table("robot-arms-mujoco", "robot-arms.md", (15, 98, "tasks"), PLANS,
        "python crates/lab/benches/arms.py --arms panda --mujoco --out runs/arms-mujoco", &[
            ("", ALL, &["reached_in_mujoco"]),
        ]),
    table("public-arms", "robot-arms.md", (7, 107, "feasible tasks"), PLANS,
        "python crates/lab/benches/public_arms.py --program pushplan --out runs/public-arms", &[]),
    table("camera-loop", "robot-arms.md", (5, 20, "scenes"), RUNS,
        "python examples/robot/run.py --scenes 20 --seed 20261127", &[
            ("", ALL, &["\"falsely_reached\""]),
        ]),
];
