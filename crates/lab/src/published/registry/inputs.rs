//! Inputs that several tables share.

use super::super::table::Input;

/// Predictions of pushes.
pub const PUSHES: &[Input] = &[Input::Network, Input::Predictions];

/// Plans of pushes.
pub const PLANS: &[Input] = &[Input::Network, Input::Predictions, Input::Plans];

/// Lever-ups by the network and in the engine.
pub const LEVERS: &[Input] = &[Input::Lever, Input::LeverUps];

/// Beliefs about joints and masses.
pub const BELIEFS: &[Input] = &[Input::Network, Input::Regulator, Input::Beliefs];

/// Closed loops, which plan and believe.
pub const RUNS: &[Input] = &[Input::Network, Input::Regulator, Input::Plans, Input::Beliefs];
