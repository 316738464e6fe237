//! Demand: an object covers a share of its own outline at a pose, as in Push-T.
//!
//! Search and refinement use tolerances of position and heading, each of which alone loses half of
//! the allowed loss of coverage.
//!
//! Outlines are polygons. A disc is approximated by 64 corners, which changes a share by less than
//! 0.001.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector, area_of, common_area, without};

use crate::scene::Scene;

use super::check::name;
use super::words::{degrees, point};
use super::{Area, AtPlace, Check, Demand, End, Facing, Kind, Mark, Quantity, less};

/// Number of directions in which an object is shifted to determine its tolerance.
const DIRECTIONS: usize = 16;

/// Number of bisections, to a millionth of the interval.
const HALVINGS: usize = 20;

/// Largest loss of coverage by any rotation of an outline that counts as round.
const ROUND: f64 = 0.002;

/// A minimum share of an outline that must be covered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coverage {
    /// Minimum share of the area, 0 to 1.
    pub share: f64,
    /// Outline with all parts in the object's frame: convex polygons that share no area, metres.
    pieces: Vec<Vec<Vector>>,
    /// Position of the wanted outline, with a tolerance for search.
    pub place: AtPlace,
    /// Heading of the wanted outline, with a tolerance for search; `None` for round outlines.
    pub facing: Option<Facing>,
}

impl Coverage {
    /// Demands that object `object` with all its parts covers a share of its outline at `pose`;
    /// `None` if the object does not exist in `scene`.
    pub fn of(scene: &Scene, object: usize, pose: Pose, share: f64) -> Option<Box<Self>> {
        let mut pieces: Vec<Vec<Vector>> = Vec::new();
        for (shape, pose) in scene.solids(object)? {
            let mut left = vec![Area { shape, pose }.corners()];
            for known in &pieces {
                left = left.iter().flat_map(|piece| without(piece, known)).collect();
            }
            pieces.extend(left);
        }
        let place = AtPlace { position: pose.position, tolerance: 0.0, relative: None };
        let mut coverage = Self { share, pieces, place, facing: None };
        let (tolerance, turn) = coverage.tolerances();
        coverage.place.tolerance = tolerance;
        coverage.facing = turn.map(|turn| Facing::new(pose.heading, turn));
        Some(Box::new(coverage))
    }

    /// Returns the heading of the wanted outline in its own frame, radians.
    pub fn heading(&self) -> f64 {
        self.facing.as_ref().map_or(0.0, |facing| facing.heading)
    }

    /// Returns the outline of the object at `pose`: convex polygons that share no area, metres.
    pub fn outline(&self, pose: &Pose) -> Vec<Vec<Vector>> {
        let turn = |corners: &Vec<Vector>| corners.iter().map(|at| pose.point(*at)).collect();
        self.pieces.iter().map(turn).collect()
    }

    /// Returns the share of the outline at `wanted` that the object covers at `own`.
    pub fn share_of(&self, own: &Pose, wanted: &Pose) -> f64 {
        let own = self.outline(&(wanted.inverse() * *own));
        let common = |piece: &Vec<Vector>| {
            own.iter().map(|other| area_of(&common_area(piece, other))).sum::<f64>()
        };
        let whole: f64 = self.pieces.iter().map(|piece| area_of(piece)).sum();
        self.pieces.iter().map(common).sum::<f64>() / whole
    }

    /// Returns the tolerances of position, metres, and of rotation about the position, radians,
    /// each of which alone loses half of the allowed loss. Round outlines have no tolerance of
    /// rotation.
    fn tolerances(&self) -> (f64, Option<f64>) {
        let wanted = Pose::default();
        let enough = 0.5 * (1.0 + self.share);
        let covers = |own: Pose| self.share_of(&own, &wanted);
        let shifted = |by: f64| {
            let of = |k: usize| {
                let way = TAU * k as f64 / DIRECTIONS as f64;
                covers(Pose::new(by * way.cos(), by * way.sin(), 0.0))
            };
            (0..DIRECTIONS).map(of).fold(1.0, f64::min)
        };
        let turned = |by: f64| [by, -by].map(|turn| covers(Pose::new(0.0, 0.0, turn)));
        let turned = |by: f64| turned(by).into_iter().fold(1.0, f64::min);
        let size = self.pieces.iter().flatten().map(Vector::norm).fold(0.0, f64::max);
        let turns = (1..=DIRECTIONS).map(|k| PI * k as f64 / DIRECTIONS as f64);
        let first = turns.into_iter().find(|turn| turned(*turn) < enough.min(1.0 - ROUND));
        let turn = first.map(|turn| largest(turn, |by| turned(by) >= enough));
        (largest(2.0 * size, |by| shifted(by) >= enough), turn)
    }
}

impl Kind for Coverage {
    fn demand(&self) -> Demand {
        Demand::Coverage(Box::new(self.clone()))
    }

