//! Ordering and checking of the observations of a motion.

use serde::{Deserialize, Serialize};

use pushplan::geometry::Vector;
use pushplan::{
    scene::{FRAME_TRAVEL, ObservedPose, Scene, State},
    task::{Observation, Stroke, Task, ToolMotion},
};

use super::error::ActError;
use super::world::{Look, Stop};

/// Thresholds for swapped objects, metres: each object is more than `APART` from its expected
/// position and less than `THERE` from the other's.
const APART: f64 = 0.04;
const THERE: f64 = 0.02;

/// Maximum displacement of a pushed object: `SWING` times the travel of the tool plus `SLIDE`
/// metres. The object may swing about a joint and slide after the contact ends.
const SWING: f64 = 2.0;
const SLIDE: f64 = 0.10;

/// Correction made to the observations.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Note {
    /// Observations arrived late and were sorted by time.
    OutOfOrder,
    /// Observations from outside the motion were discarded.
    Untimely,
    /// An observed pose with non-finite coordinates was discarded.
    Unreadable {
        /// Index of the object.
        object: usize,
    },
    /// Two objects were confused and swapped back.
    Swapped {
        /// Indices of the objects.
        between: [usize; 2],
    },
    /// An object was observed at an impossible position, which was discarded.
    Jumped {
        /// Index of the object.
        object: usize,
    },
    /// An object was not observed at rest and is assumed to be at its predicted pose.
    Unseen {
        /// Index of the object.
        object: usize,
    },
    /// The push ended early.
    Ended {
        /// Reason.
        why: String,
    },
    /// The first observation of an object differs from the position in the task.
    Elsewhere {
        /// Index of the object.
        object: usize,
    },
    /// An object is where no push can have moved it and was moved from outside.
    Moved {
        /// Index of the object.
        object: usize,
    },
}

impl Note {
    /// Returns the note as text, with the object names of `scene`.
    pub fn words(&self, scene: &Scene) -> String {
        let name = |k: usize| scene.objects.get(k).map_or("?", |object| object.name.as_str());
        match *self {
            Note::OutOfOrder => "observations arrived late and were sorted".to_owned(),
            Note::Untimely => "observations with times outside the push were ignored".to_owned(),
            Note::Unreadable { object } => {
                format!("the observed position of {} is not finite; ignored", name(object))
            }
            Note::Swapped { between: [a, b] } => {
                format!(
                    "the identities of {} and {} were swapped by the tracker; swapped back",
                    name(a),
                    name(b)
                )
            }
            Note::Jumped { object } => {
                format!("{} was observed at an impossible position; ignored", name(object))
            }
            Note::Unseen { object } => {
                format!("{} was not observed at rest; its predicted pose is used", name(object))
            }
            Note::Ended { ref why } => format!("the push ended early: {why}"),
            Note::Elsewhere { object } => format!(
                "the pose of {} differs from the task; its observed pose is used",
                name(object)
            ),
            Note::Moved { object } => format!("{} was moved from outside", name(object)),
        }
    }
}

/// Collects observations in order, with notes on their corrections.
#[derive(Clone, Debug)]
pub(super) struct Gatherer {
    /// Last observed position of every object, otherwise its assumed one.
    last: Vec<Vector>,
    /// Predicted position of every object at rest.
    predicted: Vec<Vector>,
    /// Travel of the tool since the last observation of every object, metres.
    travelled: Vec<f64>,
    pub notes: Vec<Note>,
}

impl Gatherer {
    /// Creates a gatherer for a motion that starts in `before` and is predicted to end in
    /// `predicted`.
    pub fn new(before: &State, predicted: &State) -> Self {
        let places = |state: &State| state.poses.iter().map(|pose| pose.position).collect();
        Self {
            last: places(before),
            predicted: places(predicted),
            travelled: vec![0.0; before.poses.len()],
            notes: Vec::new(),
        }
    }

