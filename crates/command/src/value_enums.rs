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
    ("draft", Effort::Draft, "A first look"),
    ("standard", Effort::Standard, "Enough for most tasks"),
    (
        "thorough",
        Effort::Thorough,
        "Longer: the network in every rollout, more replays to tell robustness",
    ),
];

/// Policies outside of a model's range.
pub static OUT_OF_RANGE: [(&str, OutOfRange, &str); 3] = [
    ("simulate", OutOfRange::Simulate, "Simulate in the plane instead"),
    ("warn", OutOfRange::Warn, "Predict and warn"),
    ("refuse", OutOfRange::Refuse, "Give no prediction; exit code 6"),
];

/// Views of the table on a page.
pub static VIEWS: [(&str, PageView, &str); 2] = [
    ("2d", PageView::Above, "A drawing from above"),
    ("3d", PageView::Solid, "The same, and a scene to look at from all sides"),
];

/// Simulation engines.
pub static ENGINES: [(&str, Engine, &str); 3] = [
    ("planar", Engine::Planar, "Top-down, fast"),
    ("3d", Engine::Spatial, "Full 3-D"),
    (
        "3d-upright",
        Engine::Upright,
        "3-D, but nothing tips: the physics of the plane in other code",
    ),
];

/// Rules for choosing exploratory pushes.
pub static PROBES: [(&str, ProbeRule, &str); 5] = [
    ("task", ProbeRule::Task, "Tells apart the samples in which different plans work"),
    ("information", ProbeRule::Information, "Tells the most, whatever the task"),
    ("random", ProbeRule::Random, "By chance"),
    ("uncertain", ProbeRule::Uncertain, "At the pair whose joint is least certain"),
    ("motion", ProbeRule::Motion, "Moves objects farthest"),
];

/// Layouts of the cylinder's starts in the tool benchmark.
pub static LAYOUTS: [(&str, Layout, &str); 2] = [
    ("grid", Layout::Grid, "On the reference's grid, where flat faces meet it nearly always"),
    ("scattered", Layout::Scattered, "Anywhere within its cell of that grid"),
];

/// Returns a parser of the words of a table.
pub fn possible_values<T>(table: &'static ValueTable<T>) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
{
    let values = table.iter().map(|(word, _, meaning)| PossibleValue::new(*word).help(*meaning));
    PossibleValuesParser::new(values).try_map(|given| {
        let known = table.iter().find(|(word, ..)| *word == given);
        known.map(|(_, value, _)| value.clone()).ok_or_else(|| format!("`{given}` is not known"))
    })
}
