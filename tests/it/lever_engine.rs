//! Lever-ups in the 3-D engine: comparison with closed forms, symmetries, and repeatability.
//!
//! Former errors: parry considers only four corners of a hull's larger face; a rotation whose
//! quaternion changes its sign looks like a full turn; rapier lets bodies penetrate; contacts
//! carried over between steps hold a plate that has left the blade.

use std::sync::Arc;

use pushplan::geometry::{Pose, Pose3, Vector, Vector3};
use pushplan::sim::LeverSimulator;
use pushplan::{
    outcome::{Ending, Frame, LEVER_FRAMES, LeverWarning},
    scene::{Blade, GRAVITY, LeverScene, Plate, Slab},
    task::{LeverJob, LeverUp, Place},
};

/// Free height below plates, metres.
const CLEARANCE: f64 = 0.006;

/// Radius of the feet that the engine adds, metres.
const FOOT: f64 = 0.001;

fn plate(corners: &[[f64; 2]], height: f64, pose: Pose) -> Plate {
    let corners = corners.iter().map(|[x, y]| Vector::new(*x, *y)).collect();
    let slab = Slab { corners, bottom: 0.0, height };
    Plate {
        name: "plate".to_owned(),
        mass: 1200.0 * slab.volume(),
        slabs: vec![slab],
        friction: 0.5,
        clearance: CLEARANCE,
        pose,
        z: CLEARANCE,
    }
    .balanced()
}

fn square(pose: Pose) -> Plate {
    plate(&[[-0.07, -0.07], [0.07, -0.07], [0.07, 0.07], [-0.07, 0.07]], 0.008, pose)
}

fn regular(count: usize, pose: Pose) -> Plate {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * (k as f64 + 0.3) / count as f64;
        [0.05 * angle.cos(), 0.05 * angle.sin()]
    };
    plate(&(0..count).map(corner).collect::<Vec<_>>(), 0.008, pose)
}

fn lever(edge: usize, fraction: f64, pivot: f64, degrees: f64) -> LeverUp {
    LeverUp {
        plate: 0,
        place: Place { edge, fraction },
        depth: 0.015,
        pivot,
        angle: degrees.to_radians(),
        speed: LeverUp::SPEED,
        hold: LeverUp::HOLD,
        retreat: LeverUp::RETREAT,
    }
}

fn job(plates: Vec<Plate>, lever: LeverUp) -> LeverJob {
    let blade = Blade { length: 0.12, width: 0.006, thickness: 0.002, friction: 0.5 };
    let scene = LeverScene { plates, blocks: Vec::new(), table_friction: 0.5, blade };
    LeverJob { scene: Arc::new(scene), lever }
}

/// Returns the poses of all plates in a frame.
fn poses(frame: &Frame) -> &[Pose3] {
    frame.state.space.as_ref().expect("in space")
}

#[test]
fn plates_of_any_number_of_corners_lie_on_their_faces() {
    let beside = |count: usize| {
        let mut plate = regular(count, Pose::new(0.5, 0.2 * count as f64 - 1.2, 0.4));
        // Without feet, dropped from slightly above the table.
        (plate.z, plate.clearance) = (0.002, 0.0);
        plate
    };
    let plates = [square(Pose::default())].into_iter().chain((3..=10).map(beside)).collect();
    let job = job(plates, lever(0, 0.5, 0.14, 20.0));
    let (_, motion) = LeverSimulator::FINE.record(&job, 0.1);
    let (last, _) = motion.last().expect("frames");
    for (corners, rest) in (3..=10).zip(&poses(last)[1..]) {
        assert!(rest.tilt().to_degrees() < 0.2, "{corners}: {:.1} deg", rest.tilt().to_degrees());
        assert!(rest.position.z.abs() < 2e-4, "{corners}: {} m", rest.position.z);
    }
}

#[test]
fn a_turn_past_the_vertical_throws_nothing_wherever_it_points() {
    for k in 0..16 {
        let heading = std::f64::consts::TAU * f64::from(k) / 16.0;
        let job = job(vec![square(Pose::new(0.5, 0.1, heading))], lever(1, 0.5, 0.14, 130.0));
        let (trajectory, motion) = LeverSimulator::FINE.record(&job, 1.0 / 120.0);
        assert!(!trajectory.warnings.contains(&LeverWarning::Jammed), "heading {heading:.2}");
        assert_eq!(trajectory.ending, Ending::Flipped, "heading {heading:.2}");
        for pair in motion.windows(2) {
            let moved = (poses(&pair[1].0)[0].position - poses(&pair[0].0)[0].position).norm();
            let speed = moved / (pair[1].0.time - pair[0].0.time);
            // A fall from 7 cm ends at 1.2 m/s.
            assert!(speed < 1.5, "heading {heading:.2}, {:.2} s: {speed:.1} m/s", pair[1].0.time);
        }
    }
}

