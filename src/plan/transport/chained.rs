//! Real pushes along legs with a tool that stays down, which begin where the last one ended.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use crate::effect::EffectModel;
use crate::geometry::Vector;
use crate::plan::{CandidatePush, MIN_LENGTH, Rollouts, Start, Workspace};
use crate::{
    outcome::Record,
    scene::{Situation, State},
    task::{Push, PushRules, ToolMotion},
};

use super::legs::Leg;
use super::station::{LOST, Lost, Station, towards};

/// Number of rollouts with which a push of a tool that stays down is corrected.
const CORRECTIONS: usize = 3;

/// Returns the pushes of a tool that stays down along a leg: its way, then the push.
pub(super) fn chained(
    (workspace, model): (&Workspace, &dyn EffectModel),
    leg: &Leg,
    station: &Station,
    now: Situation,
    used: &mut usize,
) -> Result<(Vec<CandidatePush>, Station), Lost> {
    let (rules, (tool, grip_yaw)) = (&workspace.task.pushes, leg.pair);
    let ahead = Vector::new(leg.direction.cos(), leg.direction.sin());
    let task = towards(workspace.task, leg, &now, grip_yaw);
    let mut more = 0.0;
    let mut best: Option<(f64, Vec<Push>, State)> = None;
    for _ in 0..CORRECTIONS {
        let mut way = Way { at: station.tool, pushes: Vec::new(), rules };
        leg.travel.iter().for_each(|corner| way.go_to(*corner));
        let end = leg.to + leg.contact + ahead * more;
        way.go((end - way.at).dot(&ahead), leg.direction);
        let pushes = way.pushes;
        if pushes.is_empty() {
            return Err(Lost::Infeasible);
        }
        let tools = Arc::clone(&workspace.tools[tool]);
        let motion = ToolMotion::pushes(tools, rules.lift, grip_yaw, &pushes, true);
        let mut rollouts = Rollouts::new(model, now.clone());
        let jobs = [rollouts.job(motion, now.start.clone())];
        let outcome = rollouts.run(&jobs, Record::Outcome).remove(0).outcome().clone();
        *used += rollouts.used();
        let (score, short) =
            (task.score(&outcome), (leg.to - outcome.poses[leg.object].position).dot(&ahead));
        more += short;
        if best.as_ref().is_none_or(|(known, ..)| score < *known) {
            best = Some((score, pushes, outcome));
        }
    }
    let (score, pushes, state) = best.ok_or(Lost::Infeasible)?;
    if score > LOST {
        return Err(Lost::Off);
    }
    let planned = |push: &Push| CandidatePush {
        tool,
        grip_yaw,
        object: leg.object,
        start: Start::Chained,
        direction: push.direction,
        length: push.length,
        room: 0.0,
    };
    let station = Station {
        others: station.others.clone(),
        pushes: station.pushes + pushes.len(),
        tool: pushes.last().map_or(station.tool, Push::end),
        state,
    };
    Ok((pushes.iter().map(planned).collect(), station))
}

/// Way of a tool that stays down.
struct Way<'a> {
    at: Vector,
    pushes: Vec<Push>,
    rules: &'a PushRules,
}

impl Way<'_> {
    /// Adds the motion to a corner, along the axis in which it is farther.
    fn go_to(&mut self, corner: Vector) {
        let off = corner - self.at;
        match off.x.abs() > off.y.abs() {
            true => self.go(off.x.abs(), if off.x > 0.0 { 0.0 } else { PI }),
            false => self.go(off.y.abs(), FRAC_PI_2.copysign(off.y)),
        }
    }

    /// Adds pushes of equal length, none if the way is shorter than a push may be.
    fn go(&mut self, length: f64, direction: f64) {
        let count = (length / self.rules.length - 1e-9).ceil().max(1.0);
        if length < MIN_LENGTH {
            return;
        }
        for _ in 0..count as usize {
            let (start, length, speed) = (self.at, length / count, self.rules.speed);
            let push = Push { start, direction, length, speed };
            self.at = push.end();
            self.pushes.push(push);
        }
    }
}
