//! Propagation of states over fixed joints.
//!
//! The parts of a tool, and obstacles that touch, move as one body. Every part p has an additive
//! state s_p, the [`AreaMoments`] of its area. Over the edges of a spanning tree of the fixed
//! joints, every part sends the sum of its own state and of all received ones:
//!
//! ```text
//! m_pq = s_p + sum of m_rp over the neighbours r of p except q        S_p = s_p + sum of m_qp
//! ```
//!
//! Afterwards every part holds the state of the whole body. The state depends neither on the order
//! of the parts nor on how the body is divided into parts, except for rounding.

use crate::geometry::AreaMoments;
use crate::scene::DisjointSets;

/// Returns the states after propagation over fixed `joints` between bodies with these `own` states.
pub(super) fn propagate(own: &[AreaMoments], joints: &[[usize; 2]]) -> Vec<AreaMoments> {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); own.len()];
    let mut tree = DisjointSets::new(own.len());
    for &[a, b] in joints {
        if tree.join([a, b]) {
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    }
    let mut held = own.to_vec();
    let mut seen = vec![false; own.len()];
    for root in 0..own.len() {
        if seen[root] {
            continue;
        }
        // Order in which every part follows the neighbour from which it is reached.
        let mut order = vec![(root, root)];
        seen[root] = true;
        let mut next = 0;
        while let Some(&(part, _)) = order.get(next) {
            next += 1;
            for &other in &neighbours[part] {
                if !seen[other] {
                    seen[other] = true;
                    order.push((other, part));
                }
            }
        }
        // Inwards, a part passes on everything behind it; outwards, it receives the rest.
        for &(part, to) in order[1..].iter().rev() {
            held[to] = held[to] + held[part];
        }
        for &(part, from) in &order[1..] {
            held[part] = held[from];
        }
    }
    held
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    fn state(area: f64) -> AreaMoments {
        AreaMoments { area, first: Vector::new(area, -area), second: [area; 3] }
    }

    #[test]
    fn every_part_holds_the_sum_of_its_body() {
        let own = [1.0, 2.0, 4.0, 8.0, 16.0].map(state);
        // A ring of three parts, a pair and no connection between them.
        let held = propagate(&own, &[[0, 3], [3, 1], [1, 0], [4, 2]]);
        let areas: Vec<f64> = held.iter().map(|state| state.area).collect();
        assert_eq!(areas, [11.0, 11.0, 20.0, 11.0, 20.0]);
        assert_eq!(propagate(&own, &[]), own);
    }
}
