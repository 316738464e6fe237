//! Index types: an object has an index in its scene, another on the list of relevant bodies and
//! another among the objects awake in a frame.
//!
//! Inside this module a bare `usize` is an index into the [`super::Bodies`] at hand. These types
//! keep the numberings apart where two of them meet.

/// The index of an object in one numbering.
pub trait Index: Copy + Eq {
    /// Creates the index of this position.
    fn at(place: usize) -> Self;

    /// Returns the position.
    fn place(self) -> usize;
}

macro_rules! numberings {
    ($($(#[$meaning:meta])* $name:ident;)*) => {$(
        $(#[$meaning])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub usize);

        impl Index for $name {
            fn at(place: usize) -> Self {
                Self(place)
            }

            fn place(self) -> usize {
                self.0
            }
        }
    )*};
}

numberings! {
    /// Index among the objects of the scene.
    SceneIndex;
    /// Index among the objects listed by a rollout, which are all objects without pruning.
    ListIndex;
    /// Index among the objects in a frame's equations.
    AwakeIndex;
    /// Index among the rigid groups of the bodies at hand.
    GroupIndex;
}
