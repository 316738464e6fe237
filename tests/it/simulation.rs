//! The two engines: comparison with closed forms, symmetries and repeatability.

mod contacts;
mod determinism;
mod energy;
mod joint_drift;
mod joint_limits;
mod joints;
mod rapier_035_friction_direction;
mod sequences;
mod sliding;
mod supports;
mod symmetry;
mod travel;
