//! The modules of the crate, for reading and for experiments; none of them is stable.
//!
//! Each module imports only from modules before it, in this order:
//!
//! geometry, scene, task, outcome, recording, asset, sim, contact, graph, network, rollout, effect,
//! plan, verify, solve

#[doc(inline)]
pub use crate::{
    asset, contact, effect, geometry, graph, network, outcome, plan, progress, recording, rollout,
    scene, seeded, sim, solve, task, verify,
};
