//! What a lever-up does to a single plate on the table: a small engine for exactly this.
//!
//! One rigid body, the table as a plane, cuboids fixed around it, and a blade whose motion is given. In
//! every step (Stewart and Trinkle 1996; solved by projected Gauss-Seidel, Jourdan, Alart and Jean 1998)
//!
//! ```text
//! M (u' - u) = h f + Jᵀ λ    0 ≤ λ_n ⊥ n·(v' - v_s) + g / h ≥ 0    |λ_t| ≤ μ λ_n, against sliding
//! ```
//!
//! where `u` is the plate's twist, `f` its weight, `g` the gap of a contact and `v_s` the speed of
//! what the plate touches there. Contacts are
//!
//! - the plate's feet and corners with the table,
//! - the two ends of the blade's tip with the underside, along the underside's normal,
//! - the outline of the underside with the blade's upper face, along the face's normal,
//! - where there are blocks, each of the plate's cuboids with each of them, as parry finds them.
//!
//! All is computed in the lever frame, mirrored if the centre of mass lies to its right, so that
//! turned and mirrored lever-ups have turned and mirrored effects. Not here: other plates, blocks
//! around plates that are no cuboids, and whatever else of the blade may touch.

mod body;
mod contacts;
mod march;
mod model;
mod settings;
mod setup;
mod solver;

pub use model::LeverPrior;
pub use settings::PriorSettings;
