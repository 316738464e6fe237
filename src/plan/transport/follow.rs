//! Real pushes along the legs of a transport. For each leg, the search and refinement start from
//! the state left by the previous pushes.

use std::collections::VecDeque;

use crate::effect::EffectModel;
use crate::geometry::Vector;
use crate::plan::uncertainty::{Uncertainty, room};
use crate::plan::{
    Candidate, CandidatePush, Evaluation, RefineSettings, RefineStatistics, Rollouts, Search,
    SearchSettings, Workspace, kinds, refine,
};
use crate::progress::Progress;
use crate::{
    outcome::Record,
    scene::{Scene, Situation, State},
};

use super::chained::chained;
use super::legs::{Failed, Leg};
use super::reach::{Groups, Transport};
use super::sequence::legs_without;
use super::station::{LOST, Lost, Station, towards};

/// Distance of an object from its planned position at which other legs are searched, metres.
const STRAYS: f64 = 0.008;

/// Maximum number of searches for other legs.
const RETRIES: usize = 16;

/// Score at which a plan counts as complete, because refinement can correct the rest.
const ARRIVED: f64 = 1.5;

/// Motion of other objects other than planned that counts as one unit of the score, metres.
const BESIDE: f64 = 0.02;

/// Budgets of the pushes along legs.
#[derive(Clone, Copy, Debug)]
pub struct FollowSettings {
    /// Settings of the search for each push.
    pub search: SearchSettings,
    /// Number of candidates to refine for each push.
    pub candidates: usize,
    /// Settings of the refinement.
    pub refine: RefineSettings,
}

/// Pushes along legs.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Pushes in order.
    pub candidate: Candidate,
    /// Number of legs followed to their ends.
    pub legs: usize,
    /// Whether the last leg led to all goals.
    pub complete: bool,
    /// State at the end of these legs.
    pub state: State,
}

/// Transport with one tool, followed in rollouts.
pub struct Follow<'a> {
    /// Task and tools.
    pub workspace: Workspace<'a>,
    /// Start.
    pub situation: &'a Situation,
    /// Index of the tool and its grip yaws, radians.
    pub tool: (usize, &'a [f64]),
    /// Maximum length of a push, metres.
    pub longest: f64,
    /// Maximum number of pushes.
    pub most: usize,
    /// Effect model.
    pub model: &'a dyn EffectModel,
    /// Budgets of the pushes.
    pub settings: FollowSettings,
}

