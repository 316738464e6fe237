//! Parametric tools: cuboids that a search can sample and vary.

use std::f64::consts::FRAC_PI_2;

use rand::Rng;

use pushplan::geometry::{Pose, Vector};
use pushplan::scene::{Part, Tool};

use super::form::{Form, Head};

/// Number of parameters of sizes and positions.
pub(super) const NUMBERS: usize = 16;

/// Height of the parts, metres: equal for all shipped tools.
pub(super) const HEIGHT: f64 = 0.05;

/// Range of the lengths of handle links, metres. The upper bound is the largest length in the
/// training data of the shipped networks.
const LINKS: [f64; 2] = [0.03, 0.5];

/// Range of the lengths of other bars, metres.
const BARS: [f64; 2] = [0.02, 0.5];

/// Range of widths, metres: thinner bars would bend, and wider ones are rare among shipped tools.
const WIDTHS: [f64; 2] = [0.01, 0.08];

/// Maximum rotation of a handle against the hand, degrees.
const TURN: f64 = 180.0;

/// Maximum rotation of a link against the one before, degrees.
const BEND: f64 = 135.0;

/// Maximum rotation of a bar from straight across the handle, degrees.
const SLANT: f64 = 60.0;

/// Thresholds of parameters around a middle: smaller magnitudes than the first map to the middle,
/// larger ones than the second to an end.
const MIDDLE: f64 = 0.4;
const END: f64 = 0.85;

/// A form with all its parameters, each from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Assembly {
    pub form: Form,
    pub numbers: [f64; NUMBERS],
}

/// A polyline handle, with an optional bar at its end.
pub(super) struct Route {
    /// Grip, bends and end of the handle in the end effector's frame, metres.
    pub points: Vec<Vector>,
    /// Width of the handle, metres.
    pub width: f64,
    /// Bar across the end.
    pub bar: Option<Bar>,
}

/// Bar across the end of a handle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bar {
    /// Length, metres.
    pub length: f64,
    /// Direction, radians.
    pub heading: f64,
    /// Offset of its middle from the end of the handle along the bar, metres.
    pub aside: f64,
}

impl Assembly {
    /// Returns the assembly that approximates a route; `None` if the number of links is not
    /// supported.
    pub fn along(route: &Route) -> Option<Self> {
        let ways: Vec<Vector> = route.points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let links = ways.len();
        if !(1..=Form::LINKS).contains(&links) {
            return None;
        }
        let heading = |way: &Vector| way.y.atan2(way.x).to_degrees();
        let mut numbers = [0.5; NUMBERS];
        numbers[0] = log_number(WIDTHS, route.width);
        numbers[1] = number_around(wrap(heading(&ways[0])) / TURN);
        for (k, way) in ways.iter().enumerate() {
            numbers[2 + k] = even_number(LINKS, way.norm());
            if k > 0 {
                numbers[4 + k] = number_around(wrap(heading(way) - heading(&ways[k - 1])) / BEND);
            }
        }
        let mut head = Head::Plain;
        if let Some(Bar { length, heading: across, aside }) = route.bar {
            let slant = wrap(across.to_degrees() - heading(ways.last()?) - 90.0);
            // A bar is symmetric under half a turn.
            let turned = slant.abs() > 90.0;
            let slant = if turned { wrap(slant + 180.0) } else { slant };
            let aside = if turned { -aside } else { aside };
            head = Head::Bar;
            let most = (length - length.min(route.width)) / 2.0;
            numbers[10] = number_around(if most > 0.0 { aside / most } else { 0.0 });
            numbers[7] = log_number(BARS, length);
            numbers[8] = log_number(WIDTHS, route.width);
            numbers[9] = 1.0;
            numbers[11] = number_around(slant / SLANT);
        }
        Some(Self { form: Form { links, head }, numbers })
    }

    /// Returns a copy with some parameters varied by up to `spread`.
    pub fn varied(&self, random: &mut impl Rng, spread: f64) -> Self {
        let mut numbers = self.numbers;
        let one = random.random_range(0..NUMBERS);
        for (k, number) in numbers.iter_mut().enumerate() {
            let by = random.random::<f64>() - random.random::<f64>();
            if k == one || random.random_bool(0.4) {
                *number = (*number + spread * by).clamp(0.0, 1.0);
            }
        }
        Self { numbers, ..self.clone() }
    }

