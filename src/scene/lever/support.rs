//! What a plate tips over when it is levered somewhere.

use crate::geometry::{SupportEdge, Vector, support_edge};

use super::{Place, Plate};

impl Plate {
    /// A place on its outline, plate frame, metres.
    pub fn point(&self, place: Place) -> Vector {
        let corners = self.corners();
        let from = corners[place.edge];
        from + (corners[(place.edge + 1) % corners.len()] - from) * place.fraction
    }

    /// The side of its outline that it tips over when it is levered at `place`; none if the
    /// outline has no area. The frame lies below the centre of mass, so that is at its origin.
    pub fn support(&self, place: Place) -> Option<SupportEdge> {
        support_edge(self.corners(), self.point(place), Vector::zeros())
    }

    /// The distance of the support's line from `place`, metres: with the blade's axis there,
    /// [`LeverUp::pivot`](super::LeverUp::pivot), blade and edge rise on arcs of one radius, so
    /// the plate hardly slides on the blade and tilts by the angle that the blade turns.
    pub fn auto_pivot(&self, place: Place) -> Option<f64> {
        self.support(place).map(|support| support.distance).filter(|distance| *distance > 0.0)
    }
}
