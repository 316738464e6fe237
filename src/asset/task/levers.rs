//! Lever-ups of a task: keys, parsing, writing, and rules that span several keys.

use serde_json::{Value as Json, json};

use crate::asset::node::Node;
use crate::asset::put::degrees;
use crate::asset::spec::{Key, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::take::number_or;
use crate::task::{LeverRules, Pivot};

use super::goals;

/// Key of the lever-ups that a plan may contain.
pub(super) const LEVERS: Key = Key::optional(
    "levers",
    RULES,
    "The lever-ups that a plan may contain; every key has a default. A goal with `outside`, \
     `raised` or `flipped` also allows them; by default there are none. A plan then has one \
     lever-up, unless `pushes` is given and `tools` also names tools that push.",
);

const RULES: Value = Value::Map(&[
    Key::optional(
        "depth",
        Value::List { of: &DEPTH, items: "depths", min: 2, max: 2 },
        "Smallest and largest depth of the blade's tip behind the edge, metres; default 0.008 and \
         0.020.",
    ),
    Key::optional(
        "angle_deg",
        Value::List { of: &TURN, items: "angles in degrees", min: 2, max: 2 },
        "Smallest and largest rotation of the blade, degrees; default 30 and 150.",
    ),
    Key::optional(
        "pivot",
        Value::Either(&[
            PIVOT_WORD,
            PIVOT_NUMBER,
            Value::List {
                of: &Value::Either(&[PIVOT_WORD, PIVOT_NUMBER]),
                items: "pivots",
                min: 1,
                max: 8,
            },
        ]),
        "Axes about which the blade may rotate, as distances from the edge, inward, in metres \
         (below zero behind the edge, to pry). `auto` is the line about which the plate rotates. \
         Default auto, 0.16 and -0.012.",
    ),
    Key::optional(
        "speed",
        Value::Number(Range {
            what: "a speed in m/s",
            low: 0.01,
            high: 1.0,
            advice: "10 cm/s is 0.10",
        }),
        "Speed of the blade's tip in m/s; default 0.10.",
    ),
    Key::optional(
        "hold",
        Value::Number(Range {
            what: "a time in seconds",
            low: 0.0,
            high: 10.0,
            advice: "a fifth of a second is 0.2",
        }),
        "Time for which the blade stands still at the end, seconds; default 0.2.",
    ),
    Key::optional(
        "retreat",
        Value::Number(Range {
            what: "a distance in metres",
            low: 0.02,
            high: 1.0,
            advice: "10 cm is 0.10",
        }),
        "Distance by which the blade is drawn back along its shaft, and from which it approaches, \
         metres; default 0.10.",
    ),
]);

const PIVOT_WORD: Value = Value::Word(&["auto"]);

const PIVOT_NUMBER: Value = Value::Number(Range {
    what: "a distance in metres",
    low: -0.2,
    high: 1.0,
    advice: "16 cm in front of the edge is 0.16, 12 mm behind it -0.012",
});

/// Range of the blade's depth under an edge.
const DEPTH: Value = Value::Number(Range {
    what: "a depth in metres",
    low: 0.002,
    high: 0.2,
    advice: "12 mm is 0.012",
});

const TURN: Value = Value::Number(Range {
    what: "a rotation in degrees",
    low: 1.0,
    high: 150.0,
    advice: "plates turn over at about 90 degrees",
});

/// Returns `true` if a task with this root allows lever-ups.
pub(super) fn allowed(root: &Node) -> bool {
    root.get("levers").is_some()
        || root.get("goal").is_some_and(|goal| goals::each(goal).iter().any(goals::lifts))
}

/// Reads the rules; the outer `None` if a value is faulty.
pub(super) fn levers(root: &Node) -> Option<Option<LeverRules>> {
    match root.get("levers") {
        Some(node) => given(node).map(Some),
        None => Some(allowed(root).then(LeverRules::default)),
    }
}

fn given(node: &Node) -> Option<LeverRules> {
    let usual = LeverRules::default();
    let pair = |key: &str| match node.get(key).map(Node::items) {
        Some([low, high]) => Some(Some([low.number()?, high.number()?])),
        Some(_) => None,
        None => Some(None),
    };
    Some(LeverRules {
        depth: pair("depth")?.unwrap_or(usual.depth),
        angle: pair("angle_deg")?.map_or(usual.angle, |pair| pair.map(f64::to_radians)),
        pivots: match node.get("pivot") {
            None => usual.pivots,
            Some(list) if !list.items().is_empty() => {
                list.items().iter().map(pivot).collect::<Option<_>>()?
            }
            Some(one) => vec![pivot(one)?],
        },
        speed: number_or(node, "speed", usual.speed)?,
        hold: number_or(node, "hold", usual.hold)?,
        retreat: number_or(node, "retreat", usual.retreat)?,
    })
}

fn pivot(node: &Node) -> Option<Pivot> {
    match node.text() {
        Some(_) => Some(Pivot::Auto),
        None => node.number().map(Pivot::At),
    }
}

/// Returns the rules as in a task file.
pub(in crate::asset) fn emitted_levers(rules: &LeverRules) -> Json {
    let pivot = |pivot: &Pivot| match pivot {
        Pivot::Auto => json!("auto"),
        Pivot::At(distance) => json!(distance),
    };
    json!({
        "depth": rules.depth,
        "angle_deg": rules.angle.map(degrees),
        "pivot": rules.pivots.iter().map(pivot).collect::<Vec<_>>(),
        "speed": rules.speed,
        "hold": rules.hold,
        "retreat": rules.retreat,
    })
}

/// Reports intervals whose limits are in the wrong order.
pub(super) fn check(levers: &Node, ledger: &mut Ledger) {
    for key in ["depth", "angle_deg"] {
        let Some(node) = levers.get(key) else { continue };
        if let [low, high] = node.items()
            && let (Some(low), Some(high)) = (low.number(), high.number())
            && low > high
        {
            let message = format!("the smallest, {low}, is above the largest, {high}");
            ledger.fault(node, message, "swap them");
        }
    }
    let pivots = levers.get("pivot").map(Node::items).unwrap_or_default();
    for (k, node) in pivots.iter().enumerate() {
        if pivots[..k].iter().any(|before| before.content == node.content) {
            ledger.fault(node, "this pivot is given twice", "remove one of the two");
        }
    }
}

/// Reports pushes that cannot follow a lever-up: they must be placed from above, and the goal must
/// state a position.
pub(super) fn check_follow_up(pushes: &Node, goal: &Node, ledger: &mut Ledger) {
    if let Some(node) = pushes.get("form").filter(|form| form.text() == Some("chained")) {
        let message = "pushes that follow a lever-up are placed and cannot continue from `home`";
        ledger.fault(node, message, "remove `form`");
    }
    let wanted = ["position", "region", "gap", "coverage", "off_table", "joint", "joint_deg"];
    if goal.get("object").is_some() && !wanted.iter().any(|key| goal.get(key).is_some()) {
        let message = "pushes may follow, but the goal states no position to push to";
        ledger.fault(pushes, message, "add `position` and `tolerance` to the goal, or remove this");
    }
}
