//! Drives built of cuboids: a floor, walls around a pocket, standoffs, and a board with chips.

use pushplan::internals::geometry::{Pose, Vector};
use pushplan::internals::{
    scene::{LeverScene, Obstacle, Plate, Slab},
    task::{LeverUp, Place},
};
use rand::Rng;
use rand_pcg::Pcg64;

use super::super::distributions::uniform;
use super::plates::{anywhere, lever, screwdriver};

/// Size of a 3.5-inch drive seen from above, metres.
const DRIVE: [f64; 2] = [0.147, 0.1016];

/// Height of the floor's upper surface above the table, metres.
const FLOOR: f64 = 0.020;

/// Thickness of a board, metres.
const BOARD: f64 = 0.0016;

/// Density of a board with its parts, kg/m^3.
const DENSITY: f64 = 1900.0;

/// Side of a standoff, metres.
///
/// Standoffs fill the pocket's corners, because a tilted board could drop into a slot between
/// standoff and wall and stay upright.
const STANDOFF: f64 = 0.006;

/// Minimum distance of the levered place from a corner, metres, beside the standoffs.
const FROM_CORNER: f64 = 0.014;

/// Names of the walls, in the order of the board's edges.
const WALLS: [&str; 4] = ["front", "right", "back", "left"];

/// Parameters shared by drives of one shape.
struct Drive {
    board: [f64; 2],
    chips: Vec<Slab>,
    /// Gap between board and wall, metres.
    gap: f64,
    wall: f64,
    standoff: f64,
    /// Height of the walls above the board's upper surface, metres.
    above: f64,
    /// Width of the notch, metres.
    notch: f64,
    friction: f64,
}

/// Draws a drive and a lever-up through the notch in one of its walls.
pub(super) fn drive(shapes: &mut Pcg64, rng: &mut Pcg64) -> (LeverScene, LeverUp) {
    let drive = Drive::draw(shapes);
    let edge = rng.random_range(0..4);
    let along = drive.board[edge % 2];
    let middle = uniform(rng, FROM_CORNER, along - FROM_CORNER);
    // The blade needs clearance in the notch.
    let play = 0.5 * (drive.notch - 0.009);
    let at = uniform(rng, middle - play, middle + play).clamp(FROM_CORNER, along - FROM_CORNER);
    let pose = anywhere(rng);
    let slack = 0.8 * drive.gap;
    let aside = Vector::new(uniform(rng, -slack, slack), uniform(rng, -slack, slack));
    let scene = LeverScene {
        plates: vec![drive.plate(pose * Pose { position: aside, heading: 0.0 })],
        blocks: drive.blocks(pose, edge, middle),
        table_friction: 0.4,
        blade: screwdriver(uniform(rng, 0.2, 0.5)),
    };
    let place = Place { edge, fraction: at / along };
    let depth = uniform(rng, 0.008, 0.02);
    let lever = if rng.random_range(0..3) == 0 {
        lever(place, depth, -(drive.gap + drive.wall), uniform(rng, 20.0, 40.0))
    } else {
        let across = drive.board[(edge + 1) % 2];
        lever(place, depth, uniform(rng, 0.8, 1.1) * across, uniform(rng, 60.0, 120.0))
    };
    (scene, lever)
}

impl Drive {
    fn draw(rng: &mut Pcg64) -> Self {
        let board = [uniform(rng, 0.060, 0.095), uniform(rng, 0.045, 0.085)];
        let gap = uniform(rng, 0.0008, 0.003);
        let room = |axis: usize| 0.5 * (DRIVE[axis] - board[axis]) - gap;
        let mut this = Self {
            board,
            chips: Vec::new(),
            gap,
            wall: uniform(rng, 0.004, 0.008).min(room(0)).min(room(1)),
            standoff: uniform(rng, 0.004, 0.008),
            above: uniform(rng, 0.0, 0.006),
            notch: uniform(rng, 0.012, 0.024),
            friction: uniform(rng, 0.2, 0.5),
        };
        let wanted = rng.random_range(2..=4);
        while this.chips.len() < wanted {
            let chip = chip(rng, board);
            if !this.chips.iter().any(|other| overlap(&chip, other)) {
                this.chips.push(chip);
            }
        }
        this
    }

