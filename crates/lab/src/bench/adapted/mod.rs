//! What a network gains that is fitted to recordings of a table, on pushes that it has not seen.
//!
//! Compared with the prior as shipped, the prior after `fit` of friction and support, and the
//! network after the same, without a head.

mod measure;
mod summary;

pub use measure::{AdaptedPush, Split, measure_split, splits};
pub use summary::{AdaptedRow, Ratio, adapted_rows};
