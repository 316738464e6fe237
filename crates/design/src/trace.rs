//! Handles routed through free space, from the pushing face around obstructions to a feasible hand
//! position, with as few bends as possible.
//!
//! Randomly sampled tools mostly intersect a wall. The search therefore starts from these handles,
//! and screening evaluates their pushes.

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;

use pushplan::geometry::{Footprint, Pose, Vector, clearance, perpendicular, swept_clearance};
use pushplan::plan::{CostToGo, HAND_CLEARANCE, MIN_LENGTH, OBSTACLE_CLEARANCE, STAND_OFF};
use pushplan::scene::Mover;
use pushplan::task::Task;

use super::assembly::{Assembly, Bar, HEIGHT, Route};
use super::form::Form;

/// Widths of handles that are tried, metres, the most effective for pushing first.
const WIDTHS: [f64; 3] = [0.03, 0.018, 0.01];

/// Maximum length of a link, metres; corners need a little of the limit.
const LONGEST: f64 = 0.48;

/// Clearance beyond the rules, metres, because tools are made in whole millimetres and degrees.
const ROOM: f64 = 0.0015;

/// Clearance of a hand, metres.
const HAND_ROOM: f64 = HAND_CLEARANCE + 2e-3;

/// Grid spacing of candidate hand positions and bends, metres.
const SPACING: f64 = 0.08;

/// Maximum number of coordinates along an axis at which handles may bend.
const MOST: usize = 20;

/// Maximum number of reached points from which a further point is tried, nearest first.
const TRIED: usize = 40;

/// Cosine of the angle between the last link and the push, below which the link pushes with its
/// side.
const ACROSS: f64 = 0.6;

/// Number of paths kept for one push, and minimum distance of their hands, metres.
const KEPT: usize = 6;
const APART: f64 = 0.1;

/// Lengths of bars at the end, as shares of the object's width.
const SHARES: [f64; 3] = [1.2, 0.8, 0.5];

/// Offsets of the handle from the middle of the pushing bar, in half widths of the object.
const FEET: [f64; 3] = [0.0, 0.4, -0.4];

/// Push for which a tool is wanted.
struct Wanted {
    object: usize,
    direction: f64,
    travel: f64,
    width: f64,
    aside: f64,
}

/// Returns handles of at most `parts` parts for the first push of a task, fewest parts first.
pub(super) fn traced(task: &Task, field: &CostToGo, parts: usize) -> Vec<Assembly> {
    let start = task.scene.start();
    let mut wanted = Vec::new();
    for object in field.movers(&start) {
        for direction in task.pushes.directions.headings() {
            let ahead = Vector::new(direction.cos(), direction.sin());
            let left = |travel: f64| field.carried((&start, object), ahead * travel);
            let travels = (1..=4).map(|k| task.pushes.length * f64::from(k) / 4.0);
            let best = travels.min_by(|a, b| left(*a).total_cmp(&left(*b)));
            let Some(travel) = best.filter(|travel| left(*travel) < left(0.0)) else { continue };
            let travel = travel.max(MIN_LENGTH);
            for (width, aside) in WIDTHS.iter().flat_map(|width| FEET.map(|aside| (*width, aside)))
            {
                wanted.push(Wanted { object, direction, travel, width, aside });
            }
        }
    }
    let found: Vec<Vec<Assembly>> =
        wanted.par_iter().map(|one| Tracing::new(task, one).assemblies(parts)).collect();
    let mut all: Vec<Assembly> = found.into_iter().flatten().collect();
    // The sort is stable: of equal part counts the wider handle comes first.
    all.sort_by_key(|assembly| assembly.form.parts());
    all
}

/// Free-space model for a handle that makes one push.
struct Tracing<'a> {
    task: &'a Task,
    wanted: &'a Wanted,
    /// Displacement of the push.
    shift: Vector,
    /// Half of the object's extent across the push, metres.
    half_width: f64,
    /// Centre of the pushing face, within its thickness.
    face: Vector,
    /// End of the handle.
    foot: Vector,
    fixed: Vec<(Footprint, Pose)>,
    objects: Vec<(Footprint, Pose)>,
}

impl<'a> Tracing<'a> {
    fn new(task: &'a Task, wanted: &'a Wanted) -> Self {
        let scene = &task.scene;
        let ahead = Vector::new(wanted.direction.cos(), wanted.direction.sin());
        let object = &scene.objects[wanted.object];
        let back = object.shape.footprint().extent(object.pose.local_vector(-ahead));
        let face = object.pose.position - ahead * (back + STAND_OFF + ROOM + wanted.width / 2.0);
        let left = perpendicular(ahead);
        let half_width = object.shape.footprint().extent(object.pose.local_vector(left));
        let span = [task.pushes.lift, task.pushes.lift + HEIGHT];
        let fixed = scene.fixed(Mover::Tool, span).map(|fixed| (fixed.footprint, fixed.pose));
        let objects = scene.objects.iter().filter(|object| object.meets(span));
        Self {
            task,
            wanted,
            shift: ahead * wanted.travel,
            half_width,
            face,
            foot: face + left * (wanted.aside * half_width),
            fixed: fixed.collect(),
            objects: objects.map(|object| (object.shape.footprint(), object.pose)).collect(),
        }
    }

