//! Forms of proposed tools: number of links of the handle, and its end.

/// End of a handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Head {
    /// Plain end.
    Plain,
    /// Bar across, at the end or before: an L, a T, or an intermediate shape.
    Bar,
    /// Bar with a tip at its end, as in a J.
    Catch,
    /// Two bars at different positions.
    Bars,
    /// Bar with a tine at either end: a fork, or a rake if the tines point back.
    Fork,
    /// Ring: a catch closed by a second bar.
    Ring,
}

/// Handle and its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Form {
    /// Number of bars of the handle. Each continues from the end of the one before, straight or
    /// around a corner, because a bar is at most half a metre long.
    pub links: usize,
    pub head: Head,
}

impl Form {
    /// Maximum number of links of a handle.
    pub const LINKS: usize = 3;

    /// Returns the forms of at most `parts` parts, simplest first.
    pub fn up_to(parts: usize) -> Vec<Self> {
        let heads = [Head::Plain, Head::Bar, Head::Catch, Head::Bars, Head::Fork, Head::Ring];
        let all = (1..=Self::LINKS).flat_map(|links| heads.map(|head| Self { links, head }));
        let mut forms: Vec<Self> = all.filter(|form| form.parts() <= parts).collect();
        forms.sort_by_key(|form| form.parts());
        forms
    }

    /// Returns the next simpler form, if there is one.
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

    /// Returns the number of parts.
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
