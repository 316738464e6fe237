//! An effect model of one's own, planned with: `cargo run --release --example own_model`.
//!
//! Nobody sees what an object rests on, and that decides how far it turns. This model rolls every
//! push out on three plausible supports and predicts the mean of what happens.

use std::sync::Arc;

use pushplan::effect::Prior;
use pushplan::outcome::Frame;
use pushplan::{
    EffectModel, Effort, Job, ModelSpec, Physics, PlanStatus, Planner, Record, Scene, Task,
    ToolLibrary, Trajectory, Trust,
};

/// The prior's mean over what objects may rest on.
struct OnAnySupport(Prior);

impl EffectModel for OnAnySupport {
    /// What predictions say they are from: a model without settings of its own borrows the name.
    fn spec(&self) -> &ModelSpec {
        self.0.spec()
    }

    fn trust(&self, scene: &Scene, job: &Job) -> Trust {
        self.0.trust(scene, job)
    }

    fn rollout(&self, scene: &Scene, jobs: &[Job], record: Record) -> Vec<Trajectory> {
        // One batch, so that all threads have work: three jobs for each, one after another.
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

/// Frame by frame; a trajectory that is over stays where it ended.
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
        println!("{:.0} % of disturbed replays work", 100.0 * robustness.unwrap_or_default());
    }
    Ok(())
}
