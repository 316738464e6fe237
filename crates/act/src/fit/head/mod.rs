//! A Bayesian linear head on the hidden rows of a frozen network, from recorded pushes.
//!
//! θ, the change of the last layer, has the prior N(0, s² I). Where a recorded push ends, y = J θ +
//! noise, with J from [`Sensitivity`] and noise by Student's law: a
//! regression whose weights are found by reweighting (Lange, Little and Taylor 1989,
//! doi:10.2307/2290063), taken anew around each mean (Gauss and Newton). s is chosen by rollouts of pushes
//! that are left out; no head at all is among the choices, and is kept unless another one is
//! better by more than two standard errors (Breiman et al. 1984, section 3.4.3, take one).

mod learn;
mod observed;
mod regression;
mod sensitivity;

pub use learn::{Basis, HeadSettings, learn};
pub use sensitivity::Sensitivity;
