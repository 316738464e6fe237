//! Physically impossible predictions: overlapping bodies and joints that come apart.

use serde::{Deserialize, Serialize};

use pushplan::{
    geometry::{Footprint, Pose, contact_points},
    scene::{Joint, JointKind, Physics, Scene, Separation, State},
};

/// Drift of the joints of one kind in predictions, over all joints and frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// Number of joints.
    pub joints: usize,
    /// Mean violation of the joint, metres.
    ///
    /// Fixed joint: distance of the second object from its place relative to the first. Revolute
    /// joint: distance between both anchors. Prismatic joint: offset across the axis.
    pub mean: f64,
    /// Maximum violation, metres.
    pub max: f64,
    /// Mean relative rotation, degrees (zero for revolute joints).
    pub turn_deg: f64,
}

/// Sums of drifts by kind: fixed, revolute, prismatic.
#[derive(Clone, Copy, Debug, Default)]
pub struct DriftSums {
    joints: [usize; 3],
    samples: [usize; 3],
    apart: [f64; 3],
    largest: [f64; 3],
    turn: [f64; 3],
}

/// Joints of a scene, prepared for evaluation in every frame.
pub(super) struct Joints(Vec<(JointKind, [usize; 2], [Pose; 2])>);

impl Joints {
    pub(super) fn new(scene: &Scene) -> Self {
        let frames = |joint: &Joint| (joint.kind, joint.between, joint.frames(&scene.objects));
        Self(scene.joints.iter().map(frames).collect())
    }

    /// Returns the summed drifts over all `states`.
    pub(super) fn drift(&self, states: &[&State]) -> DriftSums {
        let mut sums = DriftSums::default();
        for (kind, between, frames) in &self.0 {
            let k = index(kind);
            sums.joints[k] += 1;
            for state in states {
                let separation = Separation::of(frames, between.map(|k| state.poses[k]));
                let misfit = separation.misfit(kind, None);
                let (apart, turn) = (misfit.offset.norm(), misfit.turn.abs());
                sums.samples[k] += 1;
                sums.apart[k] += apart;
                sums.turn[k] += turn;
                sums.largest[k] = sums.largest[k].max(apart);
            }
        }
        sums
    }
}

impl DriftSums {
    /// Adds the drifts of another trial.
    pub fn add(&mut self, other: &Self) {
        for k in 0..3 {
            self.joints[k] += other.joints[k];
            self.samples[k] += other.samples[k];
            self.apart[k] += other.apart[k];
            self.turn[k] += other.turn[k];
            self.largest[k] = self.largest[k].max(other.largest[k]);
        }
    }

    /// Returns means and maxima of fixed, revolute and prismatic joints.
    pub fn by_kind(&self) -> [Drift; 3] {
        [0, 1, 2].map(|k| Drift {
            joints: self.joints[k],
            mean: self.apart[k] / self.samples[k].max(1) as f64,
            max: self.largest[k],
            turn_deg: self.turn[k].to_degrees() / self.samples[k].max(1) as f64,
        })
    }
}

fn index(kind: &JointKind) -> usize {
    match kind {
        JointKind::Fixed => 0,
        JointKind::Revolute { .. } => 1,
        JointKind::Prismatic { .. } => 2,
    }
}

/// Detector of overlapping bodies.
pub(super) struct Overlaps<'a> {
    scene: &'a Scene,
    footprints: Vec<Footprint>,
    /// Rigid body index of every object; objects joined by fixed joints share one and cannot
    /// collide.
    bodies: Vec<usize>,
}

impl<'a> Overlaps<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let footprints = scene.objects.iter().map(|object| object.shape.footprint()).collect();
        let bodies = Physics::stated(scene).rigid_groups().of;
        Self { scene, footprints, bodies }
    }

    /// Returns the maximum overlap of two objects, or of an object with an obstacle, metres.
    ///
    /// The tool is left out because a prediction may have left an object where the tool is set
    /// down.
    pub(super) fn deepest(&self, state: &State) -> f64 {
        let mut deepest: f64 = 0.0;
        let mut meet = |a: (&Footprint, &Pose), b: (&Footprint, &Pose)| {
            if let Some(point) = contact_points(a, b, 0.0).0[0] {
                deepest = deepest.max(-point.gap);
            }
        };
        for (k, (footprint, pose)) in self.footprints.iter().zip(&state.poses).enumerate() {
            for other in
                (k + 1..self.footprints.len()).filter(|o| self.bodies[*o] != self.bodies[k])
            {
                meet((footprint, pose), (&self.footprints[other], &state.poses[other]));
            }
            for obstacle in &self.scene.obstacles {
                meet((footprint, pose), (&obstacle.shape().footprint(), &obstacle.pose));
            }
        }
        deepest
    }
}
