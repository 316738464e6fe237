//! Contacts of the plate with table, blade and blocks that are closed or may close in a step.

use crate::geometry::{Box3, Pose3, Vector, Vector3};
use crate::scene::GRAVITY;

use super::body::Body;
use super::setup::{BladePose, Setup};

/// Penetration beyond which a contact with the blade is dropped, metres; otherwise the blade stays
/// below the underside's plane.
const INSIDE: f64 = 6e-3;

/// A contact of the plate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Id among the possible contacts, constant from step to step.
    pub id: usize,
    /// Vector from the centre of mass, metres.
    pub arm: Vector3,
    /// Unit normal, towards the plate.
    pub normal: Vector3,
    /// Distance along the normal, metres.
    pub gap: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Velocity of the touched surface, m/s.
    pub surface: Vector3,
}

/// Number of possible contacts with the blade: the tip and the outline's crossings at each of its
/// long edges, and the feet.
pub(super) const ON_BLADE: usize = 136;

/// Finds the contacts that a step of `step` seconds may close. Contacts with the blade come first.
pub(super) fn find(
    setup: &Setup,
    body: &Body,
    (now, next): (&BladePose, &BladePose),
    step: f64,
    found: &mut Vec<Contact>,
) {
    found.clear();
    on_blade(setup, body, (now, next), step, found);
    on_table(setup, body, step, found);
    on_blocks(setup, body, step, found);
}

/// Maximum number of points of one pair of cuboids: two rectangles have at most eight corners in
/// common.
const OF_A_PAIR: usize = 8;

/// Returns the maximum number of contacts.
pub(super) fn count(setup: &Setup) -> usize {
    ON_BLADE + setup.tips.len() + OF_A_PAIR * setup.parts.len() * setup.blocks.len()
}

fn on_blocks(setup: &Setup, body: &Body, step: f64, found: &mut Vec<Contact>) {
    let reach = GRAVITY * step * step + 1e-3;
    let reach_of_any = reach + body.fastest(setup.reach) * step;
    let frame = Pose3 { position: body.centre, rotation: body.turn };
    for (i, part) in setup.parts.iter().enumerate() {
        let part = Box3 { pose: frame * part.pose, ..*part };
        for (j, (block, friction)) in setup.blocks.iter().enumerate() {
            let mut id = ON_BLADE + setup.tips.len();
            id += OF_A_PAIR * (i * setup.blocks.len() + j);
            let end = id + OF_A_PAIR;
            part.contacts(block, reach_of_any, |contact| {
                let arm = contact.point - body.centre;
                let speed = body.speed + body.spin.cross(&arm);
                if id == end || contact.gap + speed.dot(&contact.normal) * step > reach {
                    return;
                }
                found.push(Contact {
                    id,
                    arm,
                    normal: contact.normal,
                    gap: contact.gap,
                    friction: *friction,
                    surface: Vector3::zeros(),
                });
                id += 1;
            });
        }
    }
}

fn on_table(setup: &Setup, body: &Body, step: f64, found: &mut Vec<Contact>) {
    // Maximum fall of a point, by its speed and by its weight.
    let reach = GRAVITY * step * step + 1e-3;
    let up = body.axes.row(2);
    let reach_of_any = reach + body.fastest(setup.reach) * step;
    for (k, tip) in setup.tips.iter().enumerate() {
        let gap =
            body.centre.z + up[0] * tip.at.x + up[1] * tip.at.y + up[2] * tip.at.z - tip.radius;
        if gap > reach_of_any {
            continue;
        }
        let mut arm = body.axes * tip.at;
        arm.z -= tip.radius;
        let falling = body.speed.z + body.spin.x * arm.y - body.spin.y * arm.x;
        if gap + falling * step > reach {
            continue;
        }
        found.push(Contact {
            id: ON_BLADE + k,
            arm,
            normal: Vector3::z(),
            gap,
            friction: setup.friction[0],
            surface: Vector3::zeros(),
        });
    }
}