    /// Returns the observations of a motion that may have ended early, as [`Gatherer::motion`]
    /// does.
    ///
    /// # Errors
    /// Same errors as [`Gatherer::motion`].
    pub fn made(
        &mut self,
        motion: &ToolMotion,
        stop: Option<&Stop>,
        looks: Vec<Look>,
    ) -> Result<(Vec<Observation>, Option<Look>), ActError> {
        let Some(stop) = stop else { return self.motion(motion, looks) };
        self.note(Note::Ended { why: stop.why.clone() });
        let made = stop.made(motion);
        match made.strokes.is_empty() {
            true => Ok((Vec::new(), None)),
            false => self.motion(&made, looks),
        }
    }

    /// Returns the observations during a motion and the one at rest after it, `None` if there is
    /// none.
    ///
    /// # Errors
    /// [`ActError::Objects`] if an observation has another number of objects.
    pub fn motion(
        &mut self,
        motion: &ToolMotion,
        mut looks: Vec<Look>,
    ) -> Result<(Vec<Observation>, Option<Look>), ActError> {
        let whole: f64 = motion.strokes.iter().map(|stroke| stroke.duration).sum();
        let travel: f64 = motion.strokes.iter().map(Stroke::travel).sum();
        let count = looks.len();
        looks.retain(|look| look.time >= 0.0 && look.time.is_finite());
        if looks.len() < count {
            self.note(Note::Untimely);
        }
        if !looks.is_sorted_by(|a, b| a.time <= b.time) {
            looks.sort_by(|a, b| a.time.total_cmp(&b.time));
            self.note(Note::OutOfOrder);
        }
        // About one observation per frame of a model, because closer ones differ by less than the
        // noise.
        let least = 0.8 * whole * FRAME_TRAVEL / travel.max(FRAME_TRAVEL);
        let (mut observations, mut rest, mut done) = (Vec::new(), None, 0.0);
        for look in looks {
            if look.time >= whole - 1e-9 {
                rest = Some(look);
            } else if look.time - done >= least && whole - look.time >= least {
                let strokes = between(motion, done, look.time);
                let gone = strokes.iter().map(Stroke::travel).sum();
                let seen = self.sights(&look, gone)?;
                observations.push(Observation { strokes, seen });
                done = look.time;
            }
        }
        let mut strokes = between(motion, done, whole);
        if let Some(last) = strokes.last_mut() {
            last.settle = true;
        }
        let gone: f64 = strokes.iter().map(Stroke::travel).sum();
        let seen = match &rest {
            Some(look) => self.sights(look, gone)?,
            None => {
                self.travelled.iter_mut().for_each(|travelled| *travelled += gone);
                vec![None; self.last.len()]
            }
        };
        observations.push(Observation { strokes, seen });
        Ok((observations, rest))
    }

    /// Returns the observed poses after `gone` metres of further travel; impossible ones are
    /// `None`.
    ///
    /// # Errors
    /// [`ActError::Objects`] if the observation has another number of objects.
    pub fn sights(
        &mut self,
        look: &Look,
        gone: f64,
    ) -> Result<Vec<Option<ObservedPose>>, ActError> {
        let mut seen = self.readable(look)?;
        self.travelled.iter_mut().for_each(|travelled| *travelled += gone);
        self.change_back(&mut seen);
        for (object, sight) in seen.iter_mut().enumerate() {
            let Some(ObservedPose { position, .. }) = *sight else { continue };
            let most = SWING * self.travelled[object] + SLIDE;
            if (position - self.last[object]).norm() > most {
                *sight = None;
                self.note(Note::Jumped { object });
            } else {
                self.last[object] = position;
                self.travelled[object] = 0.0;
            }
        }
        Ok(seen)
    }

    /// Returns the observed poses; `None` for one with non-finite coordinates.
    fn readable(&mut self, look: &Look) -> Result<Vec<Option<ObservedPose>>, ActError> {
        let (expected, found) = (self.last.len(), look.seen.len());
        if expected != found {
            return Err(ActError::Objects { expected, found });
        }
        let mut seen = look.seen.clone();
        for (object, sight) in seen.iter_mut().enumerate() {
            let is_place = |sight: &ObservedPose| {
                let heading = sight.heading.is_none_or(f64::is_finite);
                heading && sight.position.iter().all(|x| x.is_finite())
            };
            if sight.is_some_and(|sight| !is_place(&sight)) {
                *sight = None;
                self.note(Note::Unreadable { object });
            }
        }
        Ok(seen)
    }

