//! Mass distribution of a plate: its solids have one density, and its feet are massless.

use crate::geometry::{Vector, Vector3, cross};

use super::{Plate, Slab};

/// Relative difference of densities below which they count as equal.
const EVEN: f64 = 1e-9;

/// Mass of a body and its distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weight {
    /// Mass, kilograms.
    pub mass: f64,
    /// Centre of mass in the plate's frame, metres.
    pub centre: Vector3,
    /// Inertia about the centre of mass on the plate's axes, kg m^2: `xx, yy, zz, xy, xz, yz`. The
    /// last three have the sign of the matrix entries (`-m x y`).
    pub inertia: [f64; 6],
}

impl Slab {
    /// Returns the volume, cubic metres.
    pub fn volume(&self) -> f64 {
        moments(&self.corners).0 * self.height
    }

    /// Returns the centroid in the plate frame, metres.
    pub fn centre(&self) -> Vector3 {
        let (_, centre, _) = moments(&self.corners);
        Vector3::new(centre.x, centre.y, self.bottom + 0.5 * self.height)
    }
}

impl Plate {
    /// Returns the distribution of its mass when all solids have one density.
    pub fn weight(&self) -> Weight {
        let volume: f64 = self.slabs.iter().map(Slab::volume).sum();
        let density = self.mass / volume;
        let share = |slab: &Slab| slab.volume() / volume;
        let shares: Vec<f64> = self.slabs.iter().map(share).collect();
        let masses: Vec<f64> = self.slabs.iter().map(|slab| density * slab.volume()).collect();
        self.weighing(self.mass, &shares, &masses)
    }

    /// Returns the mass distribution for these masses of the solids, kg. Masses proportional to the
    /// volumes give exactly [`Plate::weight`].
    pub fn weight_of(&self, masses: &[f64]) -> Weight {
        let (mass, volume) =
            (masses.iter().sum::<f64>(), self.slabs.iter().map(Slab::volume).sum::<f64>());
        let even = |(slab, own): (&Slab, &f64)| {
            (own * volume - mass * slab.volume()).abs() <= EVEN * mass * volume
        };
        if self.slabs.iter().zip(masses).all(even) {
            return self.weight();
        }
        let shares: Vec<f64> = masses.iter().map(|own| own / mass).collect();
        self.weighing(mass, &shares, masses)
    }

    fn weighing(&self, mass: f64, shares: &[f64], masses: &[f64]) -> Weight {
        let weighted = |(slab, share): (&Slab, &f64)| slab.centre() * *share;
        let centre: Vector3 = self.slabs.iter().zip(shares).map(weighted).sum();
        let mut inertia = [0.0; 6];
        for (slab, mass) in self.slabs.iter().zip(masses) {
            let (area, _, [xx, xy, yy]) = moments(&slab.corners);
            let away = slab.centre() - centre;
            // Mean squares about the slab's own centroid, then about the plate's.
            let x = xx / area + away.x * away.x;
            let y = yy / area + away.y * away.y;
            let z = slab.height * slab.height / 12.0 + away.z * away.z;
            let product = xy / area + away.x * away.y;
            let own = [y + z, x + z, x + y, -product, -away.x * away.z, -away.y * away.z];
            inertia.iter_mut().zip(own).for_each(|(sum, own)| *sum += mass * own);
        }
        Weight { mass, centre, inertia }
    }

    /// Moves the frame below the centre of mass of the solids; the body itself stays. Used to
    /// create plates from outlines drawn about any origin.
    #[must_use]
    pub fn balanced(self) -> Self {
        let centre = self.weight().centre;
        self.shifted(Vector::new(centre.x, centre.y))
    }

    /// Moves the frame to a point of the plate, metres; the body itself stays.
    #[must_use]
    pub fn shifted(mut self, to: Vector) -> Self {
        for slab in &mut self.slabs {
            slab.corners.iter_mut().for_each(|corner| *corner -= to);
        }
        self.pose.position = self.pose.point(to);
        self
    }
}

/// Returns area (m^2), centroid (m) and second moments `xx, xy, yy` about it (m^4) of a polygon
/// whose corners run counter-clockwise. The sums run over the triangles between its sides and the
/// first corner.
fn moments(corners: &[Vector]) -> (f64, Vector, [f64; 3]) {
    let origin = corners[0];
    let (mut area, mut first, mut second) = (0.0, Vector::zeros(), [0.0; 3]);
    for pair in corners[1..].windows(2) {
        let (a, b) = (pair[0] - origin, pair[1] - origin);
        let own = 0.5 * cross(a, b);
        area += own;
        first += (a + b) * (own / 3.0);
        second[0] += own / 6.0 * (a.x * a.x + a.x * b.x + b.x * b.x);
        second[1] += own / 12.0 * (2.0 * a.x * a.y + a.x * b.y + b.x * a.y + 2.0 * b.x * b.y);
        second[2] += own / 6.0 * (a.y * a.y + a.y * b.y + b.y * b.y);
    }
    let centre = first / area;
    second[0] -= area * centre.x * centre.x;
    second[1] -= area * centre.x * centre.y;
    second[2] -= area * centre.y * centre.y;
    (area, origin + centre, second)
}

#[cfg(test)]
mod tests;
