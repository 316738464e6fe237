//! Schema of the belief after a recording.

use super::shape::{
    Shape, count, flag, list, nullable, number, row, share, text, unsigned, variant, words,
};

/// Returns the schema of a belief.
pub(super) fn shape() -> Shape {
    let types = words(&["none", "fixed", "revolute", "prismatic"]);
    let pair = || row(count(), 2);
    let joint = Shape::new()
        .key("between", "Indices of the objects.", pair())
        .key("kind", "Kind, with axis in metres and limits in radians or metres.", variant())
        .key("guessed", "Whether only the kind is known.", flag());
    let step = Shape::new()
        .key("observations", "Number of observations processed so far.", count())
        .key("probabilities", "Probabilities of `types` for each pair.", probabilities())
        .key(
            "evidence",
            "Log-likelihood of each type relative to the best; null if neither object moved.",
            list(nullable(row(number(), 4))),
        );
    let ratio = Shape::new().key("between", "Indices of the objects.", pair()).key(
        "log",
        "Mean and standard deviation of the logarithm of the ratio.",
        row(number(), 2),
    );
    let masses = Shape::new()
        .key("ranges", "Mass ranges, kg.", list(row(unsigned(), 2)))
        .key(
            "objects",
            "Probabilities of the ranges for each object; null without a touch.",
            list(nullable(list(share()))),
        )
        .key("ratios", "Mass ratios of pairs that touched.", ratio.list());
    Shape::new()
        .key("objects", "Names of the objects.", list(text()))
        .key("pairs", "Pairs of indices that may be joined.", list(pair()))
        .key("types", "Types in the order of the probabilities.", list(types))
        .key("probabilities", "Probabilities of `types` for each pair.", probabilities())
        .key("joints", "Most probable joints.", joint.list())
        .key("history", "Belief after each evaluation.", step.list())
        .key("note", "Reason why nothing was inferred, in words.", nullable(text()))
        .maybe("masses", "Belief about masses, with `--mass-ranges`.", masses)
}

fn probabilities() -> serde_json::Value {
    list(row(share(), 4))
}
