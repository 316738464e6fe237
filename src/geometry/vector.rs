//! Planar vectors.

/// A planar vector or position, metres.
pub type Vector = nalgebra::Vector2<f64>;

/// Returns the distance between the origin and the segment between two points, metres.
pub fn distance_to_origin(from: Vector, to: Vector) -> f64 {
    let way = to - from;
    let square = way.norm_squared();
    let t = if square > 0.0 { (-from.dot(&way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (from + way * t).norm()
}
