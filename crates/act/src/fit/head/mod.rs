//! Bayesian linear head on the propagated states of a frozen network, from recorded pushes.
//!
//! The parameters θ of the head have the prior N(0, s² I). The final poses of a recorded push are
//! y = J θ + noise, with J from [`Sensitivity`] and Student's noise. This regression is solved by
//! iterative reweighting (Lange, Little and Taylor 1989, doi:10.2307/2290063).
//!
//! The deviation s is chosen by rollouts of held-out pushes. No head is among the candidates; the
//! change of another is shrunk by the uncertainty of its gain.

mod learn;
mod observed;
mod regression;
mod sensitivity;

pub use learn::{Basis, HeadSettings, learn};
pub use sensitivity::Sensitivity;
