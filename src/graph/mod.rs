//! From a solved frame to its graph: nodes, relations and their features, as the network reads
//! them.
//!
//! Only what is awake in a frame is in its graph. Nothing is solved here and nothing is learned.

mod batch;
mod build;
mod features;
mod node;
mod relation;

pub use batch::{Batch, KINEMATIC};
pub use features::{NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD, RELATION_EVEN, RELATION_ODD};
pub use node::{Node, UNIT};
