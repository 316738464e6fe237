//! Timing of a joint path: from rest to rest along the given path, with limited speed, acceleration
//! and jerk.
//!
//! A path is a function of one parameter, which moves by a jerk-limited profile of the crate
//! `rsruckig` (Berscheid and Kröger 2021, doi:10.15607/RSS.2021.XVII.015). The joints therefore
//! stay on the path, whatever its timing. Between the points of a line their positions are a
//! natural cubic spline, so that accelerations are continuous.

use rsruckig::prelude::{InputParameter, Ruckig, ThrowErrorHandler, Trajectory};

use super::model::{Arm, ArmJoint};
use super::path::{GENTLE, SHARE, SPACING};
use super::strain::strain;
use pushplan::scene::{ArmFault, JointPoint};

/// Maximum factor by which a push may extend its ramps for the sake of the joints, and the factor
/// between attempts.
const LONGEST: f64 = 2.0;
const LONGER: f64 = 1.19;

/// Maximum number of attempts to slow down a motion whose speed is free.
const ATTEMPTS: usize = 8;

/// Rates of a path parameter: maximum speed, acceleration and jerk.
type Rates = [f64; 3];

/// Trajectory under construction, whose segments start and end at rest.
pub(super) struct Pieces<'a> {
    arm: &'a Arm,
    pub points: Vec<JointPoint>,
}

impl<'a> Pieces<'a> {
    pub fn new(arm: &'a Arm) -> Self {
        Self { arm, points: vec![resting(0.0, &arm.home)] }
    }

    /// Returns the current joint positions.
    pub fn now(&self) -> &[f64] {
        self.points.last().map_or(&self.arm.home, |point| &point.positions)
    }

    /// Appends a linear joint motion to other positions, at half of the limits.
    pub fn swing(&mut self, to: &[f64]) -> Result<(), ArmFault> {
        let moves = |pair: (&f64, &f64)| (pair.0 - pair.1).abs() > 1e-9;
        if !self.now().iter().zip(to).any(moves) {
            return Ok(());
        }
        let least = |of: fn(&ArmJoint) -> f64| {
            let each = self.arm.joints.iter().zip(self.now()).zip(to);
            let rates = each.map(|((joint, a), b)| SHARE * of(joint) / (b - a).abs());
            rates.fold(f64::INFINITY, f64::min)
        };
        let rates = [least(ArmJoint::speed), least(ArmJoint::acceleration), least(ArmJoint::jerk)];
        let line = [self.now().to_vec(), to.to_vec()];
        self.free(&line, rates)
    }

    /// Appends a flange line of this length, metres, as fast as tools are lowered, or slower if the
    /// joints require it.
    pub fn gently(&mut self, line: &[Vec<f64>], length: f64) -> Result<(), ArmFault> {
        match rates(line, length, GENTLE) {
            Some(rates) => self.free(line, rates),
            None => Ok(()),
        }
    }

    /// Appends a flange line of this length, metres, at a speed, m/s, except near its ends.
    pub fn push(&mut self, line: &[Vec<f64>], length: f64, speed: f64) -> Result<(), ArmFault> {
        let Some([speed, acceleration, jerk]) = rates(line, length, speed) else { return Ok(()) };
        let mut longer = 1.0;
        loop {
            let rates = [speed, acceleration / longer, jerk / (longer * longer)];
            let points = self.timed(line, rates)?;
            let found = strain(self.arm, &points, 1.0, true);
            let Some(fault) = found.fault(self.arm) else {
                self.append(points);
                return Ok(());
            };
            // Only ramps can become longer: a joint that is too fast is too fast everywhere.
            longer *= LONGER;
            if longer > LONGEST || found.ratios[0] > 1.0 || found.limit.is_some() {
                return Err(fault);
            }
        }
    }

