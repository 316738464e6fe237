//! Planar vectors.

/// A planar vector or position, metres.
pub type Vector = nalgebra::Vector2<f64>;
