//! Schema of the errors of models on recordings.

use super::shape::{Shape, count, list, nullable, number, row, share, span, text, unsigned};

/// Returns the schema of the errors on groups of recordings.
pub(super) fn shape() -> Shape {
    let group = Shape::new()
        .key("names", "Names of the recordings.", list(text()))
        .key(
            "own_spread",
            "Mean final difference of the 2-D engine to itself with a start that is off by 0.1 \
             mm, metres; null if it was not computed.",
            nullable(unsigned()),
        )
        .key("title", "Title for tables.", text())
        .key("trajectories", "Number of trajectories.", count())
        .key("frames", "Mean number of compared frames of a trajectory.", unsigned())
        .key("models", "Errors of each model.", list(model()));
    Shape::new().key("recordings", "Groups of recordings.", group.list())
}

fn model() -> Shape {
    let each = Shape::new()
        .key("error", "Distance from the true to the predicted positions, metres.", unsigned())
        .key("motion", "Distance of the true positions from the start, metres.", unsigned())
        .key("heading_deg", "Heading error, degrees.", nullable(unsigned()))
        .maybe("expected", "Position error predicted by the model, metres.", nullable(unsigned()));
    let point = Shape::new()
        .key("horizon", "Elapsed share of the trajectory's frames.", share())
        .key("error", "Mean error, metres.", unsigned())
        .key("motion", "Mean true distance from the start, metres.", unsigned());
    let drift = Shape::new()
        .key("joints", "Number of joints.", count())
        .key("mean", "Mean violation of the joint, metres.", unsigned())
        .key("max", "Largest violation, metres.", unsigned())
        .key("turn_deg", "Mean relative rotation, degrees.", unsigned());
    Shape::new()
        .key("model", "Effect model.", text())
        .key("all", "Errors over all objects.", phases())
        .key("moved", "Errors over the objects that moved by more than 1 cm.", phases())
        .key("heading_deg", "Mean heading error of moved objects, degrees.", nullable(number()))
        .key("any_heading_deg", "Mean heading error of all objects, degrees.", nullable(number()))
        .key("each", "Errors of each trajectory.", each.list())
        .key("curve", "Mean error by horizon.", point.list())
        .key("overlap", "Largest overlap of two bodies, metres.", unsigned())
        .key("overlap_mean", "Mean of the largest overlaps of trajectories, metres.", unsigned())
        .key("drift", "Drift of fixed, revolute and prismatic joints.", row(drift, 3))
        .key("failed", "Number of trajectories with NaN or infinite predictions.", count())
}

fn phases() -> Shape {
    let errors = Shape::new()
        .key("objects", "Number of objects.", count())
        .key("motion", "Mean true displacement, metres.", unsigned())
        .key("mean", "Mean error, metres.", unsigned())
        .key("median", "Median error, metres.", unsigned())
        .key("p90", "90th percentile of the error, metres.", unsigned())
        .key("p95", "95th percentile of the error, metres.", unsigned())
        .key("relative", "Mean error as a share of the mean motion.", unsigned())
        .key("relative_interval", "95 % interval of `relative`, by bootstrap.", span());
    Shape::new()
        .key("end", "Errors at the final frame; null without objects.", nullable(errors.clone()))
        .key("averaged", "Errors over all frames; null without objects.", nullable(errors))
}