    /// Returns the distance to another assembly of this form: the largest difference of their
    /// parameters.
    pub fn distance(&self, other: &Self) -> f64 {
        let pairs = self.numbers.iter().zip(&other.numbers);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// Returns a name that describes the form.
    pub fn name(&self) -> &'static str {
        let bends = (1..self.form.links).filter(|k| around(self.numbers[4 + k]) != 0.0);
        match (self.form.head, bends.count()) {
            (Head::Plain, 0) => "bar",
            (Head::Plain, 1) | (Head::Bar, _) => "hook",
            (Head::Plain, _) => "crank",
            (Head::Catch, _) => "catch",
            (Head::Bars, _) => "double-hook",
            (Head::Fork, _) => "fork",
            (Head::Ring, _) => "ring",
        }
    }

    /// Builds the tool, held at the near end of its handle. Returns `None` if rounding separated
    /// its parts.
    pub fn tool(&self, name: &str) -> Option<Tool> {
        let [wide, turn, ..] = self.numbers;
        let width = log(WIDTHS, wide);
        let bend = |k: usize| match k {
            0 => 0.0,
            k if k < self.form.links => degrees(BEND * around(self.numbers[4 + k])),
            _ => 0.0,
        };
        let mut parts = Vec::new();
        let mut shaft = Shaft { from: Pose::default(), length: 0.0, width };
        for k in 0..self.form.links {
            let from = shaft.from * Pose::new(shaft.length, 0.0, bend(k));
            let length = millimetres(even(LINKS, self.numbers[2 + k]));
            shaft = Shaft { from, length, width };
            // Links overlap at a corner, as far as their length allows. The overlap is a whole
            // number of millimetres because flush parts would not touch otherwise.
            let corner = millimetres(width / 2.0);
            let over = |k, spare: f64| if bend(k) == 0.0 { 0.0 } else { spare.min(corner) };
            let before = over(k, LINKS[1] - length);
            let after = over(k + 1, LINKS[1] - length - before);
            let (whole, middle) = (before + length + after, (length + after - before) / 2.0);
            let name = match self.form.links {
                1 => "handle".to_owned(),
                _ => format!("handle-{}", k + 1),
            };
            parts.push(part(&name, [whole, width], from * Pose::new(middle, 0.0, 0.0)));
        }
        self.add_head(&shaft, &mut parts);
        let grip = Pose::new(0.0, 0.0, degrees(-TURN * around(turn)) + 0.0);
        Some(Tool::new(name, parts).ok()?.held_at(grip))
    }

    fn add_head(&self, shaft: &Shaft, parts: &mut Vec<Part>) {
        let [.., long, wide, place, shift, slant, more, thick, second, back] = self.numbers;
        let (length, width) = (log(BARS, long), log(WIDTHS, wide));
        let slant = FRAC_PI_2 + degrees(SLANT * around(slant));
        let shift = around(shift);
        let across = |place: f64, shift: f64| {
            let place = (place / END).min(1.0);
            let along = width / 2.0 + place * (shaft.length - width).max(0.0);
            let along = along.min(shaft.length);
            let aside = shift * (length - length.min(shaft.width)) / 2.0;
            shaft.from * Pose::new(along, 0.0, slant) * Pose::new(aside, 0.0, 0.0)
        };
        let bar = across(place, shift);
        if self.form.head == Head::Plain {
            return;
        }
        parts.push(part("bar", [length, width], bar));
        let (reach, thick) = (log(BARS, more), log(WIDTHS, thick));
        // The left side of a bar that points left faces the grip.
        let ways = if back < 0.5 { 1.0 } else { -1.0 };
        let tip = |side: f64| {
            let out = side * (length - length.min(thick)) / 2.0;
            let on = ways * (reach - reach.min(width)) / 2.0;
            part(name_of_tip(self.form, side), [reach, thick], bar * Pose::new(out, on, FRAC_PI_2))
        };
        match self.form.head {
            Head::Plain | Head::Bar => {}
            Head::Catch => parts.push(tip(if shift < 0.0 { -1.0 } else { 1.0 })),
            Head::Bars => {
                parts.push(part("second-bar", [length, width], across(second, signed(more))));
            }
            Head::Fork | Head::Ring => {
                parts.extend([tip(1.0), tip(-1.0)]);
                if self.form.head == Head::Ring {
                    let on = ways * (reach - reach.min(width));
                    parts.push(part("end", [length, width], bar * Pose::new(0.0, on, 0.0)));
                }
            }
        }
    }
}

/// Last link of a handle: its start pose and size.
struct Shaft {
    from: Pose,
    length: f64,
    width: f64,
}

fn name_of_tip(form: Form, side: f64) -> &'static str {
    match (form.head, side > 0.0) {
        (Head::Catch, _) => "tip",
        (_, true) => "tine-left",
        (_, false) => "tine-right",
    }
}

