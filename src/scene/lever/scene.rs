//! 3-D scenes, for levering.

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Pose3, Solid, Vector3};
use crate::scene::{Obstacle, Region, Scene, State, Tool, Velocity};

use super::Plate;
use super::plate::outline;

/// The flat end of a tool that goes under an edge: a cuboid from its tip backwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Blade {
    /// Length along the shaft, metres.
    pub length: f64,
    /// Width along the edge, metres.
    pub width: f64,
    /// Thickness, metres; must fit below the edge.
    pub thickness: f64,
    /// Friction value.
    pub friction: f64,
}

impl Blade {
    /// Reach of the fingers beyond the shaft on both sides and along it, metres.
    const FINGERS: f64 = 0.02;

    /// Returns the space of the blade with its centre at `pose`, and on its way when it is drawn
    /// back along its shaft by `back` metres.
    pub fn swept(&self, pose: &Pose3, back: f64) -> Solid {
        let middle = drawn_back(pose, 0.5 * back);
        Solid::cuboid([self.length + back, self.width, self.thickness], &middle)
    }

    /// Returns the space that any hand needs to hold the shaft behind the blade, whose centre is at
    /// `pose`, and on its way when the blade is drawn back by `back` metres: fingers on both sides,
    /// no higher than the shaft. The wrist is left out, because it may come from above or from
    /// behind.
    pub fn fingers(&self, pose: &Pose3, back: f64) -> Solid {
        let held = drawn_back(pose, 0.5 * self.length + Self::FINGERS + 0.5 * back);
        let wide = 2.0 * Self::FINGERS;
        Solid::cuboid([wide + back, wide, self.thickness], &held)
    }
}

/// Returns a pose moved back along its x axis, metres.
fn drawn_back(pose: &Pose3, back: f64) -> Pose3 {
    Pose3 { position: pose.position - pose.rotation * Vector3::x() * back, ..*pose }
}

impl Scene {
    /// Returns the objects, each with all its solids as one body.
    pub fn plates(&self) -> impl Iterator<Item = Plate> {
        self.things().map(|(index, _)| Plate::of(self, index))
    }

    /// Returns the state at rest in which the objects are at `poses`, and all their parts at the
    /// poses that follow.
    pub fn resting_in_space(&self, poses: Vec<Pose3>) -> State {
        let parts = self.objects.iter().skip(poses.len());
        let parts = parts.map_while(|part| {
            let whole = part.whole?;
            Some((*poses.get(whole.object)? * Pose3::upright(whole.place, part.z)).from_above())
        });
        let parts: Vec<Pose> = parts.collect();
        let mut state = State::in_space(poses);
        state.velocities.extend(parts.iter().map(|_| Velocity::default()));
        state.poses.extend(parts);
        state
    }

    /// Returns the number of edges of object `index` under which a blade can go; 0 for a part and
    /// for an index out of range.
    pub fn edges(&self, index: usize) -> usize {
        let is_there = self.objects.get(index).is_some_and(|object| !object.is_part());
        if is_there { Plate::of(self, index).corners().len() } else { 0 }
    }

    /// Creates the scene of these bodies; `None` if one of them cannot be an object, see
    /// [`Plate::solids_of_object`].
    pub fn of_plates(plates: impl IntoIterator<Item = Plate>) -> Option<Self> {
        let objects =
            plates.into_iter().map(Plate::solids_of_object).collect::<Option<Vec<_>>>()?;
        let scene = Self::new(objects.iter().map(|(object, _)| object.clone()));
        let parts = objects.into_iter().enumerate();
        let parts = parts.flat_map(|(k, (_, parts))| parts.into_iter().map(move |part| (k, part)));
        Some(parts.fold(scene, |scene, (k, (part, place))| scene.with_part(k, part, place)))
    }
}

impl Region {
    /// Heights between which a region extends, metres: more than any robot reaches.
    const SPAN: [f64; 2] = [-1.0, 10.0];

    /// Returns the space above and below the region, which 3-D bodies must not enter.
    pub fn column(&self) -> Solid {
        Solid::prism(&outline(&self.shape), Self::SPAN, &Pose3::upright(self.pose, 0.0))
    }

    /// Returns `true` if a 3-D body reaches into the region.
    pub fn holds_in_space(&self, solids: &[Solid]) -> bool {
        let column = self.column();
        solids.iter().any(|solid| solid.depth(&column) > Self::SLACK)
    }
}

/// Objects with all their solids, the obstacles around them, and the blade.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeverScene {
    /// Bodies that can move; a lever names one of them.
    pub plates: Vec<Plate>,
    /// Bodies that cannot move.
    pub blocks: Vec<Obstacle>,
    /// Friction value of the table.
    pub table_friction: f64,
    /// The lever.
    pub blade: Blade,
}

impl LeverScene {
    /// Creates the scene with a tool's blade; a tool without a blade gets an empty one.
    pub fn with(scene: &Scene, tool: &Tool) -> Self {
        Self::new(scene, tool.blade().unwrap_or_default())
    }

    /// Creates the scene with this blade.
    pub fn new(scene: &Scene, blade: Blade) -> Self {
        Self {
            plates: scene.plates().collect(),
            blocks: scene.obstacles.clone(),
            table_friction: scene.table_friction,
            blade,
        }
    }
}
