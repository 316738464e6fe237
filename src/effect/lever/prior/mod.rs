//! Analytic model of a lever-up of a single plate: a small dedicated physics engine.
//!
//! The model has one rigid body, the table as a plane, fixed cuboids around the body, and a blade
//! with prescribed motion. Every step solves (Stewart and Trinkle 1996; by projected Gauss-Seidel,
//! Jourdan, Alart and Jean 1998)
//!
//! ```text
//! M (u' - u) = h f + Jᵀ λ    0 ≤ λ_n ⊥ n·(v' - v_s) + g / h ≥ 0    |λ_t| ≤ μ λ_n, against sliding
//! ```
//!
//! where `u` is the plate's twist, `f` its weight, `g` the gap of a contact and `v_s` the speed of
//! the touched surface. Contacts are
//!
//! - the plate's feet and corners with the table,
//! - the two ends of the blade's tip with the underside, along the underside's normal,
//! - the outline of the underside with the blade's upper face, along the face's normal,
//! - each of the plate's cuboids with each block, as found by parry.
//!
//! Computation is in the lever frame, mirrored if the centre of mass lies to its right, so that
//! rotated and mirrored lever-ups have rotated and mirrored effects. The model omits other plates,
//! blocks around plates that are no cuboids, and contacts of other parts of the blade.

mod body;
mod contacts;
mod model;
mod settings;
mod setup;
mod solver;
mod time_steps;

pub use model::LeverPrior;
pub use settings::PriorSettings;
