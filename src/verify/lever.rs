//! Replays lever-ups in 3-D, as written and disturbed, and gives a verdict with evidence.
//!
//! Of the planner's rules for blades none is used: what is checked here is written apart, on fewer
//! looks. Pushes that follow are played among the same plates and blocks from where the lever-up left
//! them, disturbed or not, as if nobody looked in between.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::geometry::{Pose, Pose3, Solid, Vector, Vector3, wrap_angle};
use crate::scene::{
    Disturbance, FollowUp, LeverEvidence, LeverFault, LeverJob, LeverPlan, LeverRules, LeverScene,
    LeverUp, LeverVerdict, Obstacle, Pivot, Task, Tool, ToolChoice,
};
use crate::sim::LeverSimulator;
use crate::watch::{Unwatched, Watch};

use super::VerifySettings;
use super::rules::{in_the_way, is_within_reach};

/// Largest shift of everything that is seen against where the blade goes, along each axis, metres.
const SHIFT: f64 = 0.5e-3;

/// Largest turn of it, about the plate, radians (one degree).
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
const FRICTION: f64 = 0.1;

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;

/// A blade may touch and scratch what is fixed by so much, metres.
const SCRATCH: f64 = 3e-4;

/// Looks at the blade during the turn.
const LOOKS: usize = 48;

/// Replays lever-ups with the engine at its default step.
#[derive(Clone, Copy)]
pub struct LeverVerifier<'a> {
    settings: VerifySettings,
    engine: LeverSimulator,
    watch: &'a dyn Watch,
}

impl<'a> LeverVerifier<'a> {
    /// A verifier with so many disturbed replays.
    pub fn new(settings: VerifySettings) -> Self {
        Self { settings, engine: LeverSimulator::default(), watch: &Unwatched }
    }

    /// The same, which `watch` can stop; a plan whose replays were not all made does not pass.
    #[must_use]
    pub fn watched(self, watch: &'a dyn Watch) -> Self {
        Self { watch, ..self }
    }

    /// The replay as written; `tool` is the one that the plan names.
    pub fn nominal(&self, task: &Task, tool: &Tool, plan: &LeverPlan) -> LeverVerdict {
        let scene = Arc::new(LeverScene::with(&task.scene, tool));
        if let Some(fault) = unplayable(&scene, plan) {
            return LeverVerdict::judge(vec![fault], Vec::new(), task.robustness);
        }
        let forbidden = broken_rules(task, &scene, tool, plan);
        let job = LeverJob { scene, lever: plan.lever };
        let motion = plan.follow_up.as_ref().map(FollowUp::motion);
        let trajectory = self.engine.run_with(&job, &job.scene, motion.as_ref());
        let outcome = task.goal.judge_lever(&job.scene, &job.lever, &trajectory);
        let nominal = LeverEvidence {
            disturbance: Disturbance::Nominal,
            outcome,
            trajectory: Some(trajectory),
        };
        LeverVerdict::judge(forbidden, vec![nominal], task.robustness)
    }

    /// The verdict of [`LeverVerifier::nominal`] with the disturbed replays beside it.
    pub fn disturb(
        &self,
        task: &Task,
        tool: &Tool,
        plan: &LeverPlan,
        verdict: LeverVerdict,
    ) -> LeverVerdict {
        let LeverVerdict { forbidden, mut evidence, .. } = verdict;
        if evidence.is_empty() {
            return LeverVerdict::judge(forbidden, evidence, task.robustness);
        }
        let planned = LeverScene::with(&task.scene, tool);
        let motion = plan.follow_up.as_ref().map(FollowUp::motion);
        let replays: Vec<LeverEvidence> = (0..self.settings.disturbed)
            .into_par_iter()
            .filter(|_| !self.watch.cancelled())
            .map(|draw| {
                let scene =
                    Arc::new(disturbed(&planned, plan.lever.plate, self.settings.seed, draw));
                let job = LeverJob { scene, lever: plan.lever };
                let trajectory = self.engine.run_with(&job, &planned, motion.as_ref());
                let outcome = task.goal.judge_lever(&job.scene, &job.lever, &trajectory);
                let disturbance = Disturbance::Disturbed { draw: draw + 1 };
                LeverEvidence { disturbance, outcome, trajectory: None }
            })
            .collect();
        let whole = replays.len() == self.settings.disturbed;
        evidence.extend(replays);
        let verdict = LeverVerdict::judge(forbidden, evidence, task.robustness);
        if whole { verdict } else { verdict.stopped() }
    }