    /// Returns the paths to the hand as tools.
    fn assemblies(&self, parts: usize) -> Vec<Assembly> {
        let mut found = Vec::new();
        let yaw = self.task.pushes.grip_yaws.first().copied().unwrap_or_default();
        for way in self.ways(parts.min(Form::LINKS)) {
            let ([hand, ..], [.., before, _]) = (&way[..], &way[..]) else { continue };
            let (hand, before) = (*hand, *before);
            let last = (self.foot - before).normalize();
            let across = last.dot(&self.shift.normalize()).abs() < ACROSS;
            let middle = self.wanted.aside == 0.0;
            let mut way = way.clone();
            if across && middle {
                // Such a link pushes with its side, extended as far as there is space.
                let ends = SHARES.map(|share| self.face + last * (share * self.half_width));
                let free =
                    |end: &Vector| (end - before).norm() <= LONGEST && self.is_free(before, *end);
                way.pop();
                way.push(ends.into_iter().find(free).unwrap_or(self.face));
            }
            // The frame is the end effector's, rotated by the grip yaw.
            let grip = Pose { position: hand, heading: yaw };
            let points: Vec<Vector> = way.iter().map(|point| grip.local_point(*point)).collect();
            let width = self.wanted.width;
            let bar = self.bar().filter(|_| !across && way.len() <= parts).map(|length| {
                let heading = self.wanted.direction + FRAC_PI_2 - yaw;
                Bar { length, heading, aside: -self.wanted.aside * self.half_width }
            });
            let with = |bar| Assembly::along(&Route { points: points.clone(), width, bar });
            found.extend(bar.and_then(|bar| with(Some(bar))));
            // Without a bar, a handle pushes straight only at the object's middle.
            found.extend(middle.then(|| with(None)).flatten());
        }
        found
    }

    /// Returns the length of the longest collision-free bar at the face.
    fn bar(&self) -> Option<f64> {
        let left = perpendicular(self.shift.normalize());
        let free = |length: &f64| {
            let out = left * (length / 2.0);
            self.is_free(self.face - out, self.face + out)
        };
        SHARES.map(|share| 2.0 * share * self.half_width).into_iter().find(free)
    }

