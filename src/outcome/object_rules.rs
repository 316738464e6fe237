//! Rules for objects at every instant of a motion: they stay on the table, outside of keep-out
//! regions, and within the displacement that `keep` allows.
//!
//! Rollouts and replays check every frame, and the closed loop checks every observation.

use crate::geometry::{Footprint, Pose, Pose3, Vector, Vector3};
use crate::scene::{Region, Scene, State, TableTop};

use super::Warning;

/// Rules for the objects of a scene, for exact or observed poses.
#[derive(Clone, Debug)]
pub struct ObjectRules<'a> {
    scene: &'a Scene,
    kept: Vec<Kept>,
    /// Clearance of objects from keep-out regions, metres.
    margin: f64,
    /// State at the start of the motion, if the motion may start elsewhere than the scene.
    start: Option<&'a State>,
    /// Errors of the poses of all objects, metres and radians; empty for exact poses.
    errors: Vec<[f64; 2]>,
}

impl<'a> ObjectRules<'a> {
    /// Creates the rules for exact poses.
    pub fn of(scene: &'a Scene) -> Self {
        let kept = (0..scene.objects.len()).filter_map(|object| Kept::of(scene, object));
        Self { scene, kept: kept.collect(), margin: 0.0, start: None, errors: Vec::new() }
    }

    /// Sets the clearance of objects from keep-out regions, metres.
    pub fn apart(self, margin: f64) -> Self {
        Self { margin, ..self }
    }

    /// Sets the start of the motion: objects that are still there break no `keep`.
    pub fn starting(self, start: &'a State) -> Self {
        Self { start: Some(start), ..self }
    }

    /// Sets the largest errors of observed poses by object, metres and radians. A displacement or
    /// an overlap within them counts as none.
    pub fn observed(self, errors: Vec<[f64; 2]>) -> Self {
        Self { errors, ..self }
    }

    /// Returns `true` if no state can break a rule.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty() && self.scene.table_top.is_none() && self.regions().next().is_none()
    }

    /// Returns the first violation in a trajectory.
    pub fn first_broken<'s>(&self, states: impl IntoIterator<Item = &'s State>) -> Option<Warning> {
        if self.is_empty() {
            return None;
        }
        states.into_iter().find_map(|state| self.broken(state))
    }

    /// Returns the first rule that a state breaks.
    pub fn broken(&self, state: &State) -> Option<Warning> {
        self.off_table(state).or_else(|| self.kept_out(state)).or_else(|| self.not_kept(state))
    }

    /// Returns a warning about the first object that left the table without permission.
    fn off_table(&self, state: &State) -> Option<Warning> {
        let top: TableTop = self.scene.table_top?;
        let mut bound = self.scene.things().filter(|(_, object)| !object.may_fall);
        let off = |(k, _): &(usize, _)| {
            !top.holds_within(self.scene.centre(*k, state), self.error(*k)[0])
        };
        bound.find(off).map(|(_, object)| Warning::OffTable { object: object.name.clone() })
    }

    /// Returns a warning about the first object inside a keep-out region or nearer to one than the
    /// margin.
    fn kept_out(&self, state: &State) -> Option<Warning> {
        // Most scenes have no keep-out regions.
        self.regions().next()?;
        if let Some(space) = &state.space {
            let mut all = self.scene.plates().zip(space);
            return all.find_map(|(plate, pose)| {
                let solids = plate.solids_at(pose);
                let region = self.regions().find(|region| region.holds_in_space(&solids))?;
                Some(Warning::KeptOut { object: plate.name, region: region.name.clone() })
            });
        }
        let mut objects = self.scene.objects.iter().zip(&state.poses).enumerate();
        objects.find_map(|(k, (object, pose))| {
            let footprint = object.shape.footprint();
            let [position, heading] = self.error(k);
            let error = position.hypot(footprint.bounding_radius() * heading);
            // An object that starts within the margin may stay there.
            let margin = |region: &Region| {
                let near = region.holds(&footprint, &object.pose, self.margin);
                if near { 0.0 } else { self.margin }
            };
            let holds = |region: &&Region| region.holds(&footprint, pose, margin(region) - error);
            let region = self.regions().find(holds)?;
            let (object, region) = (self.scene.thing_name(k).to_owned(), region.name.clone());
            Some(Warning::KeptOut { object, region })
        })
    }

    /// Returns a warning about the first object that was moved farther than its `keep` allows.
    fn not_kept(&self, state: &State) -> Option<Warning> {
        self.kept.iter().find_map(|kept| {
            let pose = state.poses.get(kept.object)?;
            let start = self.start.and_then(|start| start.poses.get(kept.object));
            if state.space.is_none() && (*pose == kept.from || start == Some(pose)) {
                return None;
            }
            let moved = match state.space.as_ref().and_then(|space| space.get(kept.object)) {
                Some(pose) => kept.farthest(self.error(kept.object), |corner| {
                    (pose.point(corner.own.push(0.0)) - corner.there).norm()
                }),
                None => kept.farthest(self.error(kept.object), |corner| {
                    (pose.point(corner.own) - corner.there.xy()).norm()
                }),
            }?;
            let object = self.scene.thing_name(kept.object).to_owned();
            Some(Warning::NotKept { object, moved, within: kept.within })
        })
    }

    fn regions(&self) -> impl Iterator<Item = &'a Region> + use<'a> {
        self.scene.keep_out.iter().filter(|region| region.objects)
    }

    fn error(&self, object: usize) -> [f64; 2] {
        self.errors.get(object).copied().unwrap_or_default()
    }
}