    fn is_met(&self, end: &End) -> bool {
        self.covered(end).is_some_and(|covered| covered >= self.share)
    }

    fn words(&self, _: usize, _: &Scene) -> String {
        let turn = self.facing.as_ref().map(|own| format!(", heading {}", degrees(own.heading)));
        let (share, at) = (percent(self.share), point(self.place.position));
        format!("covering {share} of its outline at {at}{}", turn.unwrap_or_default())
    }

    fn off(&self, end: &End) -> Option<Vector> {
        self.place.off(end)
    }

    fn turned(&self, end: &End) -> Option<f64> {
        self.facing.as_ref()?.turned(end)
    }

    fn tolerance(&self) -> Option<f64> {
        Some(self.place.tolerance)
    }

    /// Returns the larger score of position and heading, but more than 1 exactly if too little is
    /// covered.
    fn score(&self, end: &End) -> f64 {
        let place = self.place.score(end);
        let score = self.facing.as_ref().map_or(place, |facing| place.max(facing.score(end)));
        match score.is_nan() {
            true => score,
            false if self.is_met(end) => score.min(1.0),
            false => score.max(1.0f64.next_up()),
        }
    }

    fn position(&self) -> Option<Vector> {
        Some(self.place.position)
    }

    fn anchor(&self) -> Vector {
        self.place.position
    }

    fn facing(&self) -> Option<&Facing> {
        self.facing.as_ref()
    }

    fn share(&self) -> Option<f64> {
        Some(self.share)
    }

    fn covered(&self, end: &End) -> Option<f64> {
        let frame = self.place.relative.and_then(|other| end.state.poses.get(other));
        let (position, heading) = (self.place.position, self.heading());
        let wanted = match frame {
            Some(frame) => Pose {
                position: frame.point(position),
                heading: self.facing.as_ref().map_or(0.0, |own| frame.heading + own.heading),
            },
            None => Pose { position, heading },
        };
        Some(self.share_of(end.pose(), &wanted))
    }

    fn stricter(&self, place: f64, turn: f64) -> Demand {
        let mut own = self.clone();
        own.place.tolerance = less(self.place.tolerance, place);
        if let Some(facing) = &mut own.facing {
            facing.tolerance = less(facing.tolerance, turn);
        }
        let left = own.place.tolerance / self.place.tolerance;
        own.share = 1.0 - (1.0 - self.share) * left;
        own.demand()
    }

    fn shifted(&self, shift: Vector) -> Demand {
        let mut own = self.clone();
        own.place.position += shift;
        own.demand()
    }

    fn aimed(&self, aim: &Demand, shift: Vector, turn: f64) -> Demand {
        let mut own = self.clone();
        own.place.position += aim.kind().anchor() - self.anchor() - shift;
        if let (Some(facing), Some(last)) = (&mut own.facing, aim.kind().facing()) {
            facing.heading = last.heading - turn;
        }
        own.demand()
    }

    fn seen_from(&self, frame: &Pose) -> Demand {
        let mut own = self.clone();
        own.place.position = frame.point(self.place.position);
        own.place.relative = None;
        own.facing = own.facing.map(|facing| facing.in_frame(frame));
        own.demand()
    }

    fn relative_to(&self, other: usize) -> Demand {
        let mut own = self.clone();
        own.place.relative = Some(other);
        own.facing = own.facing.map(|facing| Facing { relative: Some(other), ..facing });
        own.demand()
    }

    fn relative(&self) -> Option<usize> {
        self.place.relative
    }

    fn fault(&self, object: usize, scene: &Scene) -> Option<String> {
        if !(0.0 < self.share && self.share < 1.0) {
            return Some("the share to cover must be between 0 and 1".to_owned());
        }
        let turn = self.facing.as_ref().and_then(|facing| facing.fault(object, scene));
        self.place.fault(object, scene).or(turn)
    }

    fn check(&self, object: usize, scene: &Scene) -> Check {
        let at = self.place.position;
        let quantity = Quantity::Covered {
            object: name(object, scene),
            frame: self.place.relative.map(|other| name(other, scene)),
            at: [at.x, at.y, self.heading()],
            pieces: self.outline(&Pose::default()),
        };
        Check::from(quantity, self.share)
    }

    fn marks(&self, object: usize, scene: &Scene) -> Vec<Mark> {
        let pose = Pose { position: self.place.position, heading: self.heading() };
        let facing = self.facing.iter().flat_map(|facing| facing.marks(object, scene));
        let outline = Mark::Outline { centre: pose.position, pieces: self.outline(&pose) };
        [outline].into_iter().chain(facing).collect()
    }
}

fn percent(share: f64) -> String {
    let value = 1e2 * share;
    if value.abs() < 99.5 { format!("{value:.1} %") } else { format!("{value:.0} %") }
}