/// Builds a cuboid with sizes in whole millimetres and degrees, for readable files. Its position is
/// precise enough for flush parts to touch.
fn part(name: &str, [length, width]: [f64; 2], at: Pose) -> Part {
    let place = at.position.map(|metres| (1e5 * metres).round() / 1e5);
    let at = Pose { position: place, heading: degrees(wrap(at.heading.to_degrees())) + 0.0 };
    Part::cuboid(name, [millimetres(length), millimetres(width), HEIGHT], at)
}

fn millimetres(metres: f64) -> f64 {
    (1e3 * metres).round() / 1e3
}

/// Rounds to whole degrees and converts to radians.
fn degrees(degrees: f64) -> f64 {
    degrees.round().to_radians()
}

fn even([low, high]: [f64; 2], number: f64) -> f64 {
    low + (high - low) * number
}

/// Interpolates logarithmically, so that 1 to 2 cm is as far as 4 to 8 cm.
fn log([low, high]: [f64; 2], number: f64) -> f64 {
    low * (high / low).powf(number)
}

/// Maps a parameter to -1 to 1, with finite probability of the middle and of the ends, because
/// straight, square or flush parts are simple to build.
fn around(number: f64) -> f64 {
    let out = 2.0 * number - 1.0;
    out.signum() * ((out.abs() - MIDDLE) / (END - MIDDLE)).clamp(0.0, 1.0)
}

/// Maps a parameter to -1 to 1.
fn signed(number: f64) -> f64 {
    2.0 * number - 1.0
}

/// Inverse of [`even`].
fn even_number([low, high]: [f64; 2], value: f64) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}

/// Inverse of [`log`].
fn log_number([low, high]: [f64; 2], value: f64) -> f64 {
    ((value / low).ln() / (high / low).ln()).clamp(0.0, 1.0)
}

/// Inverse of [`around`].
fn number_around(value: f64) -> f64 {
    match value.abs().min(1.0) {
        size if size < 1e-3 => 0.5,
        size => (1.0 + value.signum() * (MIDDLE + size * (END - MIDDLE))) / 2.0,
    }
}

/// Wraps an angle to half a turn, degrees.
fn wrap(degrees: f64) -> f64 {
    degrees - 360.0 * (degrees / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::seeded::generator;

    /// A tool separates only if a connection was omitted or rounded away.
    #[test]
    fn every_assembly_is_one_piece_of_its_parts_and_equals_its_file() {
        for (k, form) in Form::up_to(usize::MAX).into_iter().enumerate() {
            for draw in 0..50 {
                let mut random = generator(draw, k as u64);
                let drawn = Assembly { form, numbers: std::array::from_fn(|_| random.random()) };
                for assembly in [drawn.varied(&mut random, 0.3), drawn] {
                    let tool = assembly.tool("tool");
                    let tool = tool.unwrap_or_else(|| panic!("{assembly:?} comes apart"));
                    assert_eq!(tool.parts().len(), form.parts(), "{form:?}");
                    let text = tool.to_yaml().expect("a file");
                    assert_eq!(Tool::parse(&text, "tool.yaml").expect("a tool"), tool);
                }
            }
        }
    }

    #[test]
    fn a_handle_runs_along_its_points() {
        let points = [[0.0, 0.0], [0.2, 0.1], [0.2, 0.3], [0.1, 0.3]];
        let points: Vec<Vector> = points.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
        let bar = Bar { length: 0.08, heading: 1.0, aside: 0.02 };
        let route = Route { points: points.clone(), width: 0.02, bar: Some(bar) };
        let tool = Assembly::along(&route).expect("three links").tool("tool").expect("one piece");
        // The end effector is at the origin.
        let frame = tool.pose(Pose::default());
        let [one, two, three, bar] = [0, 1, 2, 3].map(|k| tool.part_pose(k, &frame));
        for (pose, ends) in [one, two, three].iter().zip(points.windows(2)) {
            let along = Vector::new(pose.heading.cos(), pose.heading.sin());
            let way = (ends[1] - ends[0]).normalize();
            assert!(along.dot(&way) > 0.9998, "{pose:?} along {way}");
        }
        let middle = points[3] + Vector::new(1f64.cos(), 1f64.sin()) * 0.02;
        assert!((bar.position - middle).norm() < 0.015, "{bar:?} about {middle}");
        // A bar is symmetric under half a turn.
        assert!((bar.heading - 1.0).sin().abs() < 0.02);
    }

    #[test]
    fn middle_and_ends_are_met_more_than_by_chance() {
        let met = |number: f64| around(number);
        assert_eq!(
            [0.0, 0.05, 0.4, 0.5, 0.6, 0.95, 1.0].map(met),
            [-1.0, -1.0, 0.0, 0.0, 0.0, 1.0, 1.0]
        );
        assert!(met(0.8) > 0.0 && met(0.8) < 1.0);
    }
}
