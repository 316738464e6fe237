//! The rooms of the crate, for reading and for experiments; nothing here is promised to stay.
//!
//! Each imports only from rooms before it, in this order:
//!
//! geometry, scene, task, outcome, arm, recording, asset, store, sim, contact, graph, network, rollout, effect, judge,
//! fit, belief, plan, verify, solve, design, act, bench, report

#[doc(inline)]
pub use crate::{
    act, arm, asset, belief, bench, contact, design, effect, fit, geometry, graph, judge, network,
    outcome, plan, recording, report, rollout, scene, seeded, sim, solve, store, task, verify,
    watch,
};
