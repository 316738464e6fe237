//! Disjoint sets of numbers connected by pairs.

/// Disjoint sets, each named by its lowest member. Joining towards the lower root keeps that name
/// in any order of the pairs.
#[derive(Clone, Debug, Default)]
pub struct DisjointSets {
    /// A lower member of the same set, or the number itself if it is the lowest.
    lower: Vec<usize>,
}

impl DisjointSets {
    /// Creates sets of one member each from the numbers below `count`.
    pub fn new(count: usize) -> Self {
        Self { lower: (0..count).collect() }
    }

    /// Creates the sets of the numbers below `count` that `pairs` connect.
    pub fn of(count: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut sets = Self::new(count);
        for pair in pairs {
            sets.join(pair);
        }
        sets
    }

    /// Starts again with the numbers below `count`, on the same memory.
    pub fn reset(&mut self, count: usize) {
        self.lower.clear();
        self.lower.extend(0..count);
    }

    /// Joins the sets of a pair; returns `true` if they were different.
    pub fn join(&mut self, pair: [usize; 2]) -> bool {
        let [a, b] = pair.map(|number| self.lowest(number));
        self.lower[a.max(b)] = a.min(b);
        a != b
    }

    /// Returns the lowest member of the set that contains `number`.
    pub fn lowest(&self, mut number: usize) -> usize {
        while self.lower[number] != number {
            number = self.lower[number];
        }
        number
    }

    /// Returns the lowest member of its set for every number.
    pub fn names(&mut self) -> &[usize] {
        for number in 0..self.lower.len() {
            // All lower numbers already have their names.
            self.lower[number] = self.lower[self.lower[number]];
        }
        &self.lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_named_by_their_lowest_member_in_any_order_of_pairs() {
        let pairs = [[4, 5], [3, 4], [0, 3], [7, 6]];
        for shift in 0..pairs.len() {
            let mut turned = pairs;
            turned.rotate_left(shift);
            let mut sets = DisjointSets::of(8, turned);
            assert_eq!((sets.lowest(5), sets.lowest(7)), (0, 6));
            assert_eq!(sets.names(), [0, 1, 2, 0, 0, 0, 6, 6], "{turned:?}");
        }
    }

    #[test]
    fn a_pair_within_a_set_joins_nothing() {
        let mut sets = DisjointSets::new(3);
        assert!(sets.join([2, 1]) && sets.join([0, 2]));
        assert!(!sets.join([0, 1]));
        sets.reset(3);
        assert_eq!(sets.names(), [0, 1, 2]);
    }
}
