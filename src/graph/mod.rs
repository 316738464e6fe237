//! Scene and state to a graph: nodes, relations, their features, and the quasi-static prior
//! that the network corrects.
//!
//! Only what moves is in the graph: objects that nothing can push in a frame coast in closed
//! form or stay, exactly. Nothing is learned here.

mod awake;
mod batch;
mod bodies;
mod build;
mod coast;
mod constraint;
mod contact;
mod features;
mod joint;
mod march;
mod midway;
mod node;
mod prior;
mod relation;
mod subset;
mod system;
mod unknown;

pub use batch::{Batch, KINEMATIC, Touch};
pub use bodies::{Bodies, Jointed, Motion, Movable};
pub use build::{add_graph, add_prior};
pub use coast::coast;
pub use contact::MARGIN;
pub use features::{NODE_EVEN, NODE_ODD, OUTPUT_EVEN, OUTPUT_ODD, RELATION_EVEN, RELATION_ODD};
pub use node::Node;
pub use subset::Subset;
