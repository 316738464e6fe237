//! A goal in words, as marks for pictures, and as a check for exported scenes.

use crate::scene::Scene;

use super::Goal;
use super::demand::{Check, Demand, ShownGoal};

impl Goal {
    /// Names of the objects that may be moved for it.
    pub fn names(&self, scene: &Scene) -> String {
        let movers = self.movers().into_iter();
        let names = movers.filter_map(|k| scene.objects.get(k)).map(|object| object.name.as_str());
        names.collect::<Vec<_>>().join(", ")
    }

    /// Its objects and its demands in words.
    pub fn line(&self, scene: &Scene) -> String {
        let names = self.names(scene);
        let names = if names.is_empty() { "object" } else { &names };
        let colon = if self.is_pose() { "" } else { ":" };
        format!("{names}{colon} {}", self.words(scene))
    }

    /// Its demands in words, without the name of its object.
    pub fn words(&self, scene: &Scene) -> String {
        let (poses, others): (Vec<&Demand>, Vec<&Demand>) =
            self.demands.iter().partition(|demand| demand.is_pose());
        let mut frames: Vec<usize> = Vec::new();
        let mut phrase = |demand: &Demand| {
            let other = demand.kind().relative().filter(|other| !frames.contains(other));
            frames.extend(other);
            let of = other.and_then(|other| scene.objects.get(other));
            let of = of.map_or(String::new(), |other| format!(" as {} sees it", other.name));
            format!("{}{of}", demand.kind().words(self.object, scene))
        };
        others.into_iter().chain(poses).map(&mut phrase).collect::<Vec<_>>().join(", ")
    }

    /// The check by which exported scenes are judged.
    pub fn check(&self, scene: &Scene) -> Check {
        let of = self.demands.iter().map(|demand| demand.kind().check(self.object, scene));
        let of: Vec<Check> = of.collect();
        Check::AtLeast { count: of.len(), of }
    }

    /// Its marks in pictures, with everything at its start.
    pub fn shown(&self, scene: &Scene) -> ShownGoal {
        let start = scene.start();
        let goal = self.in_world(&start);
        let own = || start.poses.get(self.object).map(|pose| pose.position);
        let marks = goal.demands.iter().flat_map(|one| one.kind().marks(self.object, scene));
        let centre = goal.position().or_else(own).unwrap_or_default();
        ShownGoal { objects: self.movers(), centre, marks: marks.collect() }
    }
}