    /// All replays of a plan: nominal, then disturbed.
    pub fn verify(&self, task: &Task, tool: &Tool, plan: &LeverPlan) -> LeverVerdict {
        self.disturb(task, tool, plan, self.nominal(task, tool, plan))
    }
}

/// The scene as it really is: all of it a little aside of where it was seen, rubbing a little
/// otherwise. What lies in a pocket lies aside with its pocket.
fn disturbed(scene: &LeverScene, plate: usize, seed: u64, draw: usize) -> LeverScene {
    let mut random = Pcg64::new(u128::from(seed), draw as u128);
    // A fresh stream's first numbers resemble those of its neighbours.
    let mut random = Pcg64::seed_from_u64(random.random());
    let mut within = |range: f64| random.random_range(-range..=range);
    let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
    let about = scene.plates[plate].pose.position;
    let moved = |pose: &mut Pose| {
        let arm = Pose { position: pose.position - about, ..*pose };
        *pose = Pose { position: about + shift, heading: turn } * arm;
    };
    let mut scene = scene.clone();
    scene.plates.iter_mut().for_each(|plate| moved(&mut plate.pose));
    scene.blocks.iter_mut().for_each(|block| moved(&mut block.pose));
    let own = scene.plates.iter_mut().map(|plate| &mut plate.friction);
    let fixed = scene.blocks.iter_mut().map(|block| &mut block.friction);
    let others = [&mut scene.table_friction, &mut scene.blade.friction];
    for friction in own.chain(fixed).chain(others) {
        *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
    }
    scene
}

/// Why a plan cannot even be replayed: it names what is not there, or takes too long.
fn unplayable(scene: &LeverScene, plan: &LeverPlan) -> Option<LeverFault> {
    let lever = &plan.lever;
    let what = |what: &str| Some(LeverFault::ForbiddenLever { what: what.to_owned() });
    let Some(plate) = scene.plates.get(lever.plate) else { return what("object") };
    let on_edge = (0.0..=1.0).contains(&lever.place.fraction);
    if lever.place.edge >= plate.corners().len() || !on_edge {
        return what("place");
    }
    let numbers = [lever.depth, lever.pivot, lever.angle, lever.speed, lever.hold, lever.retreat];
    let moves = lever.speed > 0.0 && lever.angle > 0.0 && lever.hold >= 0.0 && lever.retreat >= 0.0;
    if !moves || !numbers.iter().all(|v| v.is_finite()) {
        return what("motion");
    }
    let pushes = plan.follow_up.iter().flat_map(|follow_up| &follow_up.plan.pushes);
    let pushing: f64 = pushes.map(|push| push.length / push.speed).sum();
    // A NaN is too long as well.
    let in_time = lever.duration() + pushing <= LeverUp::LONGEST;
    (!in_time).then_some(LeverFault::TooLong)
}

