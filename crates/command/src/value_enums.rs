//! Names of values on the command line, each with its line in `--help`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use pushplan::effect::OutOfRange;
use pushplan::scene::Engine;
use pushplan::solve::Effort;
use pushplan_act::act::ProbeRule;
use pushplan_bench::Layout;
use pushplan_report::PageView;

/// Words, their values and their descriptions.
pub type ValueTable<T> = [(&'static str, T, &'static str)];

/// Levels of effort.
pub static EFFORTS: [(&str, Effort, &str); 3] = [
    ("draft", Effort::Draft, "Fast, for a first impression"),
    ("standard", Effort::Standard, "Enough for most tasks"),
    ("thorough", Effort::Thorough, "Slower: the network in every rollout, more perturbed replays"),
];

/// Policies outside of a model's range.
pub static OUT_OF_RANGE: [(&str, OutOfRange, &str); 3] = [
    ("simulate", OutOfRange::Simulate, "Simulate in 2-D instead"),
    ("warn", OutOfRange::Warn, "Predict and warn"),
    ("refuse", OutOfRange::Refuse, "Decline to predict; exit code 6"),
];

/// Views of the table on a page.
pub static VIEWS: [(&str, PageView, &str); 2] = [
    ("2d", PageView::Above, "Drawing from above"),
    ("3d", PageView::Solid, "Drawing from above, and a 3-D scene that can be rotated"),
];

/// Simulation engines.
pub static ENGINES: [(&str, Engine, &str); 3] = [
    ("planar", Engine::Planar, "2-D engine, fast"),
    ("3d", Engine::Spatial, "3-D engine"),
    (
        "3d-upright",
        Engine::Upright,
        "3-D engine without tipping: the 2-D physics in independent code",
    ),
];

/// Physics that judges a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judge {
    /// Engines of pushplan.
    BuiltIn,
    /// MuJoCo, beside the engines of pushplan.
    Mujoco,
}

/// Physics that `verify` can ask.
pub static JUDGES: [(&str, Judge, &str); 2] = [
    ("built-in", Judge::BuiltIn, "2-D and 3-D engine of pushplan"),
    ("mujoco", Judge::Mujoco, "Second opinion by the MuJoCo of a Python"),
];

/// Rules for choosing exploratory pushes.
pub static PROBES: [(&str, ProbeRule, &str); 5] = [
    ("task", ProbeRule::Task, "Distinguish the samples in which different plans work"),
    ("information", ProbeRule::Information, "Gain the most information, regardless of the task"),
    ("random", ProbeRule::Random, "Choose at random"),
    ("uncertain", ProbeRule::Uncertain, "Push the pair with the least certain joint"),
    ("motion", ProbeRule::Motion, "Move objects farthest"),
];

/// Layouts of the cylinder's starts in the tool benchmark.
pub static LAYOUTS: [(&str, Layout, &str); 2] = [
    (
        "grid",
        Layout::Grid,
        "On the reference grid, where flat faces nearly always meet the cylinder",
    ),
    ("scattered", Layout::Scattered, "At random within the cell of the reference grid"),
];

/// Returns a parser of the words of a table.
pub fn possible_values<T>(table: &'static ValueTable<T>) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
{
    let values = table.iter().map(|(word, _, meaning)| PossibleValue::new(*word).help(*meaning));
    PossibleValuesParser::new(values).try_map(|given| {
        let known = table.iter().find(|(word, ..)| *word == given);
        known.map(|(_, value, _)| value.clone()).ok_or_else(|| format!("unknown value `{given}`"))
    })
}
