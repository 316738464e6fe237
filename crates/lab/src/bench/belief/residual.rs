//! Geometric residual tests, the baseline: the joint that best explains all observed relative poses
//! of a pair, without physics.
//!
//! After Sturm, Stachniss and Burgard (JAIR 41, 2011). Every type of joint is fitted by least
//! squares, and the one with the smallest Bayesian information criterion k ln n - 2 ln L is
//! selected. Free coordinates of a joint, and all coordinates without a joint, have a wide
//! distribution around their mean.

use nalgebra::{DMatrix, DVector, Matrix2, Rotation2, Vector3};

use pushplan::internals::{
    geometry::{Pose, Vector, wrap_angle},
    scene::{ObservedPose, Scene},
    task::{Noise, Observation},
};
use pushplan_act::belief::JointType;

/// Play of joints in addition to the noise, as standard deviations: metres and radians.
const PLAY: [f64; 2] = [3e-4, 5e-3];

/// Spread of free coordinates around their mean, as standard deviations: metres and radians.
const FREE: [f64; 2] = [0.05, 0.5];

/// Ridge of the anchors' fit: without rotation the anchor is undetermined.
const RIDGE: f64 = 1e-6;

/// Returns the types of `pairs` of objects of `scene` by geometric residual tests on all
/// observations `seen` with this noise. The type is *none* for pairs never observed with both
/// headings.
pub fn residual_types(
    scene: &Scene,
    pairs: &[[usize; 2]],
    seen: &[Observation],
    noise: Noise,
) -> Vec<JointType> {
    let sd = [noise.position.hypot(noise.position), noise.heading.hypot(noise.heading)];
    let of = |pair: &[usize; 2]| {
        let [first, second] = pair.map(|k| &scene.objects[k].pose);
        let mut poses = vec![relative(first, second)];
        for observation in seen {
            let sight = |sight: ObservedPose| {
                sight.heading.map(|heading| Pose { position: sight.position, heading })
            };
            if let [Some(one), Some(other)] = pair.map(|k| observation.seen[k].and_then(sight)) {
                let last = poses.last().map_or(0.0, |pose: &Vector3<f64>| pose.z);
                let mut now = relative(&one, &other);
                now.z = last + wrap_angle(now.z - last);
                poses.push(now);
            }
        }
        likeliest(&poses, [sd[0].hypot(PLAY[0]), sd[1].hypot(PLAY[1])])
    };
    pairs.iter().map(of).collect()
}

/// Returns the pose of a second object in the frame of a first: position (metres) and heading
/// (radians).
fn relative(first: &Pose, second: &Pose) -> Vector3<f64> {
    let position = first.local_point(second.position);
    Vector3::new(position.x, position.y, second.heading - first.heading)
}

/// Returns the type of joint that explains these relative poses best.
fn likeliest(poses: &[Vector3<f64>], held: [f64; 2]) -> JointType {
    if poses.len() < 2 {
        return JointType::None;
    }
    let n = poses.len() as f64;
    let mean = poses.iter().sum::<Vector3<f64>>() / n;
    let off = |pose: &Vector3<f64>| pose - mean;
    // -2 ln of a normal density, without its constant.
    let cost = |error: f64, sd: f64| (error / sd).powi(2) + 2.0 * sd.ln();
    let [free, free_turn] = FREE;
    let sum = |of: &dyn Fn(&Vector3<f64>) -> f64| poses.iter().map(of).sum::<f64>();

    let none = sum(&|pose| {
        let off = off(pose);
        cost(off.x, free) + cost(off.y, free) + cost(off.z, free_turn)
    });
    let fixed = sum(&|pose| {
        let off = off(pose);
        cost(off.x, held[0]) + cost(off.y, held[0]) + cost(off.z, held[1])
    });
    let axis = main_axis(poses, &mean);
    let prismatic = sum(&|pose| {
        let off = off(pose);
        let (along, across) = (axis.dot(&off.xy()), axis.perp(&off.xy()));
        cost(across, held[0]) + cost(along, free) + cost(off.z, held[1])
    });
    let anchor = anchors(poses);
    let revolute = sum(&|pose| {
        let off_anchor = pose.xy() + Rotation2::new(pose.z) * anchor[1] - anchor[0];
        cost(off_anchor.x, held[0]) + cost(off_anchor.y, held[0]) + cost(pose.z - mean.z, free_turn)
    });
    [
        (none, 0.0, JointType::None),
        (fixed, 3.0, JointType::Fixed),
        (revolute, 4.0, JointType::Revolute),
        (prismatic, 3.0, JointType::Prismatic),
    ]
    .into_iter()
    .min_by(|a, b| (a.0 + a.1 * n.ln()).total_cmp(&(b.0 + b.1 * n.ln())))
    .map_or(JointType::None, |(.., kind)| kind)
}

/// Returns the direction in which positions vary most.
fn main_axis(poses: &[Vector3<f64>], mean: &Vector3<f64>) -> Vector {
    let mut spread = Matrix2::zeros();
    for pose in poses {
        let off = (pose - mean).xy();
        spread += off * off.transpose();
    }
    let eigen = spread.symmetric_eigen();
    let most = if eigen.eigenvalues[0] >= eigen.eigenvalues[1] { 0 } else { 1 };
    eigen.eigenvectors.column(most).into_owned()
}

/// Returns the anchors c and d in the frames of both objects that fit r + R d = c best.
fn anchors(poses: &[Vector3<f64>]) -> [Vector; 2] {
    let mut rows = DMatrix::zeros(2 * poses.len(), 4);
    let mut wanted = DVector::zeros(2 * poses.len());
    for (k, pose) in poses.iter().enumerate() {
        let turn = Rotation2::new(pose.z);
        for i in 0..2 {
            rows[(2 * k + i, i)] = 1.0;
            rows[(2 * k + i, 2)] = -turn[(i, 0)];
            rows[(2 * k + i, 3)] = -turn[(i, 1)];
            wanted[2 * k + i] = pose[i];
        }
    }
    let normal = rows.transpose() * &rows + DMatrix::identity(4, 4) * RIDGE;
    let found = normal.cholesky().map(|root| root.solve(&(rows.transpose() * wanted)));
    found.map_or([Vector::zeros(); 2], |x| [Vector::new(x[0], x[1]), Vector::new(x[2], x[3])])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_is_recognised_by_its_geometry() {
        let held = [1e-3, 1e-2];
        let poses = |of: &dyn Fn(f64) -> [f64; 3]| -> Vec<Vector3<f64>> {
            (0..30).map(|k| Vector3::from(of(f64::from(k) / 30.0))).collect()
        };
        let fixed = poses(&|_| [0.1, 0.02, 0.3]);
        let slid = poses(&|t| [0.1 + 0.05 * t, 0.02 + 0.02 * t, 0.3]);
        let turned = poses(&|t| {
            let (sin, cos) = t.sin_cos();
            [0.05 + 0.06 * cos, 0.06 * sin, t]
        });
        let free = poses(&|t| [0.1 + 0.1 * t, 0.05 * (7.0 * t).sin(), 0.4 * t]);
        for (poses, kind) in [
            (fixed, JointType::Fixed),
            (slid, JointType::Prismatic),
            (turned, JointType::Revolute),
            (free, JointType::None),
        ] {
            assert_eq!(likeliest(&poses, held), kind);
        }
    }
}
