//! The kinds of tools that are proposed: of how many links the handle is, and what it ends in.

/// End of a handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Head {
    /// Nothing.
    Plain,
    /// A bar across: an L, a T, or anything between, at its end or before.
    Bar,
    /// A bar with a tip at its end, as a J has.
    Catch,
    /// Two bars at different places.
    Bars,
    /// A bar with a tine at either end: a fork, or a rake where they point back.
    Fork,
    /// Ring: a catch closed by a second bar.
    Ring,
}

/// A handle and what it ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Form {
    /// Bars of the handle, each on from the end of the one before: straight on, as none is longer than
    /// half a metre, or around a corner.
    pub links: usize,
    pub head: Head,
}

impl Form {
    /// The most links of a handle.
    pub const LINKS: usize = 3;

    /// Forms of at most `parts` parts, simplest first.
    pub fn up_to(parts: usize) -> Vec<Self> {
        let heads = [Head::Plain, Head::Bar, Head::Catch, Head::Bars, Head::Fork, Head::Ring];
        let all = (1..=Self::LINKS).flat_map(|links| heads.map(|head| Self { links, head }));
        let mut forms: Vec<Self> = all.filter(|form| form.parts() <= parts).collect();
        forms.sort_by_key(|form| form.parts());
        forms
    }

    /// The next simpler one, if there is one.
    pub fn simpler(self) -> Option<Self> {
        let head = match self.head {
            Head::Plain if self.links == 1 => return None,
            Head::Plain => return Some(Self { links: self.links - 1, ..self }),
            Head::Bar => Head::Plain,
            Head::Catch | Head::Bars | Head::Fork => Head::Bar,
            Head::Ring => Head::Fork,
        };
        Some(Self { head, ..self })
    }

    /// Number of parts.
    pub fn parts(self) -> usize {
        let head = match self.head {
            Head::Plain => 0,
            Head::Bar => 1,
            Head::Catch | Head::Bars => 2,
            Head::Fork => 3,
            Head::Ring => 4,
        };
        self.links + head
    }
}