/// Everything that is wrong with a plan before anything moves.
fn broken_rules(task: &Task, scene: &LeverScene, tool: &Tool, plan: &LeverPlan) -> Vec<LeverFault> {
    let (lever, rules) = (&plan.lever, task.lever_rules());
    let plate = &scene.plates[lever.plate];
    let corners = plate.corners();
    let mut found = Vec::new();
    if let ToolChoice::Named(names) = &task.tools
        && !names.contains(&tool.name)
    {
        found.push(LeverFault::ForbiddenTool { tool: tool.name.clone() });
    }
    let pivot = rules.pivots.iter().any(|pivot| match pivot {
        Pivot::Auto => lever.pivot > 0.0,
        Pivot::At(distance) => (distance - lever.pivot).abs() <= SLACK,
    });
    let within = |value: f64, [low, high]: [f64; 2]| value >= low - SLACK && value <= high + SLACK;
    for (allowed, what) in [
        (lever.plate == task.goal.object, "object"),
        (within(lever.depth, rules.depth), "depth"),
        (within(lever.angle, rules.angle), "angle"),
        (pivot, "pivot"),
    ] {
        if !allowed {
            found.push(LeverFault::ForbiddenLever { what: what.to_owned() });
        }
    }
    let next = corners[(lever.place.edge + 1) % corners.len()];
    let side = (next - corners[lever.place.edge]).norm();
    if side * lever.place.fraction.min(1.0 - lever.place.fraction) < LeverRules::CORNER - SLACK {
        found.push(LeverFault::NearCorner);
    }
    if scene.blade.thickness > plate.clearance + SLACK {
        found.push(LeverFault::TooThick);
    }
    found.extend(on_the_way(task, scene, lever));
    if let Some(follow_up) = &plan.follow_up {
        found.extend(broken_by_pushes(task, follow_up));
    }
    found
}

/// What pushes that follow do that the task does not allow or no robot can do.
fn broken_by_pushes(task: &Task, follow_up: &FollowUp) -> Vec<LeverFault> {
    let plan = &follow_up.plan;
    let mut found = Vec::new();
    if let ToolChoice::Named(names) = &task.tools
        && !names.contains(&plan.tool)
    {
        found.push(LeverFault::ForbiddenTool { tool: plan.tool.clone() });
    }
    let same = |yaw: &f64| wrap_angle(yaw - plan.grip_yaw).abs() <= SLACK;
    let rules = &task.pushes;
    let allowed = plan.pushes.len() <= rules.max_count && rules.grip_yaws.iter().any(same);
    if !allowed {
        found.push(LeverFault::ForbiddenLever { what: "push".to_owned() });
    }
    if !plan.pushes.iter().all(|push| is_within_reach(&task.robot, push)) {
        found.push(LeverFault::OutOfReach);
    }
    // A tool that is driven goes through what is fixed without a trace.
    let fixed: Vec<Obstacle> = task.scene.obstacles.iter().map(Obstacle::grounded).collect();
    let met = plan.pushes.iter().find_map(|push| in_the_way(&fixed, &follow_up.tool, plan, push));
    found.extend(met.map(|met| LeverFault::PushMeets { body: met.name.clone() }));
    found
}

/// What the blade does on its way that no robot can do.
fn on_the_way(task: &Task, scene: &LeverScene, lever: &LeverUp) -> Vec<LeverFault> {
    let blocks: Vec<(&str, Solid)> = scene
        .blocks
        .iter()
        .map(|block| {
            let pose = Pose3::upright(block.pose, block.z + 0.5 * block.size[2]);
            (block.name.as_str(), Solid::cuboid(block.size, &pose))
        })
        .collect();
    let blade = &scene.blade;
    let mut found: Vec<LeverFault> = Vec::new();
    let mut note = |fault: LeverFault| {
        if !found.contains(&fault) {
            found.push(fault);
        }
    };
    // In from behind, then the turn and the way back.
    let (lying, span) = (lever.blade(scene, 0.0), lever.duration());
    let coming = (0..LOOKS).map(|k| {
        let mut pose = lying;
        let left = lever.retreat * (1.0 - k as f64 / LOOKS as f64);
        pose.position -= pose.rotation * Vector3::x() * left;
        pose
    });
    let going = (0..=2 * LOOKS).map(|k| lever.blade(scene, span * k as f64 / (2 * LOOKS) as f64));
    for pose in coming.chain(going) {
        let grip = pose.point(Vector3::new(-0.5 * blade.length, 0.0, 0.0)).xy().norm();
        if grip < task.robot.reach_min - SLACK || grip > task.robot.reach_max + SLACK {
            note(LeverFault::OutOfReach);
        }
        let solid = Solid::cuboid([blade.length, blade.width, blade.thickness], &pose);
        if solid.lowest() < -SCRATCH {
            note(LeverFault::BelowTable);
        }
        for (name, block) in &blocks {
            if block.depth(&solid) > SCRATCH {
                note(LeverFault::Meets { body: (*name).to_owned() });
            }
        }
    }
    found
}
