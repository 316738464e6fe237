//! A scene as it stands now, and what is believed about it.

use std::sync::Arc;

use super::{Physics, Scene, State};

/// What planning starts from: planning again from the middle, or under another belief, is the
/// same call with another situation.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// What is on the table.
    pub scene: Arc<Scene>,
    /// Where every object is and how it moves.
    pub start: State,
    /// What is believed about the objects.
    pub physics: Arc<Physics>,
}

impl Situation {
    /// The scene as it is stated, at rest.
    pub fn stated(scene: &Scene) -> Self {
        let physics = Arc::new(Physics::stated(scene));
        Self { start: scene.start(), physics, scene: Arc::new(scene.clone()) }
    }
}
