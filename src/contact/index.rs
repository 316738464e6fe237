//! Numberings: the same object has a number in its scene, one on the list of what matters now and
//! one among those awake in a frame.
//!
//! Inside this module a bare `usize` is a number in the [`super::Bodies`] at hand; where two
//! numberings meet, these types keep them apart.

/// A number that an object has in one numbering.
pub trait Index: Copy + Eq {
    /// The object in this place.
    fn at(place: usize) -> Self;

    /// Its place.
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
    /// Among the objects of the scene.
    SceneIndex;
    /// Among the objects that a rollout looks at now, or all of them where it looks at everything.
    ListIndex;
    /// Among the objects that a frame's equations are about.
    AwakeIndex;
    /// Among the rigid groups of the bodies at hand.
    GroupIndex;
}
