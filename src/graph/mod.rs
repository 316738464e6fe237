//! From a solved frame to its graph: nodes, relations and their features, as the network reads
//! them.
//!
//! Only what is awake in a frame is in its graph. Nothing is solved here and nothing is learned.

mod batch;
mod build;
mod features;
mod given;
mod node;
mod relation;

pub use batch::{Batch, GIVEN, NOBODY};
pub use features::{
    GIVEN_EVEN, GIVEN_ODD, NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD, RELATION_EVEN,
    RELATION_ODD,
};
pub use given::Given;
pub use node::{Correction, Node, UNIT};