    /// Appends a line with at most these rates, slowed down as far as the joints require.
    fn free(&mut self, line: &[Vec<f64>], mut rates: Rates) -> Result<(), ArmFault> {
        for attempt in 1.. {
            let points = self.timed(line, rates)?;
            let found = strain(self.arm, &points, SHARE, false);
            let Some(fault) = found.fault(self.arm) else {
                self.append(points);
                return Ok(());
            };
            let [speed, acceleration, jerk] = found.ratios;
            let slower = 1.01 * speed.max(acceleration.sqrt()).max(jerk.cbrt());
            if attempt == ATTEMPTS || found.limit.is_some() {
                return Err(fault);
            }
            rates = [1, 2, 3].map(|power| rates[power - 1] / slower.powi(power as i32));
        }
        Ok(())
    }

    fn append(&mut self, mut points: Vec<JointPoint>) {
        self.points.extend(points.drain(1..));
    }

    /// Returns the points of a line with the given rates, the first of them the current point.
    fn timed(&self, line: &[Vec<f64>], rates: Rates) -> Result<Vec<JointPoint>, ArmFault> {
        let begun = self.points.last().map_or(0.0, |point| point.time);
        let spline = Spline::through(line);
        let states = profile((line.len() - 1) as f64, rates).ok_or(ArmFault::Unreachable)?;
        let last = states.len() - 1;
        let mut points = vec![resting(begun, &line[0])];
        for (k, [time, at, speed, acceleration]) in states.into_iter().enumerate().skip(1) {
            let time = begun + time;
            points.push(match k == last {
                true => resting(time, &line[line.len() - 1]),
                false => spline.point(time, [at, speed, acceleration]),
            });
        }
        Ok(points)
    }
}

/// Returns the rates along a line of evenly spaced points: its ends are ramps of one
/// [`SPACING`] each. Returns `None` for a line without length.
fn rates(line: &[Vec<f64>], length: f64, speed: f64) -> Option<Rates> {
    let count = line.len().saturating_sub(1) as f64;
    let each = length / count;
    let rates = [speed, speed.powi(2) / SPACING, speed.powi(3) / SPACING.powi(2)];
    (count > 0.0 && length > 0.0).then(|| rates.map(|rate| rate / each))
}

/// Returns times, positions, speeds and accelerations of the fastest motion of a parameter from 0
/// to `length`: at the ends of the phases of constant jerk, and between them at most 1 apart.
/// Returns `None` if the numbers are not valid.
fn profile(length: f64, [speed, acceleration, jerk]: Rates) -> Option<Vec<[f64; 4]>> {
    let mut input = InputParameter::<1>::new(None);
    input.target_position[0] = length;
    input.max_velocity[0] = speed;
    input.max_acceleration[0] = acceleration;
    input.max_jerk[0] = jerk;
    let mut found = Trajectory::<1>::new(None);
    Ruckig::<1, ThrowErrorHandler>::new(None, 1e-3).calculate(&input, &mut found).ok()?;
    let phases = found.get_profiles().first()?[0];
    let mut states = vec![[0.0; 4]];
    let mut time = 0.0;
    for k in 0..7 {
        if phases.t[k] < 1e-9 {
            continue;
        }
        let [p, v, a, j] = [phases.p[k], phases.v[k], phases.a[k], phases.j[k]];
        let parts = (phases.p[k + 1] - p).abs().ceil().max(1.0);
        for part in 1..=parts as usize {
            let t = phases.t[k] * part as f64 / parts;
            let at = p + t * (v + t * (a / 2.0 + t * j / 6.0));
            states.push([time + t, at, v + t * (a + t * j / 2.0), a + t * j]);
        }
        time += phases.t[k];
    }
    (states.len() > 1 && states.iter().flatten().all(|v| v.is_finite())).then_some(states)
}

/// Natural cubic spline through points at the parameters 0, 1, 2 and so on.
struct Spline<'a> {
    points: &'a [Vec<f64>],
    /// Second derivatives at the points.
    bends: Vec<Vec<f64>>,
}

