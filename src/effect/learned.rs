//! The learned effect model: the BRDPN physics predictor behind [`EffectModel`].

use rayon::prelude::*;

use crate::{
    brdpn::{Engine, Weights, Workspace},
    geometry::Footprint,
    rollout::roll,
    scene::{Job, Record, Scene, ToolMotion, Trajectory, Warning},
};

use super::EffectModel;

/// Jobs that share a network batch: enough rows to keep the matrix products busy, few enough
/// that two cores share a coarse search evenly. Fixed, so that results do not depend on the
/// number of threads.
const CHUNK: usize = 32;

/// Predicts with trained weights.
pub struct Learned {
    name: String,
    engine: Engine,
    weights: Weights,
}

impl Learned {
    /// A model of these weights.
    pub fn new(weights: Weights) -> Self {
        let name = format!("brdpn-{}", weights.card.config.width);
        Self { name, engine: Engine::new(&weights), weights }
    }

    /// What the weights are.
    pub fn weights(&self) -> &Weights {
        &self.weights
    }

    /// The trained range of a quantity.
    fn range(&self, quantity: &str) -> Option<(f64, f64)> {
        let range = self.weights.card.ranges.iter().find(|r| r.quantity == quantity)?;
        Some((range.low, range.high))
    }
}

impl EffectModel for Learned {
    fn name(&self) -> &str {
        &self.name
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        inputs(scene, motion)
            .into_iter()
            .filter_map(|(of, quantity, value)| {
                let (low, high) = self.range(quantity)?;
                // A thousandth of slack forgives rounding of values written at the bound.
                let slack = 1e-3 * (high - low);
                (value < low - slack || value > high + slack).then(|| Warning::OutsideTraining {
                    of,
                    quantity: quantity.to_owned(),
                    value,
                    low,
                    high,
                })
            })
            .collect()
    }

    fn error_p95(&self) -> f64 {
        self.weights.card.errors.p95
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map_init(Workspace::default, |workspace, chunk| {
                roll(scene, chunk, record, &mut |batch, corrections| {
                    self.engine.forward(batch, workspace, corrections);
                })
            })
            .flatten_iter()
            .collect()
    }
}

/// The quasi-static prior alone, without any network: the cheapest level with physics in it.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuasiStatic;

impl EffectModel for QuasiStatic {
    fn name(&self) -> &str {
        "quasi-static"
    }

    fn warnings(&self, _: &Scene, _: &ToolMotion) -> Vec<Warning> {
        Vec::new()
    }

    fn error_p95(&self) -> f64 {
        0.0
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        jobs.par_chunks(CHUNK)
            .map(|chunk| {
                roll(scene, chunk, record, &mut |batch, corrections| {
                    corrections.clear();
                    corrections.resize(batch.node_count(), [0.0; 6]);
                })
            })
            .flatten_iter()
            .collect()
    }
}

/// Every input whose trained range is stored: (of what, quantity, value).
fn inputs(scene: &Scene, motion: &ToolMotion) -> Vec<(String, &'static str, f64)> {
    let mut found = vec![
        ("table".to_owned(), "friction", scene.table_friction),
        (motion.tool.name.clone(), "friction", motion.tool.friction),
        ("scene".to_owned(), "number of objects", scene.objects.len() as f64),
    ];
    for object in &scene.objects {
        let name = || object.name.clone();
        found.push((name(), "mass, kg", object.mass));
        found.push((name(), "friction", object.friction));
        match object.shape.footprint() {
            Footprint::Disc { radius } => found.push((name(), "radius, m", radius)),
            Footprint::Rectangle { half } => {
                found.push((name(), "side, m", 2.0 * half.x));
                found.push((name(), "side, m", 2.0 * half.y));
            }
        }
    }
    for stroke in &motion.strokes {
        if stroke.duration > 0.0 && stroke.travel() > 0.0 {
            found.push(("push".to_owned(), "speed, m/s", stroke.travel() / stroke.duration));
        }
    }
    found
}
