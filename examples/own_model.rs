//! Plans with a custom effect model: `cargo run --release --example own_model`.
//!
//! The support of an object is not observable, but it determines the rotation. This model predicts
//! every push with three plausible support models and returns the mean motion.

use std::sync::Arc;

use pushplan::models::Prior;
use pushplan::outcomes::Frame;
use pushplan::{
    EffectModel, Effort, Job, ModelSpec, Physics, PlanStatus, Planner, Record, Scene, Task,
    ToolLibrary, Trajectory, Trust,
};

/// Mean prediction of the analytic model over plausible support models.
struct OnAnySupport(Prior);

impl EffectModel for OnAnySupport {
    /// Model identifier in predictions; without settings of its own the model uses the name of the
    /// analytic model.
    fn spec(&self) -> &ModelSpec {
        self.0.spec()
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        self.0.trust(scene, job)
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        // One batch of three consecutive jobs per push, so that all threads have work.
        let supports = &Physics::PLAUSIBLE_SUPPORTS;
        let on = |job: &Job, support| {
            let mut job = job.clone();
            Arc::make_mut(&mut job.physics).support_all(scene, support);
            job
        };
        let all: Vec<Job> =
            jobs.iter().flat_map(|job| supports.iter().map(|support| on(job, support))).collect();
        self.0.rollout(scene, &all, record).chunks(supports.len()).filter_map(mean).collect()
    }
}

/// Returns the mean of trajectories, frame by frame; a shorter one repeats its last frame.
fn mean(trajectories: &[Trajectory]) -> Option<Trajectory> {
    let longest = trajectories.iter().max_by_key(|trajectory| trajectory.frames.len())?;
    let mut mean = longest.clone();
    let share = 1.0 / trajectories.len() as f64;
    for (k, frame) in mean.frames.iter_mut().enumerate() {
        let others: Vec<&Frame> = trajectories
            .iter()
            .filter_map(|other| other.frames.get(k).or(other.frames.last()))
            .collect();
        for (object, pose) in frame.state.poses.iter_mut().enumerate() {
            let poses = || others.iter().map(|frame| frame.state.poses[object]);
            pose.position = poses().map(|pose| pose.position * share).sum();
            pose.heading = poses().map(|pose| pose.heading * share).sum();
        }
    }
    Some(mean)
}

fn main() -> Result<(), pushplan::Error> {
    let library = ToolLibrary::embedded()?;
    let task = Task::load(concat!(env!("CARGO_MANIFEST_DIR"), "/tasks/turn-the-box.yaml"))?;
    let planner = Planner::builder(OnAnySupport(Prior::default())).effort(Effort::Standard).build();
    let solution = planner.solve(&task, &library)?;
    assert_eq!(solution.status, PlanStatus::Solved);
    if let Some(best) = solution.best() {
        let robustness = best.verdict.as_ref().and_then(|verdict| verdict.robustness);
        println!("{}: use the {}", task.name, best.plan.tool());
        println!("{:.0} % of perturbed replays pass", 100.0 * robustness.unwrap_or_default());
    }
    Ok(())
}