    /// Returns the poses of the first observation. Its names and positions override the ones in
    /// the task.
    ///
    /// # Errors
    /// [`ActError::Objects`] if the observation has another number of objects.
    pub fn first(&mut self, look: &Look) -> Result<Vec<Option<ObservedPose>>, ActError> {
        let seen = self.readable(look)?;
        for (object, sight) in seen.iter().enumerate() {
            if sight.is_some_and(|sight| (sight.position - self.last[object]).norm() > SLIDE) {
                self.note(Note::Elsewhere { object });
            }
        }
        Ok(seen)
    }

    /// Returns two objects that cannot be told apart and are observed in each other's places,
    /// although the task treats them differently.
    pub fn exchanged(&self, task: &Task, seen: &[Option<ObservedPose>]) -> Option<[usize; 2]> {
        let scene = &task.scene;
        let special = |k: usize| {
            let goal = task.goals.iter().position(|goal| goal.movers().contains(&k));
            (goal, scene.objects[k].keep.is_some())
        };
        let alike = |a: usize, b: usize| {
            let [one, other] = [a, b].map(|k| &scene.objects[k]);
            let parts = |k: usize| scene.parts_of(k).map(|part| scene.objects[part].shape);
            one.shape == other.shape && one.color == other.color && parts(a).eq(parts(b))
        };
        let things: Vec<usize> = scene.things().map(|(k, _)| k).collect();
        let pairs = things.iter().flat_map(|&a| things.iter().map(move |&b| [a, b]));
        let mut pairs = pairs.filter(|[a, b]| a < b && special(*a) != special(*b));
        pairs.find(|&[a, b]| {
            let off = |sight: usize, place: usize| {
                let sight = seen.get(sight).copied().flatten();
                sight.map_or(0.0, |sight| (sight.position - self.last[place]).norm())
            };
            let both = [a, b].iter().all(|&k| seen.get(k).is_some_and(Option::is_some));
            let apart = off(a, a).min(off(b, b)) > APART;
            both && alike(a, b) && apart && off(a, b).max(off(b, a)) < THERE
        })
    }

    /// Adds a note unless it is already present.
    pub fn note(&mut self, note: Note) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Swaps back objects that were mistaken for each other.
    fn change_back(&mut self, seen: &mut [Option<ObservedPose>]) {
        for a in 0..seen.len() {
            for b in a + 1..seen.len() {
                let [Some(one), Some(other)] = [seen[a], seen[b]] else { continue };
                let off = |object: usize, sight: ObservedPose| {
                    let from = |place: Vector| (sight.position - place).norm();
                    from(self.last[object]).min(from(self.predicted[object]))
                };
                let apart = off(a, one).min(off(b, other)) > APART;
                if apart && off(a, other).max(off(b, one)) < THERE {
                    seen.swap(a, b);
                    self.note(Note::Swapped { between: [a, b] });
                }
            }
        }
    }
}

/// Returns the strokes of a motion between two times, seconds.
fn between(motion: &ToolMotion, from: f64, to: f64) -> Vec<Stroke> {
    let mut strokes = Vec::new();
    let mut begins = 0.0;
    for stroke in &motion.strokes {
        let ends = begins + stroke.duration;
        let (first, last) = (from.max(begins), to.min(ends));
        if last - first > 1e-9 {
            let share = |time: f64| (time - begins) / stroke.duration;
            strokes.push(Stroke {
                from: stroke.from.towards(&stroke.to, share(first)),
                to: stroke.from.towards(&stroke.to, share(last)),
                duration: last - first,
                settle: false,
            });
        }
        begins = ends;
    }
    strokes
}

#[cfg(test)]
mod tests;
