//! A model that leaves crowds to the planar engine, which is cheaper there.

use crate::rollout::reachable;
use crate::scene::{Job, Record, Scene, ToolMotion, Trajectory, Warning};
use crate::sim::Simulator;

use super::{EffectModel, Simulated, model::fill};

/// A model for motions that reach few objects, and the planar engine for the others: the cost
/// of the model's contacts grows faster with their number than the engine's.
pub struct Crowded<M> {
    model: M,
    planar: Simulated,
    most: usize,
}

impl<M: EffectModel> Crowded<M> {
    /// `model` for motions that can set at most `most` objects in motion, `planar` for others.
    pub fn new(model: M, planar: Simulator, most: usize) -> Self {
        Self { model, planar: Simulated::new(planar), most }
    }

    /// Whether the model itself is asked.
    fn is_for_model(&self, scene: &Scene, job: &Job) -> bool {
        scene.objects.len() <= self.most || reachable(scene, job).len() <= self.most
    }
}

impl<M: EffectModel> EffectModel for Crowded<M> {
    fn name(&self) -> &str {
        self.model.name()
    }

    fn name_for(&self, scene: &Scene, motion: &ToolMotion) -> &str {
        match self.is_for_model(scene, &Job::stated(scene, motion.clone())) {
            true => self.model.name_for(scene, motion),
            false => self.planar.name(),
        }
    }

    fn warnings(&self, scene: &Scene, motion: &ToolMotion) -> Vec<Warning> {
        match self.is_for_model(scene, &Job::stated(scene, motion.clone())) {
            true => self.model.warnings(scene, motion),
            false => self.planar.warnings(scene, motion),
        }
    }

    fn error_p95(&self) -> f64 {
        self.model.error_p95()
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        let work = (scene, jobs, record);
        let few: Vec<bool> = jobs.iter().map(|job| self.is_for_model(scene, job)).collect();
        let many: Vec<bool> = few.iter().map(|few| !few).collect();
        let mut places = vec![Trajectory::default(); jobs.len()];
        fill(&self.model, work, &few, &mut places);
        fill(&self.planar, work, &many, &mut places);
        places
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::effect::Prior;
    use crate::geometry::{Pose, Shape, Vector};
    use crate::scene::{Object, Part, Push, Tool};

    use super::*;

    #[test]
    fn pushes_into_a_crowd_are_simulated_and_those_beside_it_are_not() {
        let can = |x: f64, y: f64| Object {
            name: format!("{x} {y}"),
            shape: Shape::Cylinder { radius: 0.03, height: 0.1 },
            mass: 0.5,
            friction: 0.4,
            pose: Pose::new(x, y, 0.0),
        };
        // A row of three, and one far from them.
        let objects = vec![can(0.1, 0.0), can(0.165, 0.0), can(0.23, 0.0), can(0.1, 0.5)];
        let scene = Scene { table_friction: 0.4, objects, ..Scene::default() };
        let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
        let tool = Arc::new(Tool::new("bar", [bar]).expect("one piece").friction(0.3));
        let job = |y: f64| {
            let push =
                Push { start: Vector::new(0.0, y), direction: 0.0, length: 0.15, speed: 0.1 };
            Job::stated(&scene, ToolMotion::pushes(tool.clone(), 0.002, 0.0, &[push], true))
        };
        let jobs = [job(0.0), job(0.5)];
        let (prior, planar) = (Prior::default(), Simulator::planar());
        let roll = |model: &dyn EffectModel| model.rollout(&scene, &jobs, Record::Outcome);
        let [own, engine] = [roll(&prior), roll(&Simulated::new(planar.clone()))];
        assert!(own != engine);
        let model = Crowded::new(prior.clone(), planar.clone(), 2);
        let mixed = roll(&model);
        assert_eq!([&mixed[0], &mixed[1]], [&engine[0], &own[1]]);
        assert_eq!(
            [0, 1].map(|k| model.name_for(&scene, &jobs[k].motion)),
            ["planar", "quasi-static"]
        );
        assert_eq!(roll(&Crowded::new(prior.clone(), planar.clone(), 3)), own);
        assert_eq!(roll(&Crowded::new(prior, planar, 0)), engine);
    }
}