    /// Returns paths from hand to face, with as few links as possible and at most `links`, short
    /// ones first.
    fn ways(&self, links: usize) -> Vec<Vec<Vector>> {
        if !self.is_free(self.foot, self.foot) {
            return Vec::new();
        }
        let mut points = vec![self.foot];
        points.extend(self.bends().into_iter().filter(|point| self.is_free(*point, *point)));
        let hands: Vec<bool> = points.iter().map(|point| self.is_hand(*point)).collect();
        // Number of links, length of the path from the face, and the point before.
        let mut reached: Vec<Option<(usize, f64, usize)>> = vec![None; points.len()];
        reached[0] = Some((0, 0.0, 0));
        for link in 1..=links {
            let from: Vec<(usize, f64)> = reached
                .iter()
                .enumerate()
                .filter_map(|(k, way)| way.filter(|way| way.0 + 1 == link).map(|way| (k, way.1)))
                .collect();
            let next = |to: usize| -> Option<(usize, f64, usize)> {
                if reached[to].is_some() || (link == links && !hands[to]) {
                    return None;
                }
                let length = |(k, before): &(usize, f64)| before + (points[*k] - points[to]).norm();
                let mut near: Vec<&(usize, f64)> = from
                    .iter()
                    .filter(|(k, _)| (points[*k] - points[to]).norm() <= LONGEST)
                    .collect();
                near.sort_by(|a, b| length(a).total_cmp(&length(b)));
                let mut near = near.into_iter().take(TRIED);
                let seen = near.find(|(k, _)| self.is_free(points[*k], points[to]))?;
                Some((link, length(seen), seen.0))
            };
            let found: Vec<Option<(usize, f64, usize)>> = (0..points.len()).map(next).collect();
            let new = found.into_iter().enumerate().filter(|(_, way)| way.is_some());
            new.for_each(|(k, way)| reached[k] = way);
        }
        let mut ends: Vec<usize> =
            (1..points.len()).filter(|k| hands[*k] && reached[*k].is_some()).collect();
        let far = |k: &usize| reached[*k].map_or((usize::MAX, 0.0), |way| (way.0, way.1));
        ends.sort_by(|a, b| {
            let (a, b) = (far(a), far(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        let mut kept: Vec<usize> = Vec::new();
        for end in ends {
            if kept.len() < KEPT && kept.iter().all(|k| (points[*k] - points[end]).norm() >= APART)
            {
                kept.push(end);
            }
        }
        let way = |end: &usize| {
            let mut way = vec![points[*end]];
            let mut at = *end;
            while let Some((_, _, before)) = reached[at].filter(|_| at != 0) {
                at = before;
                way.push(points[at]);
            }
            way
        };
        kept.iter().map(way).collect()
    }

    /// Returns the candidate bends and ends of a handle: an even grid, and coordinates that just
    /// pass an obstruction.
    fn bends(&self) -> Vec<Vector> {
        let reach = self.task.robot.reach_max;
        let even = |axis: usize| {
            let low = (-reach).min(self.foot[axis] - SPACING);
            let high = reach.max(self.foot[axis] + SPACING);
            let count = ((high - low) / SPACING).ceil() as usize;
            (0..=count).map(move |k| low + SPACING * k as f64)
        };
        let near = |axis: usize| {
            let along = [Vector::x(), Vector::y()][axis];
            let apart = OBSTACLE_CLEARANCE + ROOM + self.wanted.width / 2.0;
            let sides = |(shape, pose): &(Footprint, Pose), swept: f64| {
                let extent = |way: Vector| shape.extent(pose.local_vector(way)) + apart;
                let middle = pose.position[axis];
                let (low, high) = (middle - extent(-along), middle + extent(along));
                [low - swept.max(0.0), high - swept.min(0.0)]
            };
            let mut all: Vec<f64> = vec![self.foot[axis]];
            all.extend(self.fixed.iter().flat_map(|fixed| sides(fixed, self.shift[axis])));
            all.extend(self.objects.iter().flat_map(|object| sides(object, 0.0)));
            all.sort_by(f64::total_cmp);
            // Coordinates midway between neighbouring obstructions are included too.
            let middles: Vec<f64> = all.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
            all.extend(middles);
            all.sort_by(f64::total_cmp);
            all.dedup_by(|a, b| (*a - *b).abs() < ROOM);
            all.sort_by(|a, b| (a - self.foot[axis]).abs().total_cmp(&(b - self.foot[axis]).abs()));
            all.truncate(MOST);
            all
        };
        let grid = |xs: &[f64], ys: &[f64]| -> Vec<Vector> {
            xs.iter().flat_map(|x| ys.iter().map(|y| Vector::new(*x, *y))).collect()
        };
        let (xs, ys): (Vec<f64>, Vec<f64>) = (even(0).collect(), even(1).collect());
        let mut bends = grid(&near(0), &near(1));
        bends.extend(grid(&xs, &[self.foot.y]));
        bends.extend(grid(&xs, &ys).into_iter().filter(|at| self.task.robot.reaches(*at)));
        bends
    }

    /// Returns `true` if a bar between two points is collision-free at the start of the push and
    /// along it.
    fn is_free(&self, from: Vector, to: Vector) -> bool {
        let way = to - from;
        let half = Vector::new(way.norm() / 2.0, self.wanted.width / 2.0);
        let shape = Footprint::Rectangle { half: Vector::new(half.x + half.y, half.y) };
        let heading = if half.x > 0.0 { way.y.atan2(way.x) } else { self.wanted.direction + PI };
        let pose = Pose { position: from + way / 2.0, heading };
        let there = Pose { position: pose.position + self.shift, ..pose };
        let apart = OBSTACLE_CLEARANCE + ROOM;
        let clear = |(other, at): &(Footprint, Pose)| {
            swept_clearance(&shape, &pose, &there, (other, at), 2.0 * apart) > apart
        };
        let set_down = |(other, at): &(Footprint, Pose)| {
            clearance((&shape, &pose), (other, at), 2.0 * apart) > ROOM
        };
        self.objects.iter().all(set_down) && self.fixed.iter().all(clear)
    }

    /// Returns `true` if the hand may be at a position, and displaced at the end of the push.
    fn is_hand(&self, at: Vector) -> bool {
        let robot = &self.task.robot;
        if !(robot.reaches(at) && robot.reaches(at + self.shift)) {
            return false;
        }
        let Some(hand) = robot.hand else { return true };
        let shape = Footprint::Disc { radius: hand.radius };
        let low = hand.begins(self.task.pushes.lift + HEIGHT);
        let (from, to) = (Pose::new(at.x, at.y, 0.0), at + self.shift);
        let to = Pose::new(to.x, to.y, 0.0);
        let clear = |other: (&Footprint, &Pose)| {
            swept_clearance(&shape, &from, &to, other, 2.0 * HAND_ROOM) > HAND_ROOM
        };
        let scene = &self.task.scene;
        let span = [low, f64::INFINITY];
        scene.fixed(Mover::Hand, span).all(|fixed| clear((&fixed.footprint, &fixed.pose)))
            && scene
                .objects
                .iter()
                .filter(|object| object.top() > low)
                .all(|object| clear((&object.shape.footprint(), &object.pose)))
    }
}
