//! Benefit of fitting a network to recordings of a table, on unseen pushes.
//!
//! The baselines are the analytic model as shipped, the analytic model after `fit` of friction and
//! support, and the network after the same fit, without a head.

mod measure;
mod summary;

pub use measure::{AdaptedPush, Split, measure_split, splits};
pub use summary::{AdaptedRow, Ratio, adapted_rows};
