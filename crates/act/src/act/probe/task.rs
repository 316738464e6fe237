//! Exploratory pushes for the unknowns that a task depends on.
//!
//! Exploration pays if samples of the belief require different plans. Let R(p, s) be 1 if plan p
//! reaches the goal in sample s, otherwise 0. The value of perfect information is
//!
//! ```text
//! mean over s of max over p of R(p, s)  -  max over p of mean over s of R(p, s)
//! ```
//!
//! (Howard 1966, doi:10.1109/TSSC.1966.300074). The module `choose` then selects the probe.

use std::sync::Arc;

use rand::seq::SliceRandom;

use crate::belief::{Belief, generator};
use pushplan::effect::EffectModel;
use pushplan::solve::{ManualPush, ManualStart, manual_plan};
use pushplan::{
    scene::{DisjointSets, Tool, near_pairs},
    task::{Plan, PushForm, Task},
};

use super::super::judge::{Reach, Samples};
use super::super::settings::RunSettings;
use super::choose::{Probe, choose};

/// Minimum value of perfect information for which a probe is made, relative to the sample count.
const WORTH: f64 = 0.1;

/// Travel of a probe, metres.
const LENGTH: f64 = 0.10;

/// Offsets of a probe, as shares of the object's inner radius.
const OFFSETS: [f64; 3] = [0.0, 0.8, -0.8];

/// Returns `true` if the value of perfect information justifies a probe.
pub(in crate::act) fn pays(reach: &[Vec<Reach>]) -> bool {
    let Some(samples) = reach.first().map(Vec::len).filter(|count| *count > 0) else {
        return false;
    };
    let one = |reached: bool| f64::from(u8::from(reached));
    let known: f64 = (0..samples).map(|s| one(reach.iter().any(|plan| plan[s].reached))).sum();
    let best = |plan: &Vec<Reach>| plan.iter().map(|reach| one(reach.reached)).sum::<f64>();
    let unknown = reach.iter().map(best).fold(0.0, f64::max);
    known - unknown > WORTH * samples as f64
}

/// Returns the chosen probe, drawn with the generator of `index`; `None` if there is none.
pub(in crate::act) fn probe(
    model: &dyn EffectModel,
    task: &Task,
    settings: &RunSettings,
    (belief, samples): (&Belief, &Samples),
    (tools, reach): (&[Arc<Tool>], &[Vec<Reach>]),
    index: u64,
) -> Option<(Plan, Arc<Tool>)> {
    let mut rng = generator(settings.seed ^ 0x9120_BE5E, index);
    let mut found = candidates(task, samples, tools);
    found.shuffle(&mut rng);
    let motion = |(object, plan, tool): &(usize, Plan, Arc<Tool>)| Probe {
        object: *object,
        motion: plan.motion(tool),
    };
    let probes: Vec<Probe> = found.iter().map(motion).collect();
    let by = (settings.probe_rule, settings.noise);
    let chosen = choose(model, by, (belief, samples), &probes, reach)?;
    let (_, plan, tool) = found.swap_remove(chosen);
    Some((plan, tool))
}

/// Returns the probes that a task allows, each with the index of the pushed object. Probes are made
/// at the goal's object and at objects that may be joined to it.
fn candidates(
    task: &Task,
    samples: &Samples,
    tools: &[Arc<Tool>],
) -> Vec<(usize, Plan, Arc<Tool>)> {
    let scene = &samples.now.scene;
    let mut sets = DisjointSets::new(scene.objects.len());
    // Current poses are used; objects that were joined from the start are still close.
    for (between, _) in near_pairs(scene) {
        sets.join(between);
    }
    let placed = task.pushes.form == PushForm::Placed;
    let mut found = Vec::new();
    for (object, body) in scene.objects.iter().enumerate() {
        if sets.lowest(object) != sets.lowest(task.goals[0].object) {
            continue;
        }
        let inner = body.shape.footprint().inner_radius();
        for tool in tools {
            for direction in task.pushes.directions.headings() {
                for offset in OFFSETS {
                    let start = match placed {
                        true => ManualStart::Before {
                            object: body.name.clone(),
                            offset: offset * inner,
                        },
                        false => ManualStart::Last,
                    };
                    let length = Some(LENGTH.min(task.pushes.length));
                    let push = [ManualPush { start, direction, length, speed: None }];
                    let yaws = &task.pushes.grip_yaws;
                    if let Ok(asked) = manual_plan(task, &samples.now, tool, yaws, &push)
                        && asked.violations.is_empty()
                    {
                        found.push((object, asked.plan, Arc::clone(tool)));
                    }
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reach(rows: &[&[u8]]) -> Vec<Vec<Reach>> {
        let one = |reached: &u8| Reach { reached: *reached == 1, score: 0.0 };
        rows.iter().map(|row| row.iter().map(one).collect()).collect()
    }

    #[test]
    fn learning_pays_where_samples_want_different_plans_and_only_there() {
        assert!(pays(&reach(&[&[1, 1, 0, 0], &[0, 0, 1, 1]])));
        assert!(!pays(&reach(&[&[1, 1, 1, 0], &[0, 1, 1, 0]])), "one plan is best in all");
        assert!(!pays(&reach(&[&[0, 0], &[0, 0]])), "nothing works anyway");
        assert!(!pays(&[]) && !pays(&reach(&[&[]])));
    }
}
