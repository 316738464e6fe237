//! Generated levering tasks: a circuit board must be lifted out of its pocket in a hard drive.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::geometry::Pose;
use pushplan::internals::progress::NoProgress;
use pushplan::internals::sim::LeverSimulator;
use pushplan::internals::solve::{LeverStatistics, PlanStatus, Planner, SolveError};
use pushplan::internals::verify::{Verifier, VerifySettings};
use pushplan::internals::{
    outcome::{Outcome, Record},
    scene::{LeverScene, Obstacle, Robot, Scene, Situation, Tool},
    task::{Demand, Goal, LeverJob, LeverMotion, LeverRules, Motion, Outside, PushRules, Task},
};
use pushplan_bench::store::{Measured, Seconds};
use pushplan_learn::dataset::{LEVERS_PER_SHAPE, LeverConfig, LeverPreset, lever_job};

/// Names of the region to leave and of the tool.
const POCKET: &str = "pocket";
const TOOL: &str = "screwdriver";

/// Number of further perturbed replays of every plan, with draws that no planner has used.
const FURTHER: usize = 32;

/// Boards in pockets. Every task has another drive, with a notch at a random place of a wall.
#[derive(Clone, Copy, Debug)]
pub struct LeverSuite {
    config: LeverConfig,
}

/// Result of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverRecord {
    /// Status of planning.
    pub status: PlanStatus,
    /// Whether the nominal replay of the first plan reaches the goal.
    pub works: bool,
    /// Share of perturbed replays of verification that reach the goal.
    pub robustness: Option<f64>,
    /// Share of further perturbed replays that reach the goal; 0 without a plan that works.
    pub further: f64,
    /// Whether a random lever-up takes the board out.
    pub random: bool,
    /// Number of feasible candidates.
    pub candidates: usize,
    /// Number of candidates with predicted success.
    pub promising: usize,
}

impl LeverSuite {
    /// Version of the tasks: another version generates other tasks from a seed.
    pub const VERSION: u32 = 1;

    /// Creates the suite of a seed.
    pub fn new(seed: u64, count: usize) -> Self {
        let episodes = count as u64 * LEVERS_PER_SHAPE;
        Self { config: LeverConfig { seed, episodes, preset: LeverPreset::Drive } }
    }

    /// Returns a drive and the lever-up of its generator; only the first lever-up of each shape is
    /// used.
    fn drawn(&self, index: usize) -> LeverJob {
        lever_job(&self.config, index as u64 * LEVERS_PER_SHAPE)
    }

    /// Returns task `index`, which depends on the seed alone.
    pub fn task(&self, index: usize) -> Task {
        let LeverJob { scene, lever } = self.drawn(index);
        let table = table(&scene);
        let mut obstacles = table.obstacles.clone();
        let Obstacle { name, size, pose, .. } = pocket(&scene.blocks);
        let outside = Outside { name, size, pose };
        let goal = Goal::of(lever.plate).with(Demand::Outside(outside));
        obstacles.push(pocket(&scene.blocks));
        let scene = Scene { obstacles, ..table };
        let robot = Robot { base: 0.0, ..Robot::reaching(0.0, 2.0) };
        Task::new(format!("board-{}", index + 1), scene, robot, goal)
            .with_tools([TOOL])
            .levering(LeverRules::default())
            .pushing(PushRules::none())
            .described("Take the board out of the drive.")
    }

    /// Solves task `index` with `planner`. The times are the planner's alone.
    ///
    /// # Errors
    /// Returns an error if the planner refuses the task.
    pub fn measure(
        &self,
        planner: &Planner,
        library: &ToolLibrary,
        index: usize,
    ) -> Result<Measured<LeverRecord>, SolveError> {
        let task = self.task(index);
        let solution = planner.solve(&task, library)?;
        let best = solution.best();
        let verdict = best.and_then(|best| best.verdict.as_ref());
        let works = verdict.is_some_and(|verdict| verdict.nominal_ok());
        // The planner's own perturbations have seed 0.
        let settings = VerifySettings { replays: FURTHER, seed: 1 + index as u64 };
        let further = best.filter(|_| works).and_then(|best| {
            let situation = Situation::stated(&task.scene);
            let verifier = Verifier::new(settings);
            verifier.verify(&task, &situation, &best.tools, &best.plan).robustness
        });
        let LeverJob { scene, lever } = self.drawn(index);
        let tool = Arc::new(Tool::with_blade(TOOL, scene.blade));
        let random = [Motion::Lever(LeverMotion::new(tool, lever, None))];
        let watched = (Record::Outcome, &NoProgress as _);
        let scene = table(&scene);
        let really = Situation::stated(&scene);
        let moved = LeverSimulator::FINE.run_all(&really, &scene, &random, watched);
        let LeverStatistics { search, .. } = solution.statistics.levers.clone().unwrap_or_default();
        let timing = &solution.statistics.timing;
        let seconds = [
            ("search", timing.search),
            ("simulation", timing.refinement),
            ("verification", timing.verification),
            ("total", timing.total),
        ];
        let record = LeverRecord {
            status: solution.status,
            works,
            robustness: verdict.and_then(|verdict| verdict.robustness),
            further: further.unwrap_or(0.0),
            random: Outcome::judge(&task.scene, &task, &moved).reached,
            candidates: search.rollouts,
            promising: search.promising,
        };
        let seconds: Seconds =
            seconds.into_iter().map(|(stage, time)| (stage.to_owned(), time)).collect();
        Ok(Measured { record, seconds })
    }
}

/// Returns a drive as a scene.
fn table(drive: &LeverScene) -> Scene {
    let plates = Scene::of_plates(drive.plates.iter().cloned()).unwrap_or_default();
    Scene { obstacles: drive.blocks.clone(), ..plates.on_table(drive.table_friction) }
}

/// Returns the floor between the walls as a body: the region that the board must leave.
pub(super) fn pocket(blocks: &[Obstacle]) -> Obstacle {
    let floor = &blocks[0];
    let mut inner = [f64::INFINITY; 2];
    for wall in blocks.iter().filter(|block| block.name.starts_with("wall-")) {
        let local: Pose = floor.pose.inverse() * wall.pose;
        // Front and back lie across y, left and right across x, pieces of a wall in a line.
        let across =
            usize::from(["front", "back"].iter().any(|side| wall.name[5..].starts_with(side)));
        let face = local.position[across].abs() - 0.5 * wall.size[1];
        inner[across] = inner[across].min(face);
    }
    Obstacle {
        name: POCKET.to_owned(),
        size: [2.0 * inner[0], 2.0 * inner[1], floor.size[2]],
        ..floor.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_files_that_can_be_read() {
        let suite = LeverSuite::new(3, 4);
        for index in 0..4 {
            let task = suite.task(index);
            let text = task.to_yaml().expect("numbers");
            let again = Task::parse(&text, "again.yaml");
            assert_eq!(again.unwrap_or_else(|faults| panic!("{faults}\n{text}")).name, task.name);
            let [x, y, _] = task.scene.obstacles.last().expect("the pocket").size;
            assert!((0.05..0.11).contains(&x) && (0.045..0.10).contains(&y), "{x} {y}");
        }
    }
}
