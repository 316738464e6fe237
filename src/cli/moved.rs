//! What to write instead of words that went or moved.

use clap::error::{ContextKind, ContextValue, Error};

/// Words, and what does the same now.
const MOVED: [(&[&str], &str); 9] = [
    (
        &["evaluate"],
        "`pushplan predict RECORDINGS` judges models on your own recordings, \
      `pushplan-lab evaluate` on random scenes",
    ),
    (
        &["simulate"],
        "`pushplan predict TASK|PLAN --model planar --alone --out DIR --trajectories` \
      writes what the engine does",
    ),
    (&["schema"], "`pushplan check --schema tool|task|recording|world` prints it"),
    (&["exhaustive"], "`--effort thorough --disturbed 64` does the same"),
    (
        &["generate"],
        "`pushplan-learn generate` makes data, with the same words \
      (in a checkout: cargo run --release -p pushplan-learn -- ...)",
    ),
    (
        &["train"],
        "`pushplan-learn train predictor DIR` makes data and weights \
      (in a checkout: cargo run --release -p pushplan-learn -- ...)",
    ),
    (
        &["train-regulator"],
        "`pushplan-learn train regulator DIR` makes lessons and weights \
      (in a checkout: cargo run --release -p pushplan-learn -- ...)",
    ),
    (
        &["train-lever"],
        "`pushplan-learn train lever DIR` makes data and the shipped weights, \
      `pushplan-lab train memory|parts` other networks \
      (in a checkout: cargo run --release -p pushplan-learn -- ...)",
    ),
    (
        &[
            "tradeoff",
            "random",
            "run",
            "refinement",
            "cost",
            "convergence",
            "levers",
            "hdd",
            "joints",
            "masses",
            "probes",
            "lever-tasks",
            "lever-points",
        ],
        "`pushplan-lab` measures it, with the \
      same word (in a checkout: cargo run --release -p pushplan-lab -- ...)",
    ),
];

/// What to write now, if a word that went or moved is what is wrong.
pub fn now(error: &Error) -> Option<String> {
    let given = [ContextKind::InvalidSubcommand, ContextKind::InvalidValue]
        .into_iter()
        .find_map(|kind| error.get(kind));
    let Some(ContextValue::String(word)) = given else { return None };
    let (_, advice) = MOVED.iter().find(|(words, _)| words.contains(&word.as_str()))?;
    Some(format!("error: there is no `{word}` here any more\n  help: {advice}"))
}
