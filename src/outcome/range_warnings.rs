//! Warnings about rollouts outside the validity ranges of a model.

use crate::geometry::{Shape, Vector, centroid};
use crate::scene::{
    GRAVITY, Quantity, Ranges, Scene, Span, TRAINED_IMBALANCE, TRAINED_SLANT, slant,
};
use crate::task::{Job, Stroke};

use super::Warning;

impl Ranges {
    /// Returns a warning for every quantity of the job that lies outside the ranges. Masses and
    /// frictions are taken from the job's physics.
    ///
    /// Travel and the number of pushes are not checked, because the model predicts frame by frame
    /// and their number does not change its inputs.
    pub fn warnings(&self, scene: &Scene, job: &Job) -> Vec<Warning> {
        let all: Vec<usize> = (0..scene.objects.len()).collect();
        self.warnings_among(scene, job, &all)
    }

    /// Returns the [`Ranges::warnings`] that concern these objects only, given by ascending
    /// indices.
    pub fn warnings_among(&self, scene: &Scene, job: &Job, objects: &[usize]) -> Vec<Warning> {
        let Job { motion, physics, .. } = job;
        let mut found = Vec::new();
        let mut check = |of: &dyn Fn() -> String, quantity: Quantity, value: f64, span: Span| {
            if !span.contains(value) {
                // Files cannot hold infinite numbers.
                let (of, value) = (of(), value.min(f64::MAX));
                let Span { low, high } = span;
                let own = Warning::OutsideRange { of, quantity, value, low, high };
                match found.iter_mut().find(|known: &&mut Warning| known.is_of_body_of(&own)) {
                    Some(known) if own.excess() > known.excess() => *known = own,
                    Some(_) => {}
                    None => found.push(own),
                }
            }
        };
        let (whole, push) = (|| "scene".to_owned(), || "push".to_owned());
        // A compound object has one mass and counts once.
        let things: Vec<usize> =
            objects.iter().copied().filter(|&k| !scene.objects[k].is_part()).collect();
        if !things.is_empty() {
            check(&whole, Quantity::Objects, things.len() as f64, self.objects);
        }
        check(&|| "table".to_owned(), Quantity::Friction, physics.table_friction, self.friction);
        for &index in objects {
            let name = || scene.thing_name(index).to_owned();
            if !scene.objects[index].is_part() {
                check(&name, Quantity::Mass, scene.mass_in(physics, index), self.mass);
            }
            check(&name, Quantity::Friction, physics.frictions[index], self.friction);
            let shape = &scene.objects[index].shape;
            check(&name, Quantity::Height, shape.height(), self.height);
            match *shape {
                Shape::Cylinder { radius, .. } => {
                    check(&name, Quantity::Radius, radius, self.radius);
                }
                Shape::Cuboid { size: [x, y, _] } => {
                    check(&name, Quantity::SizeX, x, self.side);
                    check(&name, Quantity::SizeY, y, self.side);
                    let aspect = x.max(y) / x.min(y);
                    check(&name, Quantity::SideRatio, aspect, Span::new(1.0, self.aspect));
                }
                Shape::Prism { base, .. } => {
                    check(&name, Quantity::Slant, slant(&base), Span::new(0.0, TRAINED_SLANT));
                    let off = centroid(base.corners()).norm();
                    check(&name, Quantity::Imbalance, off, Span::new(0.0, TRAINED_IMBALANCE));
                    let across = |axis: Vector| base.extent(axis) + base.extent(-axis);
                    let [x, y] = [Vector::x(), Vector::y()].map(across);
                    check(&name, Quantity::SizeX, x, self.side);
                    check(&name, Quantity::SizeY, y, self.side);
                    let aspect = x.max(y) / x.min(y);
                    check(&name, Quantity::SideRatio, aspect, Span::new(1.0, self.aspect));
                }
            }
        }
        for pair in physics.pairs.iter().filter(|pair| objects.contains(&pair.object)) {
            let of = || format!("a pair of {}", scene.thing_name(pair.object));
            check(&of, Quantity::Friction, pair.coefficient, self.friction);
        }
        let masses = things.iter().map(|&thing| scene.mass_in(physics, thing));
        let heaviest = masses.clone().fold(0.0, f64::max);
        let lightest = masses.fold(f64::INFINITY, f64::min);
        if lightest > 0.0 && lightest.is_finite() {
            let ratio = heaviest / lightest;
            check(&whole, Quantity::MassRatio, ratio, Span::new(1.0, self.mass_ratio));
        }
        let tool = &motion.slide().tool;
        let name = || tool.name.clone();
        check(&name, Quantity::Friction, tool.friction, self.friction);
        check(&name, Quantity::Parts, tool.parts().len() as f64, self.parts);
        for part in tool.parts() {
            let of = || format!("{}/{}", tool.name, part.name);
            match part.shape {
                Shape::Cuboid { size: [x, y, _] } => {
                    check(&of, Quantity::Length, x.max(y), self.part_length);
                    check(&of, Quantity::Width, x.min(y), self.part_width);
                }
                Shape::Cylinder { radius, .. } => {
                    check(&of, Quantity::Radius, radius, self.part_radius);
                }
                Shape::Prism { base, .. } => {
                    check(&of, Quantity::Slant, slant(&base), Span::new(0.0, TRAINED_SLANT));
                    let across = |axis: Vector| base.extent(axis) + base.extent(-axis);
                    let [x, y] = [Vector::x(), Vector::y()].map(across);
                    check(&of, Quantity::Length, x.max(y), self.part_length);
                    check(&of, Quantity::Width, x.min(y), self.part_width);
                }
            }
        }
        let moving = || motion.slide().strokes.iter().filter(|stroke| stroke.duration > 0.0);
        let speed = |stroke: &Stroke| stroke.travel() / stroke.duration;
        if let Some(speed) = moving().map(speed).find(|speed| !self.speed.contains(*speed)) {
            check(&push, Quantity::Speed, speed, self.speed);
        }
        let fastest = moving().map(speed).fold(0.0, f64::max);
        let smoothest = objects.iter().map(|&index| physics.support_friction(index));
        let smoothest = smoothest.fold(f64::INFINITY, f64::min);
        if fastest > 0.0 {
            let slide = fastest * fastest / (2.0 * smoothest * GRAVITY);
            check(&push, Quantity::Slide, slide, Span::new(0.0, self.slide));
        }
        let turn = motion.slide().strokes.iter().map(turn_per_travel).fold(0.0, f64::max);
        check(&push, Quantity::Turn, turn, Span::new(0.0, self.turn));
        found
    }
}

/// Returns the rotation per distance travelled, radians per metre: infinite for a rotation on the
/// spot.
fn turn_per_travel(stroke: &Stroke) -> f64 {
    let turn = (stroke.to.heading - stroke.from.heading).abs();
    if turn > 0.0 { turn / stroke.travel() } else { 0.0 }
}