    fn plate(&self, pose: Pose) -> Plate {
        let [x, y] = self.board;
        let board = cuboid(Vector::zeros(), [x, y], 0.0, BOARD);
        let slabs: Vec<Slab> = std::iter::once(board).chain(self.chips.iter().cloned()).collect();
        let volume: f64 = slabs.iter().map(Slab::volume).sum();
        Plate {
            name: "board".to_owned(),
            slabs,
            mass: DENSITY * volume,
            friction: self.friction,
            clearance: self.standoff,
            pose,
            z: FLOOR + self.standoff,
        }
        .balanced()
    }

    /// Returns the fixed parts, with the notch in the wall along `edge` at `middle` from its first
    /// corner.
    fn blocks(&self, pose: Pose, edge: usize, middle: f64) -> Vec<Obstacle> {
        let block =
            |name: String, at: Vector, heading: f64, [x, y]: [f64; 2], z: [f64; 2]| Obstacle {
                name,
                size: [x, y, z[1] - z[0]],
                pose: pose * Pose { position: at, heading },
                z: z[0],
                friction: self.friction,
            };
        let [x, y] = self.board.map(|side| 0.5 * side);
        let mut blocks = vec![block("floor".to_owned(), Vector::zeros(), 0.0, DRIVE, [0.0, FLOOR])];
        for (k, [i, j]) in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].iter().enumerate() {
            let inset = 0.5 * STANDOFF - self.gap;
            let at = Vector::new(i * (x - inset), j * (y - inset));
            let name = format!("standoff-{}", k + 1);
            blocks.push(block(name, at, 0.0, [STANDOFF, STANDOFF], [FLOOR, FLOOR + self.standoff]));
        }
        let z = [FLOOR, FLOOR + self.standoff + BOARD + self.above];
        for (k, name) in WALLS.into_iter().enumerate() {
            let heading = std::f64::consts::FRAC_PI_2 * k as f64;
            let frame = Pose { position: Vector::zeros(), heading };
            let (half, across) = if k % 2 == 0 { (x, y) } else { (y, x) };
            let out = -(across + self.gap + 0.5 * self.wall);
            // Walls along x include the corners.
            let end = half + self.gap + if k % 2 == 0 { self.wall } else { 0.0 };
            let pieces = if k == edge {
                let (from, to) =
                    (middle - half - 0.5 * self.notch, middle - half + 0.5 * self.notch);
                vec![("-1", -end, from), ("-2", to, end)]
            } else {
                vec![("", -end, end)]
            };
            for (part, from, to) in pieces {
                let at = frame.point(Vector::new(0.5 * (from + to), out));
                let name = format!("wall-{name}{part}");
                blocks.push(block(name, at, heading, [to - from, self.wall], z));
            }
        }
        blocks
    }
}

/// Draws a chip on the board.
fn chip(rng: &mut Pcg64, [x, y]: [f64; 2]) -> Slab {
    let size = [uniform(rng, 0.008, 0.020), uniform(rng, 0.008, 0.020)];
    let free = [0.5 * (x - size[0]) - 0.002, 0.5 * (y - size[1]) - 0.002];
    let at = Vector::new(uniform(rng, -free[0], free[0]), uniform(rng, -free[1], free[1]));
    cuboid(at, size, BOARD, uniform(rng, 0.001, 0.003))
}

fn overlap(a: &Slab, b: &Slab) -> bool {
    let apart = |axis: usize| {
        let (a, b) = (extent(a, axis), extent(b, axis));
        a[1] <= b[0] || b[1] <= a[0]
    };
    !apart(0) && !apart(1)
}

fn extent(slab: &Slab, axis: usize) -> [f64; 2] {
    let along = || slab.corners.iter().map(move |corner| corner[axis]);
    [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
}

fn cuboid(at: Vector, [x, y]: [f64; 2], bottom: f64, height: f64) -> Slab {
    let corner = |[i, j]: [f64; 2]| at + Vector::new(0.5 * i * x, 0.5 * j * y);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec();
    Slab { corners, bottom, height }
}