impl<'a> Spline<'a> {
    fn through(points: &'a [Vec<f64>]) -> Self {
        let (count, joints) = (points.len(), points[0].len());
        let mut bends = vec![vec![0.0; joints]; count];
        // The tridiagonal system of the interior points is solved by the Thomas algorithm.
        let mut upper = vec![0.0; count];
        for k in 1..count - 1 {
            let pivot = 4.0 - upper[k - 1];
            upper[k] = 1.0 / pivot;
            for joint in 0..joints {
                let [a, b, c] = [k - 1, k, k + 1].map(|k| points[k][joint]);
                bends[k][joint] = (6.0 * (a - 2.0 * b + c) - bends[k - 1][joint]) / pivot;
            }
        }
        for k in (1..count.saturating_sub(2)).rev() {
            let (before, after) = bends.split_at_mut(k + 1);
            for (bend, next) in before[k].iter_mut().zip(&after[0]) {
                *bend -= upper[k] * next;
            }
        }
        Self { points, bends }
    }

    /// Returns the point at a parameter that moves with this speed and acceleration.
    fn point(&self, time: f64, [at, speed, acceleration]: [f64; 3]) -> JointPoint {
        let k = (at.max(0.0) as usize).min(self.points.len() - 2);
        let (s, r) = (at - k as f64, 1.0 - (at - k as f64));
        let mut point = resting(time, &self.points[k]);
        for joint in 0..point.positions.len() {
            let [a, b] = [k, k + 1].map(|k| self.points[k][joint]);
            let [m, n] = [k, k + 1].map(|k| self.bends[k][joint] / 6.0);
            let slope = b - a + m * (1.0 - 3.0 * r * r) + n * (3.0 * s * s - 1.0);
            point.positions[joint] = a * r + b * s + m * (r.powi(3) - r) + n * (s.powi(3) - s);
            point.velocities[joint] = slope * speed;
            point.accelerations[joint] =
                slope * acceleration + 6.0 * (m * r + n * s) * speed * speed;
        }
        point
    }
}

fn resting(time: f64, positions: &[f64]) -> JointPoint {
    let still = vec![0.0; positions.len()];
    JointPoint {
        time,
        positions: positions.to_vec(),
        velocities: still.clone(),
        accelerations: still,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_keeps_its_rates_and_arrives() {
        for (length, rates) in
            [(10.0, [10.0, 100.0, 1000.0]), (1.0, [0.01, 0.002, 0.3]), (0.5, [9.0, 7.0, 40.0])]
        {
            let states = profile(length, rates).expect("valid numbers");
            let last = states[states.len() - 1];
            assert!((last[1] - length).abs() < 1e-9 && last[2].abs() < 1e-9, "{last:?}");
            let limits = |state: &[f64; 4]| {
                state[2] <= rates[0] * (1.0 + 1e-9) && state[3].abs() <= rates[1] * (1.0 + 1e-9)
            };
            assert!(states.iter().all(limits));
            let steps = states.windows(2).map(|pair| pair[1][1] - pair[0][1]);
            assert!(steps.fold(0.0, f64::max) <= 1.0 + 1e-9);
        }
        assert!(profile(1.0, [0.0, 1.0, 1.0]).is_none());
    }

    #[test]
    fn splines_pass_their_points_with_continuous_derivatives() {
        let points: Vec<Vec<f64>> = [0.0, 0.3, 0.4, -0.2, 0.1].map(|at| vec![at]).to_vec();
        let spline = Spline::through(&points);
        let at = |at: f64| spline.point(0.0, [at, 1.0, 0.0]);
        for (k, own) in points.iter().enumerate() {
            assert!((at(k as f64).positions[0] - own[0]).abs() < 1e-12);
        }
        for k in 1..4 {
            let [a, b] = [at(f64::from(k) - 1e-7), at(f64::from(k) + 1e-7)];
            assert!((a.velocities[0] - b.velocities[0]).abs() < 1e-5);
            assert!((a.accelerations[0] - b.accelerations[0]).abs() < 1e-5);
        }
        let difference = (at(1.6 + 1e-6).positions[0] - at(1.6 - 1e-6).positions[0]) / 2e-6;
        assert!((at(1.6).velocities[0] - difference).abs() < 1e-8);
    }
}
