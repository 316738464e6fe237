//! Velocities after a step: contacts that neither penetrate nor slide without friction.

use crate::geometry::{Matrix3, Vector3};
use crate::scene::GRAVITY;

use super::body::{Body, Spread};
use super::contacts::Contact;

/// Compliance of contacts, equal to the engine's: angular frequency, rad/s, and damping ratio of
/// overdamped springs. With rigid contacts, plates rock on the narrow blade although the engine
/// keeps them still.
const SPRING: (f64, f64) = (100.0 * std::f64::consts::TAU, 5.0);

/// Change of an impulse below which sweeps end, relative to the impulse of the weight.
const ENOUGH: f64 = 1e-3;

/// A direction of a contact.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    /// Direction of the force, and its moment about the centre of mass.
    force: Vector3,
    moment: Vector3,
    /// Change of velocity and angular velocity by a unit impulse.
    speed: Vector3,
    spin: Vector3,
    /// Impulse for a unit change of speed.
    give: f64,
    /// Target speed, m/s.
    asked: f64,
}

impl Row {
    fn new(force: Vector3, arm: Vector3, (mass, inertia): (f64, &Matrix3), asked: f64) -> Self {
        let moment = arm.cross(&force);
        let spin = inertia * moment;
        let give = 1.0 / (mass + moment.dot(&spin));
        Self { force, moment, speed: force * mass, spin, give, asked }
    }

    /// Returns the impulse that would reach the target speed.
    fn lacking(&self, body: &Body) -> f64 {
        (self.asked - self.force.dot(&body.speed) - self.moment.dot(&body.spin)) * self.give
    }

    fn push(&self, body: &mut Body, impulse: f64) {
        body.speed += self.speed * impulse;
        body.spin += self.spin * impulse;
    }
}

/// Contacts with their impulses, on reused buffers.
#[derive(Clone, Debug, Default)]
pub(super) struct Solver {
    rows: Vec<([Row; 3], f64, [f64; 3])>,
    /// Impulses of every contact in its last step, by id, newton seconds, and that step's number.
    last: Vec<([f64; 3], u32)>,
    step: u32,
}

impl Solver {
    /// Clears the state for a new plate with this number of possible contacts.
    pub fn reset(&mut self, contacts: usize) {
        self.last.clear();
        self.last.resize(contacts, ([0.0; 3], 0));
        self.step = 1;
    }

    /// Changes the velocities of `body` so that the contacts hold over the next `step` seconds.
    pub fn solve(
        &mut self,
        (spread, body): (&Spread, &mut Body),
        contacts: &[Contact],
        (step, ratio, sweeps): (f64, f64, usize),
    ) {
        let (frequency, damping) = SPRING;
        // An implicit step turns the spring into two numbers: the share of a penetration that is
        // removed in a second, and the softness of a contact relative to a rigid one.
        let back = frequency / (step * frequency + 2.0 * damping);
        let left = 1.0 / (step * back) - 1.0;
        let firm = 1.0 / (1.0 + left * left / ((1.0 + left) * 4.0 * damping * damping));
        let inertia = body.axes * spread.inertia * body.axes.transpose();
        self.step += 1;
        self.rows.clear();
        for contact in contacts {
            let Contact { arm, normal, gap, surface, .. } = *contact;
            let aside = side_of(normal);
            let other = normal.cross(&aside);
            let back = if gap > 0.0 { -gap / step } else { -gap * back };
            let own = (spread.mass, &inertia);
            let row = |d: Vector3, plus: f64| Row::new(d, arm, own, d.dot(&surface) + plus);
            let rows = [row(normal, back), row(aside, 0.0), row(other, 0.0)];
            let (before, when) = self.last[contact.id];
            // Warm start: contacts that carried in the last step likely still carry.
            let start = if when + 1 == self.step { before.map(|p| p * ratio) } else { [0.0; 3] };
            for (row, impulse) in rows.iter().zip(start) {
                row.push(body, impulse);
            }
            self.rows.push((rows, contact.friction, start));
        }
        // Convergence: smaller changes of impulses have no relevant effect.
        let small = ENOUGH * GRAVITY * step / spread.mass;
        for _ in 0..sweeps {
            let mut change = 0.0f64;
            for ([normal, aside, other], friction, impulses) in &mut self.rows {
                let pressed = (firm * (impulses[0] + normal.lacking(body))).max(0.0);
                // No friction without normal force.
                if pressed == 0.0 && impulses[0] == 0.0 {
                    continue;
                }
                change = change.max((pressed - impulses[0]).abs());
                normal.push(body, pressed - impulses[0]);
                impulses[0] = pressed;
                let (a, b) = (impulses[1] + aside.lacking(body), impulses[2] + other.lacking(body));
                let (most, wanted) = (*friction * pressed, a * a + b * b);
                let share = if wanted > most * most { most / wanted.sqrt() } else { 1.0 };
                let (a, b) = (a * share, b * share);
                change = change.max((a - impulses[1]).abs()).max((b - impulses[2]).abs());
                aside.push(body, a - impulses[1]);
                other.push(body, b - impulses[2]);
                (impulses[1], impulses[2]) = (a, b);
            }
            if change < small {
                break;
            }
        }
        for (contact, (_, _, impulses)) in contacts.iter().zip(&self.rows) {
            self.last[contact.id] = (*impulses, self.step);
        }
    }

    /// Returns the impulses of the last step by contact, newton seconds: normal, then along two
    /// tangents.
    pub fn impulses(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        self.rows.iter().map(|(_, _, impulses)| *impulses)
    }
}

/// Returns a unit vector perpendicular to `normal`, continuous from step to step as the normal
/// rotates.
fn side_of(normal: Vector3) -> Vector3 {
    let across = Vector3::y() - normal * normal.y;
    let length = across.norm();
    if length > 0.1 { across / length } else { Vector3::x().cross(&normal).normalize() }
}