/// An object with a limited displacement.
#[derive(Clone, Debug)]
struct Kept {
    object: usize,
    /// Largest displacement, metres.
    within: f64,
    /// Pose from which the displacement counts.
    from: Pose,
    /// Centre, and corners of the outlines of all solids.
    corners: Vec<Corner>,
}

/// A point of an object.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Position in the object's frame, metres.
    own: Vector,
    /// Position from which the displacement counts, metres.
    there: Vector3,
}

impl Kept {
    /// Returns `None` for an object without a limit.
    fn of(scene: &Scene, object: usize) -> Option<Self> {
        let own = &scene.objects[object];
        let (within, from) = (own.keep?, own.kept_from.unwrap_or(own.pose));
        let mut points = vec![Vector::zeros()];
        points.extend(corners(&own.shape.footprint()));
        for part in scene.parts_of(object).map(|part| &scene.objects[part]) {
            let place = part.whole.map_or_else(Pose::default, |whole| whole.place);
            points.extend(corners(&part.shape.footprint()).into_iter().map(|at| place.point(at)));
        }
        let stands = Pose3::upright(from, own.z);
        let corner = |own: Vector| Corner { own, there: stands.point(own.push(0.0)) };
        Some(Self { object, within, from, corners: points.into_iter().map(corner).collect() })
    }

    /// Returns the largest displacement of a corner if some corner moved too far.
    fn farthest(
        &self,
        [position, heading]: [f64; 2],
        moved: impl Fn(&Corner) -> f64,
    ) -> Option<f64> {
        let each = self.corners.iter().map(|corner| {
            let error = position.hypot(corner.own.norm() * heading);
            let moved = moved(corner);
            (moved, moved > self.within.max(error))
        });
        let (farthest, broken) = each
            .fold((0.0f64, false), |(most, any), (moved, broken)| (most.max(moved), any || broken));
        broken.then_some(farthest)
    }
}

/// Returns the corners of an outline; the centre of a disc, whose rotation moves no corner.
fn corners(footprint: &Footprint) -> Vec<Vector> {
    match *footprint {
        Footprint::Disc { .. } => vec![Vector::zeros()],
        Footprint::Rectangle { half } => {
            let signs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
            signs.map(|[x, y]| Vector::new(x * half.x, y * half.y)).to_vec()
        }
        Footprint::Polygon(polygon) => polygon.corners().to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Object;

    /// A bar of 26 cm and a can, of which the bar must stay within 5 mm.
    fn scene() -> Scene {
        let bar = Object::cuboid("bar", [0.03, 0.26, 0.07]).at(0.5, 0.0, 0.0);
        let bar = Object { keep: Some(0.005), ..bar };
        Scene::new([bar, Object::cylinder("can", 0.03, 0.08).at(0.3, 0.0, 0.0)])
    }

    fn moved(scene: &Scene, object: usize, to: Pose) -> State {
        let mut state = scene.start();
        state.poses[object] = to;
        state
    }

    #[test]
    fn a_kept_object_may_neither_turn_nor_go_away_and_come_back() {
        let scene = scene();
        let rules = ObjectRules::of(&scene);
        let turned = |angle: f64| rules.broken(&moved(&scene, 0, Pose::new(0.5, 0.0, angle)));
        // A corner is 131 mm from the centre: 2 degrees move it by 4.6 mm and 3 by 6.9 mm.
        assert_eq!(turned(2f64.to_radians()), None);
        let Some(Warning::NotKept { object, moved: by, .. }) = turned(3f64.to_radians()) else {
            panic!("the corner moved too far")
        };
        assert!(object == "bar" && (by - 6.85e-3).abs() < 1e-4, "{by}");
        assert!(turned(88f64.to_radians()).is_some());
        let away = moved(&scene, 0, Pose::new(0.55, 0.0, 0.0));
        assert!(rules.first_broken([&scene.start(), &away, &scene.start()]).is_some());
        assert_eq!(rules.first_broken([&scene.start(), &moved(&scene, 1, Pose::default())]), None);
    }

    #[test]
    fn displacement_counts_from_the_first_pose_and_beyond_the_error_of_the_observation() {
        let scene = scene();
        // Two moves of 4 mm are 8 mm.
        let once = scene.moved_to(&moved(&scene, 0, Pose::new(0.504, 0.0, 0.0)));
        assert_eq!(ObjectRules::of(&once).broken(&once.start()), None);
        let twice = moved(&once, 0, Pose::new(0.508, 0.0, 0.0));
        assert!(ObjectRules::of(&once).broken(&twice).is_some());
        assert_eq!(ObjectRules::of(&once).starting(&twice).broken(&twice), None);
        let blurred = |error: f64| ObjectRules::of(&once).observed(vec![[error, 0.0]; 2]);
        assert!(blurred(0.007).broken(&twice).is_some());
        assert_eq!(blurred(0.009).broken(&twice), None);
    }

    #[test]
    fn solids_fixed_on_a_round_hub_are_corners_too() {
        let hub = Object { keep: Some(0.005), ..Object::cylinder("hub", 0.02, 0.1) };
        let arm = Object::cuboid("hub/arm", [0.2, 0.02, 0.1]);
        let scene = Scene::new([hub]).with_part(0, arm, Pose::new(0.1, 0.0, 0.0));
        let mut state = scene.start();
        state.poses[0].heading = 0.1;
        assert!(ObjectRules::of(&scene).broken(&state).is_some());
        let alone = scene.only(&[0]);
        let mut state = alone.start();
        state.poses[0].heading = 0.1;
        assert_eq!(ObjectRules::of(&alone).broken(&state), None);
    }
}
