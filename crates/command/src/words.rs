//! The words of the command line that stand for values, each with its line in `--help`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use pushplan::effect::Outside;
use pushplan::scene::Engine;
use pushplan::solve::Effort;
use pushplan_act::act::ProbeRule;
use pushplan_bench::Layout;
use pushplan_report::PageView;

/// Words, what they stand for, and what that means.
pub type Words<T> = [(&'static str, T, &'static str)];

/// How hard to try.
pub static EFFORTS: [(&str, Effort, &str); 3] = [
    ("draft", Effort::Draft, "A first look"),
    ("standard", Effort::Standard, "Enough for most tasks"),
    (
        "thorough",
        Effort::Thorough,
        "Longer: the network in every rollout, more replays to tell robustness",
    ),
];

/// What to do where a model should not be trusted.
pub static OUTSIDE: [(&str, Outside, &str); 3] = [
    ("simulate", Outside::Simulate, "Simulate in the plane instead"),
    ("warn", Outside::Warn, "Predict and warn"),
    ("refuse", Outside::Refuse, "Give no prediction; exit code 6"),
];

/// What a page shows of the table.
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

/// Ways to choose a push that is made only to learn something.
pub static PROBES: [(&str, ProbeRule, &str); 5] = [
    ("task", ProbeRule::Task, "Tells apart the samples in which different plans work"),
    ("information", ProbeRule::Information, "Tells the most, whatever the task"),
    ("random", ProbeRule::Random, "By chance"),
    ("uncertain", ProbeRule::Uncertain, "At the pair whose joint is least certain"),
    ("motion", ProbeRule::Motion, "Moves objects farthest"),
];

/// Where the cylinder of the tool benchmark starts.
pub static LAYOUTS: [(&str, Layout, &str); 2] = [
    ("grid", Layout::Grid, "On the reference's grid, where flat faces meet it nearly always"),
    ("scattered", Layout::Scattered, "Anywhere within its cell of that grid"),
];

/// Reads one of these words.
pub fn words<T>(table: &'static Words<T>) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
{
    let values = table.iter().map(|(word, _, meaning)| PossibleValue::new(*word).help(*meaning));
    PossibleValuesParser::new(values).try_map(|given| {
        let known = table.iter().find(|(word, ..)| *word == given);
        known.map(|(_, value, _)| value.clone()).ok_or_else(|| format!("`{given}` is not known"))
    })
}