#[test]
fn plates_do_not_sink_into_the_table() {
    let job = job(vec![square(Pose::default())], lever(0, 0.5, 0.14, 40.0));
    let trajectory = LeverSimulator::FINE.run(&job);
    assert_eq!(trajectory.ending, Ending::Back);
    assert!(
        (trajectory.rest.position.z - CLEARANCE).abs() < 2e-4,
        "{}",
        trajectory.rest.position.z
    );
    for (k, pose) in trajectory.lift.iter().enumerate() {
        let lowest = lowest_foot(&job.scene.plates[0], pose);
        assert!(lowest.abs() < 3e-4, "frame {k}: {:.2} mm", 1e3 * lowest);
    }
}

/// Returns the height of the lowest foot above the table, metres.
fn lowest_foot(plate: &Plate, pose: &Pose3) -> f64 {
    let foot = |corner: &Vector| {
        let centre = Vector3::new(corner.x, corner.y, FOOT - CLEARANCE);
        pose.point(centre).z - FOOT
    };
    plate.corners().iter().map(foot).fold(f64::INFINITY, f64::min)
}

/// Returns the tilt of a square plate whose underside touches the tip of a blade rotated by `turn`.
/// The blade's axis is one foot's height above the axis of the far feet, so the plate rotates by
/// less.
fn tilt_of_square(turn: f64, arm: f64) -> f64 {
    let mut tilt = turn;
    for _ in 0..50 {
        tilt = turn - ((CLEARANCE - FOOT) * (1.0 - tilt.cos()) / arm).asin();
    }
    tilt
}

#[test]
fn a_plate_turns_about_its_far_feet_as_the_blade_does() {
    let job = job(vec![square(Pose::new(0.4, 0.2, 0.6))], lever(3, 0.5, 0.14, 60.0));
    let trajectory = LeverSimulator::FINE.run(&job);
    let plate = &job.scene.plates[0];
    let arm = job.lever.pivot - job.lever.depth;
    for (k, pose) in trajectory.lift.iter().enumerate() {
        assert!(trajectory.held[k]);
        let turn = job.lever.angle * (k + 1) as f64 / LEVER_FRAMES as f64;
        let known = tilt_of_square(turn, arm);
        let off = (pose.tilt() - known).to_degrees();
        assert!(off.abs() < 0.3, "frame {k}: off by {off:.2} deg of {:.1}", known.to_degrees());
        for corner in [1, 2] {
            let foot = plate.corners()[corner];
            let foot = Vector3::new(foot.x, foot.y, FOOT - CLEARANCE);
            let strayed = (pose.point(foot) - plate.start().point(foot)).norm();
            // The feet roll by their radius times the angle, and creep slightly.
            assert!(strayed < FOOT * turn + 1e-3, "frame {k}: {:.2} mm", 1e3 * strayed);
        }
    }
}

#[test]
fn the_blade_carries_its_share_of_the_weight() {
    let job = job(vec![square(Pose::default())], lever(0, 0.5, 0.14, 60.0));
    let (_, motion) = LeverSimulator::TRUTH.record(&job, 0.1);
    let plate = &job.scene.plates[0];
    let arm = job.lever.pivot - job.lever.depth;
    let mut seen = 0;
    for (frame, force) in &motion {
        let turn = job.lever.angle * frame.time / job.lever.turn_time();
        if !(0.3..1.0).contains(&(turn / job.lever.angle)) {
            continue;
        }
        // Moments about the far feet.
        let tilt = tilt_of_square(turn, arm);
        let rise = CLEARANCE - FOOT + 0.5 * plate.slabs[0].height;
        let lever = 0.5 * job.lever.pivot * tilt.cos() - rise * tilt.sin();
        let known = plate.mass * GRAVITY * lever / (arm * (turn - tilt).cos());
        let share = force / known;
        // Friction at the tip and the rolling feet takes a share.
        assert!((share - 1.0).abs() < 0.15, "{:.1} deg: {share:.3}", turn.to_degrees());
        seen += 1;
    }
    assert!(seen >= 5);
}