/// Returns by bisection the largest number up to which `holds` is true, between 0 and `most`, at
/// which it is false.
fn largest(most: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *if holds(middle) { &mut low } else { &mut high } = middle;
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{Object, State},
        task::Goal,
    };

    /// The T of Push-T; its stem overlaps the bar.
    fn tee() -> Scene {
        let bar = Object::cuboid("T", [0.12, 0.03, 0.03]).at(0.5, 0.0, 0.0);
        let stem = Object::cuboid("T/stem", [0.03, 0.11, 0.03]);
        Scene::new([bar]).with_part(0, stem, Pose::new(0.0, -0.05, 0.0))
    }

    #[test]
    fn shifted_boxes_cover_what_is_left_of_them() {
        let scene = Scene::new([Object::cuboid("box", [0.1, 0.04, 0.05])]);
        let coverage = Coverage::of(&scene, 0, Pose::default(), 0.9).expect("it exists");
        let wanted = Pose::new(0.4, 0.1, 0.7);
        for (x, y) in [(0.0, 0.0), (0.02, 0.0), (0.01, -0.01), (0.09, 0.0), (0.2, 0.0)] {
            let own = wanted * Pose::new(x, y, 0.0);
            let exact = (1.0 - f64::abs(x) / 0.1).max(0.0) * (1.0 - f64::abs(y) / 0.04);
            assert!((coverage.share_of(&own, &wanted) - exact).abs() < 1e-9, "{x} {y}");
        }
        let across = coverage.share_of(&(wanted * Pose::new(0.0, 0.0, 0.5 * PI)), &wanted);
        assert!((across - 0.4).abs() < 1e-9, "a cross");
    }

    #[test]
    fn parts_that_overlap_count_once() {
        let coverage = Coverage::of(&tee(), 0, Pose::default(), 0.95).expect("it exists");
        let area: f64 = coverage.pieces.iter().map(|piece| area_of(piece)).sum();
        assert!((area - (0.12 * 0.03 + 0.03 * 0.09)).abs() < 1e-9, "{area}");
        // A shift along the stem uncovers the bar's ends and the end of the stem.
        let wanted = Pose::new(0.5, 0.1, -2.0);
        let covered = coverage.share_of(&(wanted * Pose::new(0.0, 0.01, 0.0)), &wanted);
        assert!((covered - (1.0 - 0.12 * 0.01 / area)).abs() < 1e-9, "{covered}");
    }

    #[test]
    fn discs_are_off_by_less_than_a_thousandth_and_have_no_heading() {
        let scene = Scene::new([Object::cylinder("can", 0.05, 0.1)]);
        let coverage = Coverage::of(&scene, 0, Pose::default(), 0.9).expect("it exists");
        for k in 0..40 {
            let far = 0.0025 * f64::from(k) / 0.05;
            let lens = 2.0 * (far / 2.0).acos() - far * (1.0 - far * far / 4.0).sqrt();
            let (turn, way) = (0.37 * f64::from(k), 1.1 * f64::from(k));
            let own = Pose::new(0.05 * far * way.cos(), 0.05 * far * way.sin(), turn);
            let off = coverage.share_of(&own, &Pose::default()) - lens / PI;
            assert!(off.abs() < 0.001, "{k}: {off}");
        }
        assert!(coverage.tolerances().1.is_none());
    }

    #[test]
    fn the_score_is_at_most_one_where_enough_is_covered_and_only_there() {
        let scene = tee();
        let wanted = Pose::new(0.45, 0.05, 0.6);
        let goal = Goal::covering(&scene, 0, wanted, 0.9).expect("it exists");
        let (mut reached, mut missed) = (0, 0);
        for k in 0..2000 {
            let of = |factor: f64, most: f64| most * (factor * f64::from(k)).sin();
            let own = wanted * Pose::new(of(1.3, 0.004), of(2.1, 0.004), of(0.7, 0.06));
            let mut state = State::at_rest(vec![own; 2]);
            state.poses[1] = own * Pose::new(0.0, -0.05, 0.0);
            let covered = goal.covered(&state).expect("a coverage");
            assert_eq!(goal.reached(&state), covered >= 0.9);
            assert_eq!(goal.score(&state) <= 1.0, covered >= 0.9, "{covered}");
            *if covered >= 0.9 { &mut reached } else { &mut missed } += 1;
        }
        assert!(reached > 100 && missed > 100, "{reached} {missed}");
        let Facing { heading, tolerance: within, .. } = *goal.heading().expect("a T has one");
        assert_eq!(heading, 0.6);
        // Each alone loses half of the allowed loss.
        for own in [Pose::new(goal.tolerance(), 0.0, 0.0), Pose::new(0.0, 0.0, within)] {
            let [Demand::Coverage(coverage)] = &goal.demands[..] else { panic!("one") };
            let covered = coverage.share_of(&own, &Pose::default());
            assert!(covered > 0.95 - 1e-4 && covered < 1.0, "{covered}");
        }
        let strict = goal.stricter(0.25 * goal.tolerance(), 0.0);
        assert!((strict.wanted_share().expect("one") - 0.925).abs() < 1e-9);
    }
}