impl Follow<'_> {
    /// Finds pushes along `legs`, at most the first `ahead` of them. Where a leg fails, or objects
    /// end elsewhere than planned, other legs are searched from there; `used` counts the rollouts.
    pub fn run(
        &self,
        legs: &[Leg],
        ahead: usize,
        used: &mut usize,
        progress: &dyn Progress,
    ) -> Followed {
        let spread = Uncertainty::around(self.situation);
        let start = self.situation.start.clone();
        let mut way = vec![(
            Station {
                state: start,
                others: spread.starts().to_vec(),
                pushes: 0,
                tool: self.workspace.task.robot.home,
            },
            None,
        )];
        let mut candidate = Candidate::default();
        let mut open: VecDeque<Leg> = legs.to_vec().into();
        let (mut failed, mut retries) = (Vec::new(), 0);
        // Number of stations when the open legs were planned.
        let mut planned = way.len();
        while let Some(leg) = open.pop_front() {
            if way.len() > ahead || progress.cancelled() {
                break;
            }
            let (station, _) = way.last().expect("the way begins at the start");
            candidate.pushes.truncate(station.pushes);
            match self.leg(&leg, (station, way.len() == 1), &spread, used, progress) {
                Ok((pushes, next)) => {
                    candidate.pushes.extend(pushes);
                    let strays = self.strays(&leg, &station.state, &next.state);
                    way.push((next, Some(leg)));
                    if strays {
                        open.clear();
                    }
                }
                Err(lost) => {
                    open.clear();
                    // After other pushes, the legs no longer begin where objects are.
                    if planned == way.len() {
                        failed.push(Failed::of(&leg, lost == Lost::Off));
                    }
                }
            }
            // Other legs from here, or from the station before.
            while open.is_empty()
                && !self.arrived(&way)
                && retries < RETRIES
                && way.len() <= ahead
                && !progress.cancelled()
            {
                retries += 1;
                let (station, leg) = way.last().expect("the way begins at the start");
                if let Some(legs) = self.replanned(station, &failed, progress) {
                    (open, planned) = (legs.into(), way.len());
                } else if let Some(leg) = leg {
                    failed.push(Failed::of(leg, true));
                    way.pop();
                } else {
                    break;
                }
            }
        }
        let (station, _) = way.last().expect("the way begins at the start");
        candidate.pushes.truncate(station.pushes);
        let (legs, complete) = (way.len() - 1, self.arrived(&way));
        Followed { candidate, legs, complete, state: station.state.clone() }
    }

    /// Returns `true` if all goals are nearly met at the end.
    fn arrived(&self, way: &[(Station, Option<Leg>)]) -> bool {
        let (station, _) = way.last().expect("the way begins at the start");
        way.len() > 1 && self.workspace.task.score(&station.state) <= ARRIVED
    }

    /// Returns other legs from a station.
    fn replanned(
        &self,
        station: &Station,
        failed: &[Failed],
        progress: &dyn Progress,
    ) -> Option<Vec<Leg>> {
        let now = Situation { start: station.state.clone(), ..self.situation.clone() };
        let groups = Groups::of(&self.workspace, &now)?;
        let transport =
            Transport::new(self.workspace, &now, &groups, self.tool, (station.tool, self.longest))?;
        let most = self.most.checked_sub(station.pushes).filter(|most| *most > 0)?;
        let legs = legs_without(&transport, failed, (most, 1), progress).pop()?;
        (!legs.is_empty()).then_some(legs)
    }

    /// Returns `true` if an object ends elsewhere than planned.
    fn strays(&self, leg: &Leg, before: &State, after: &State) -> bool {
        expected(leg, &self.situation.scene, before)
            .any(|(k, there)| (after.poses[k].position - there).norm() > STRAYS)
    }

    /// Returns the pushes along a leg and the station at its end.
    fn leg(
        &self,
        leg: &Leg,
        (station, first): (&Station, bool),
        spread: &Uncertainty,
        used: &mut usize,
        progress: &dyn Progress,
    ) -> Result<(Vec<CandidatePush>, Station), Lost> {
        let now = Situation { start: station.state.clone(), ..self.situation.clone() };
        if !self.workspace.is_placed() {
            return chained((&self.workspace, self.model), leg, station, now, used);
        }
        let (tool, grip_yaw) = leg.pair;
        let task = towards(self.workspace.task, leg, &now, grip_yaw);
        let own = Workspace { task: &task, tools: &self.workspace.tools[tool..=tool] };
        let error = self.settings.search.model_error;
        let first_room = match first {
            true => 0.0,
            false => room(&now.scene, leg.object, &now.start, &station.others, error),
        };
        let model = (self.model, self.settings);
        let best =
            push(&own, &now, (leg, first_room), model, used, progress).ok_or(Lost::Infeasible)?;
        if best.score > LOST {
            return Err(Lost::Off);
        }
        let mut rollouts = Rollouts::new(self.model, now);
        let motions = best.motions(&own);
        let jobs: Vec<_> =
            motions.iter().flat_map(|motion| spread.jobs(motion, &station.others)).collect();
        let ends = rollouts.run(&jobs, Record::Outcome);
        *used += rollouts.used();
        // The search had a single tool, at index 0.
        let pushes: Vec<CandidatePush> =
            best.candidate.pushes.iter().map(|push| CandidatePush { tool, ..*push }).collect();
        let station = Station {
            others: ends.iter().map(|end| end.outcome().clone()).collect(),
            pushes: station.pushes + pushes.len(),
            state: best.outcome,
            tool: station.tool,
        };
        Ok((pushes, station))
    }
}

/// Returns the objects that are not parts of another one, with their planned positions after a leg.
fn expected<'a>(
    leg: &'a Leg,
    scene: &'a Scene,
    before: &'a State,
) -> impl Iterator<Item = (usize, Vector)> + 'a {
    scene.things().map(|(k, _)| {
        let carried = leg.carried.iter().find(|(carried, _)| *carried == k);
        let there = match (k == leg.object, carried) {
            (true, _) => leg.to,
            (_, Some((_, there))) => *there,
            _ => before.poses[k].position,
        };
        (k, there)
    })
}

/// Returns the best single push for a task from the current situation.
fn push(
    workspace: &Workspace,
    now: &Situation,
    (leg, first_room): (&Leg, f64),
    (model, settings): (&dyn EffectModel, FollowSettings),
    used: &mut usize,
    progress: &dyn Progress,
) -> Option<Evaluation> {
    let mut rollouts = Rollouts::new(model, now.clone());
    let mut search = Search::new(*workspace, now, settings.search).with_first_room(first_room);
    let found = search.deepen(&mut rollouts, progress);
    let chosen = kinds(&found, settings.candidates);
    let candidates: Vec<Candidate> = match chosen.len() {
        0 => return None,
        _ => {
            let others = (0..found.len()).filter(|k| !chosen.contains(k));
            let all = chosen.iter().copied().chain(others).take(settings.candidates);
            all.map(|k| found[k].candidate.clone()).collect()
        }
    };
    let mut statistics = RefineStatistics::default();
    let refined =
        refine(workspace, &mut rollouts, &candidates, settings.refine, &mut statistics, progress);
    *used += rollouts.used();
    let moved = |one: &Evaluation| {
        let others = expected(leg, &now.scene, &now.start).filter(|(k, _)| *k != leg.object);
        others.map(|(k, there)| (one.outcome.poses[k].position - there).norm()).sum::<f64>()
            / BESIDE
    };
    let sound = refined.into_iter().map(|one| one.best).filter(Evaluation::is_sound);
    sound.min_by(|a, b| (a.score + moved(a)).total_cmp(&(b.score + moved(b))))
}