#[test]
fn a_released_plate_falls_and_gains_no_energy() {
    let job = job(vec![square(Pose::default())], lever(0, 0.5, 0.14, 60.0));
    let (trajectory, motion) = LeverSimulator::FINE.record(&job, 0.01);
    assert_eq!(trajectory.ending, Ending::Back);
    let centre = job.scene.plates[0].weight().centre;
    let height = |pose: &Pose3| pose.point(centre).z;
    let held = job.lever.turn_time() + job.lever.hold;
    let after = motion.iter().filter(|(frame, _)| frame.time > held - 0.1);
    let mut lowest = f64::INFINITY;
    for (frame, _) in after {
        let now = height(&poses(frame)[0]);
        assert!(now < lowest + 5e-4, "{:.2} s: {:.2} mm up", frame.time, 1e3 * (now - lowest));
        lowest = lowest.min(now);
    }
    assert!((lowest - CLEARANCE - centre.z).abs() < 3e-4);
}

#[test]
fn a_mirrored_lever_up_does_the_mirrored_thing() {
    let corners = [[0.0, 0.0], [0.13, 0.01], [0.15, 0.08], [0.06, 0.13], [-0.01, 0.07]];
    let mirrored: Vec<[f64; 2]> = corners.iter().rev().map(|[x, y]| [*x, -y]).collect();
    let count = corners.len();
    for edge in 0..count {
        let one = job(
            vec![plate(&corners, 0.008, Pose::new(0.5, 0.1, 0.7))],
            lever(edge, 0.4, 0.12, 50.0),
        );
        // Corner k becomes corner count - 1 - k, and its edge ends where the original began.
        let other_edge = (2 * count - 2 - edge) % count;
        let other = job(
            vec![plate(&mirrored, 0.008, Pose::new(0.5, -0.1, -0.7))],
            lever(other_edge, 0.6, 0.12, 50.0),
        );
        let [one, other] = [one, other].map(|job| LeverSimulator::FINE.run(&job));
        assert_eq!(one.held, other.held, "edge {edge}");
        assert_eq!(one.ending, other.ending, "edge {edge}");
        let apart = |(a, b): (&Pose3, &Pose3)| {
            let b = Vector3::new(b.position.x, -b.position.y, b.position.z);
            1e3 * (a.position - b).norm()
        };
        let mut apart: Vec<f64> = one.lift.iter().zip(&other.lift).map(apart).collect();
        apart.sort_by(f64::total_cmp);
        // Solvers process contacts in another order, which affects a plate that is about to tip
        // over.
        assert!(apart[LEVER_FRAMES / 2] < 0.3, "edge {edge}: {apart:?} mm");
        assert!(apart[LEVER_FRAMES - 1] < 3.0, "edge {edge}: {apart:?} mm");
    }
}

#[test]
fn where_the_table_is_makes_no_difference() {
    let run = |at: Pose| {
        let job = job(vec![regular(7, at)], lever(2, 0.5, 0.09, 50.0));
        let frame = job.lever.frame(&job.scene);
        let trajectory = LeverSimulator::FINE.run(&job);
        (frame.inverse() * trajectory.lift[LEVER_FRAMES - 1]).position
    };
    let here = run(Pose::default());
    for pose in [Pose::new(0.6, -0.2, 0.0), Pose::new(100.0, 50.0, 0.0), Pose::new(0.4, 0.1, 2.0)] {
        let apart = 1e3 * (run(pose) - here).norm();
        assert!(apart < 0.2, "{pose:?}: {apart:.3} mm");
    }
}

#[test]
fn a_blade_that_is_driven_into_something_is_a_jam() {
    // A block lies on the plate: the blade would have to pass through both.
    let mut job = job(vec![square(Pose::default())], lever(0, 0.5, 0.14, 60.0));
    let mut scene = LeverScene::clone(&job.scene);
    scene.blocks.push(pushplan::scene::Obstacle {
        name: "beam".to_owned(),
        size: [0.3, 0.3, 0.02],
        pose: Pose::default(),
        z: CLEARANCE + 0.0081,
        friction: 0.5,
    });
    job.scene = Arc::new(scene);
    let trajectory = LeverSimulator::FINE.run(&job);
    assert!(trajectory.warnings.contains(&LeverWarning::Jammed));
    assert!(trajectory.rest.is_finite() && trajectory.lift.len() == LEVER_FRAMES);
}
