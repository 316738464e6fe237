//! Conversion of a solved frame into its graph: nodes, relations and their features, the input of
//! the network.
//!
//! The graph of a frame contains only awake objects. This module neither solves nor learns.

mod batch;
mod build;
mod features;
mod node;
mod prescribed;
mod relation;

pub use batch::{Batch, GIVEN, NOBODY};
pub use features::{
    GIVEN_EVEN, GIVEN_ODD, NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD, RELATION_EVEN,
    RELATION_ODD,
};
pub use node::{Correction, Corrections, Node, READOUTS, UNIT};
pub use prescribed::PrescribedNode;
