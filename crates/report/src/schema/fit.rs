//! Schema of parameters fitted to recordings.

use super::shape::{
    Shape, count, flag, list, nullable, share, span, text, unsigned, variant, words,
};

/// Returns the schema of a fit.
pub(super) fn shape() -> Shape {
    let axis = Shape::new().key("span", "Range of the values.", span()).key(
        "count",
        "Number of values.",
        count(),
    );
    let grid = Shape::new().key("spread", "Values of the spread.", axis.clone()).key(
        "friction",
        "Values of the friction coefficient.",
        axis,
    );
    let posterior = Shape::new().key("grid", "Grid of the cells.", grid).key(
        "probabilities",
        "Probability of every cell; the sum is 1.",
        list(share()),
    );
    let settings = Shape::new()
        .key("spread", "Range of the spread, with a uniform prior.", span())
        .key("friction", "Range of the friction, with a uniform prior.", span())
        .key("values", "Number of values of an axis.", count())
        .key("law", "Distribution of the errors.", words(&["student", "gaussian"]))
        .key("noise", "Stated width of the noise, metres.", nullable(unsigned()));
    let fit = Shape::new()
        .key("by", "Effect model.", text())
        .key("settings", "Ranges and assumptions.", settings)
        .key("recordings", "Number of recordings.", count())
        .key("moved", "Number of objects that move.", count())
        .key("motion", "Mean displacement of these objects, metres.", unsigned())
        .key("noise", "Width of the noise, metres.", unsigned())
        .key("spread", "Support radius as a share of the corners' distance.", estimate())
        .key("friction", "Friction coefficient of pusher and objects.", estimate())
        .key("rough", "Posterior over the whole range.", posterior.clone())
        .key("fine", "Posterior over the probable part.", posterior)
        .key("best", "Errors with the most probable parameters.", errors())
        .key("even", "Errors with uniform pressure.", errors())
        .key("corners", "Errors with corner support.", errors())
        .key("stated", "Errors with the stated supports.", stated());
    Shape::new().key("fit", "Estimates, posterior and errors.", fit).key(
        "friction",
        "Friction coefficient of pusher and objects that counts: the one for the fitted spread if \
         the recordings identify it, otherwise the one for the supports as stated.",
        unsigned(),
    )
}

fn estimate() -> Shape {
    Shape::new()
        .key("best", "Most probable value.", unsigned())
        .key("mean", "Posterior mean.", unsigned())
        .key("deviation", "Posterior standard deviation.", unsigned())
        .key("interval", "Central interval with a probability of 0.9.", span())
        .key("identified", "Whether the recordings identify the parameter.", flag())
        .key("at_the_end", "Whether the best value is at the end of the range.", flag())
}

fn errors() -> Shape {
    remaining().key("support", "Support of all objects.", variant())
}

fn stated() -> Shape {
    remaining().key("likelier", "Whether the recordings favour the stated supports.", flag())
}

fn remaining() -> Shape {
    Shape::new()
        .key("friction", "Friction coefficient that fits this support best.", unsigned())
        .key("mean", "Mean error, metres.", unsigned())
        .key("median", "Median error, metres.", unsigned())
}