fn on_blade(
    setup: &Setup,
    body: &Body,
    (now, next): (&BladePose, &BladePose),
    step: f64,
    found: &mut Vec<Contact>,
) {
    let vertical: Vector3 = body.axes.column(2).into();
    // The large face on whose side the tip is.
    let depth = vertical.dot(&(now.tip - now.up * (0.5 * setup.blade_height) - body.centre));
    let under = depth < setup.frame.z + 0.5 * setup.thickness;
    let level = setup.frame.z + if under { 0.0 } else { setup.thickness };
    let side = if under { 1.0 } else { -1.0 };
    let normal = vertical * side;
    let [half, length] = setup.blade;
    let reach = GRAVITY * step * step + 2e-3;
    let moved = |at: &Vector3| {
        let local = at - now.tip;
        let (a, b) = (local.dot(&now.along), local.dot(&now.up));
        (next.tip + next.along * a + next.up * b - now.tip - now.along * a - now.up * b) / step
    };
    let mut push = |id: usize, at: Vector3, normal: Vector3, gap: f64| {
        let arm = at - body.centre;
        if gap < -INSIDE {
            return;
        }
        let surface = moved(&at);
        let speed = body.speed + body.spin.cross(&arm) - surface;
        if gap + speed.dot(&normal) * step > reach {
            return;
        }
        found.push(Contact { id, arm, normal, gap, friction: setup.friction[1], surface });
    };
    let low = -setup.blade_height;
    let edges = [(half, 0.0), (-half, 0.0), (half, low), (-half, low)];
    // Depth of each long edge in the plate; the two deepest may touch.
    let into = edges.map(|(y, z)| y * normal.y + z * now.up.dot(&normal));
    for (k, (y, z)) in edges.into_iter().enumerate() {
        let before = (0..4).filter(|other| into[*other] > into[k]).count();
        if before > 1 {
            continue;
        }
        // In body axes, from the tip backwards.
        let tip = Vector3::new(0.0, y, 0.0) + now.tip + now.up * z;
        let from = body.axes.tr_mul(&(tip - body.centre));
        let way = body.axes.tr_mul(&(-now.along));
        let Some(over) = clip(&setup.outline, from, way, length) else { continue };
        let crossing = |(at, edge): (f64, usize)| {
            let (a, b) = (setup.outline[edge], setup.outline[(edge + 1) % setup.outline.len()]);
            let rim = body.axes * Vector3::new(b.x - a.x, b.y - a.y, 0.0);
            let across = rim.cross(&now.along);
            let length = across.norm();
            // Parallel edges meet face to face.
            let (mut across, parallel) = (across / length, length < 1e-6 * rim.norm());
            if parallel {
                across = normal;
            } else if across.dot(&normal) < 0.0 {
                across = -across;
            }
            let local = from + way * at;
            let rise = (level - local.z) * side;
            (body.centre + body.axes * local, across, rise * normal.dot(&across))
        };
        match over.enter.map(crossing) {
            Some((at, across, gap)) => push(4 + k, at, across, gap),
            None => push(k, tip, normal, (level - from.z) * side),
        }
        if let Some((at, across, gap)) = over.leave.map(crossing) {
            push(8 + k, at, across, gap);
        }
    }
    feet_on_blade(setup, body, now, &mut push);
}

/// Adds contacts of the feet, as balls, with the blade. They stop a plate that slides along the
/// blade.
fn feet_on_blade(
    setup: &Setup,
    body: &Body,
    now: &BladePose,
    push: &mut impl FnMut(usize, Vector3, Vector3, f64),
) {
    let [half, length] = setup.blade;
    for (k, tip) in setup.tips[..setup.outline.len()].iter().enumerate() {
        let at = body.centre + body.axes * tip.at;
        let away = at - now.tip;
        let local = [away.dot(&now.along), at.y, away.dot(&now.up)];
        let low = [-length, -half, -setup.blade_height];
        let high = [0.0, half, 0.0];
        let near = |k: usize| local[k].clamp(low[k], high[k]);
        let nearest = [near(0), near(1), near(2)];
        let apart = [0, 1, 2].map(|k| local[k] - nearest[k]);
        let distance = apart.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(1e-9..=0.02).contains(&distance) {
            continue;
        }
        let normal =
            (now.along * apart[0] + Vector3::y() * apart[1] + now.up * apart[2]) / distance;
        push(
            ON_BLADE - setup.outline.len() + k,
            at - normal * distance,
            normal,
            distance - tip.radius,
        );
    }
}

/// The part of a ray over an outline.
struct Over {
    /// Position of entry, and the side; `None` if the ray begins inside.
    enter: Option<(f64, usize)>,
    /// Position of exit, and the side.
    leave: Option<(f64, usize)>,
}

/// Returns the part of the ray `from + s way`, 0 <= s <= `length`, that lies over the outline along
/// the body's vertical.
fn clip(outline: &[Vector], from: Vector3, way: Vector3, length: f64) -> Option<Over> {
    let (mut first, mut last) = (0.0, length);
    let mut over = Over { enter: None, leave: None };
    for (k, a) in outline.iter().enumerate() {
        let b = outline[(k + 1) % outline.len()];
        let (x, y) = (b.x - a.x, b.y - a.y);
        // Positive inside.
        let side = x * (from.y - a.y) - y * (from.x - a.x);
        let rate = x * way.y - y * way.x;
        if rate.abs() < 1e-15 {
            if side < 0.0 {
                return None;
            }
            continue;
        }
        let at = -side / rate;
        if rate > 0.0 && at > first {
            (first, over.enter) = (at, Some((at, k)));
        } else if rate < 0.0 && at < last {
            (last, over.leave) = (at, Some((at, k)));
        }
    }
    (first < last).then_some(over)
}
