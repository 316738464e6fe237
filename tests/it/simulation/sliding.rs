//! A freely sliding object travels the distance given by its support model.

use pushplan::geometry::{Pose, Shape, Vector, cross};
use pushplan::sim::Simulator;
use pushplan::{
    outcome::Record,
    scene::{GRAVITY, JointKind, Object, Scene, State, Support, Velocity},
    task::Job,
};

use crate::fixtures::{brick, can, engines, push, row};

/// Returns the final pose of an untouched object that starts at the origin with `velocity`.
fn slide(simulator: &Simulator, object: Object, velocity: Velocity) -> (Pose, f64) {
    let scene = Scene::new([object]);
    let start = State { velocities: vec![velocity], ..scene.start() };
    // The tool must move somewhere; far behind, it touches nothing.
    let motion = push(Vector::new(-2.0, 0.0), 0.0, 0.05, 0.05);
    let trajectory = simulator.run(
        &scene,
        &Job { start: start.clone(), ..Job::stated(&scene, motion.clone()) },
        Record::Frames,
    );
    assert!(trajectory.warnings.is_empty(), "{:?}", trajectory.warnings);
    let time = trajectory.frames.last().map_or(0.0, |frame| frame.time);
    (trajectory.outcome().poses[0], time)
}

#[test]
fn without_spin_it_slides_v_squared_over_two_mu_g() {
    let speed = 0.5;
    // Friction 0.4 on a table of 0.5.
    let expected = speed * speed / (2.0 * 0.45 * GRAVITY);
    for simulator in engines() {
        for object in [can(), brick()] {
            for k in 0..8 {
                let heading = 0.3 + k as f64 * std::f64::consts::FRAC_PI_4;
                let along = Vector::new(heading.cos(), heading.sin());
                let velocity = Velocity { linear: along * speed, angular: 0.0 };
                let (end, _) = slide(&simulator, object.clone(), velocity);
                let error = (end.position - along * expected).norm();
                assert!(error < 1.2e-3, "{:?} {heading}: {error}", simulator.engine());
                assert!(end.heading.abs() < 1e-3, "{:?}: {end:?}", simulator.engine());
            }
        }
    }
}

/// Integrates a support law independently of any engine, in steps of 50 us, until rest:
/// `law(heading, velocity)` gives the acceleration. Returns the final pose of an object that starts
/// at the origin.
fn integrate(start: Velocity, law: impl Fn(f64, Velocity) -> Velocity) -> Pose {
    let dt = 5e-5;
    let (mut pose, mut velocity) = (Pose::default(), start);
    for _ in 0..200_000 {
        let rate = law(pose.heading, velocity);
        let half = step(velocity, rate, dt / 2.0);
        let rate = law(pose.heading + velocity.angular * dt / 2.0, half);
        let next = step(velocity, rate, dt);
        // Friction stops an object within one step; it does not reverse its motion.
        if next.linear.dot(&start.linear) <= 0.0 || next.angular * start.angular < 0.0 {
            break;
        }
        pose.position += half.linear * dt;
        pose.heading += half.angular * dt;
        velocity = next;
    }
    pose
}

fn step(velocity: Velocity, rate: Velocity, dt: f64) -> Velocity {
    Velocity {
        linear: velocity.linear + rate.linear * dt,
        angular: velocity.angular + rate.angular * dt,
    }
}

const SPINNING: Velocity = Velocity { linear: Vector::new(0.4, 0.3), angular: 12.0 };

/// Returns points evenly spread over the underside of an object, far more than the engine has feet.
fn underside(object: &Object) -> Vec<Vector> {
    let steps = || (0..24).map(|k| (f64::from(k) + 0.5) / 12.0 - 1.0);
    let square = steps().flat_map(|x| steps().map(move |y| Vector::new(x, y)));
    match object.shape {
        Shape::Cylinder { radius, .. } => {
            square.filter(|place| place.norm() < 1.0).map(|place| radius * place).collect()
        }
        Shape::Cuboid { size: [x, y, _] } => {
            square.map(|place| Vector::new(place.x * x / 2.0, place.y * y / 2.0)).collect()
        }
        Shape::Prism { base, .. } => {
            let inside = |place: &Vector| {
                base.faces().all(|(corner, normal)| normal.dot(&(place - corner)) < 0.0)
            };
            square.map(|place| base.bounding_radius() * place).filter(inside).collect()
        }
    }
}

/// Returns force and torque of Coulomb friction under even pressure, in units of the largest force.
fn drag(places: &[Vector], heading: f64, velocity: Velocity) -> (Vector, f64) {
    let turn = Pose { position: Vector::zeros(), heading };
    let share = 1.0 / places.len() as f64;
    places.iter().fold((Vector::zeros(), 0.0), |(force, torque), place| {
        let arm = turn.vector(*place);
        let slip = velocity.at(arm);
        let push = slip * (-share / slip.norm().max(1e-9));
        (force + push, torque + cross(arm, push))
    })
}

#[test]
fn with_spin_the_planar_engine_follows_even_pressure_and_goes_further() {
    for object in [can(), brick()] {
        let rho = object.shape.footprint().gyration_radius();
        let a = 0.45 * GRAVITY;
        let places = underside(&object);
        let expected = integrate(SPINNING, |heading, v| {
            let (push, turn) = drag(&places, heading, v);
            Velocity { linear: push * a, angular: turn * a / (rho * rho) }
        });
        let (end, _) = slide(&Simulator::planar(), object.clone(), SPINNING);
        let error = (end.position - expected.position).norm();
        // Tolerance for sixteen feet and steps of 4 ms.
        assert!(error < 0.8e-3, "{}: {error}", object.name);
        assert!((end.heading - expected.heading).abs() < 0.02, "{end:?} for {expected:?}");

        let straight = Velocity { angular: 0.0, ..SPINNING };
        let (without, _) = slide(&Simulator::planar(), object, straight);
        assert!(end.position.norm() > without.position.norm() + 5e-3);
    }
}

/// Returns two cans and a brick of different masses, connected by fixed joints.
fn group() -> Scene {
    let mut scene = row(3, &can(), 0.11, |_| JointKind::Fixed);
    scene.objects[1] = Object { pose: Pose::new(0.05, 0.11, 0.4), ..brick() };
    scene.objects[0].mass = 0.9;
    scene
}

/// Returns the final state of the untouched group that starts with `velocity` about the world's
/// origin.
fn slide_group(simulator: &Simulator, scene: &Scene, velocity: Velocity) -> State {
    let mut start = scene.start();
    for (pose, own) in start.poses.iter().zip(&mut start.velocities) {
        *own = Velocity { linear: velocity.at(pose.position), ..velocity };
    }
    let motion = push(Vector::new(-2.0, 0.0), 0.0, 0.05, 0.05);
    let trajectory =
        simulator.run(scene, &Job { start, ..Job::stated(scene, motion) }, Record::Outcome);
    assert!(trajectory.warnings.is_empty(), "{:?}", trajectory.warnings);
    trajectory.outcome().clone()
}

#[test]
fn a_fixed_group_slides_v_squared_over_two_mu_g_too() {
    let scene = group();
    let velocity = Velocity { linear: Vector::new(0.4, 0.3), angular: 0.0 };
    let expected = velocity.linear * (0.5 / (2.0 * 0.45 * GRAVITY));
    for simulator in engines() {
        let end = slide_group(&simulator, &scene, velocity);
        for (object, pose) in scene.objects.iter().zip(&end.poses) {
            let error = (pose.position - object.pose.position - expected).norm();
            assert!(error < 1.5e-3, "{:?} {}: {error}", simulator.engine(), object.name);
        }
    }
}

#[test]
fn in_the_plane_a_fixed_group_follows_the_friction_of_each_of_its_objects() {
    let mut scene = group();
    scene.objects[2].friction = 0.9;
    let mass: f64 = scene.objects.iter().map(|object| object.mass).sum();
    let weighed = |object: &Object| object.mass * object.pose.position;
    let centre = scene.objects.iter().map(weighed).sum::<Vector>() / mass;
    let gyration = |object: &Object| object.shape.footprint().gyration_radius();
    let inertia: f64 = (scene.objects.iter())
        .map(|object| {
            let arm = object.pose.position - centre;
            object.mass * (gyration(object).powi(2) + arm.norm_squared())
        })
        .sum();
    let velocity = Velocity { linear: Vector::new(0.3, 0.2), angular: 6.0 };
    let places: Vec<Vec<Vector>> = scene.objects.iter().map(underside).collect();
    let at_centre = Velocity { linear: velocity.at(centre), ..velocity };
    let expected = integrate(at_centre, |heading, v| {
        let mut rate = Velocity::default();
        for (k, object) in scene.objects.iter().enumerate() {
            let turn = Pose { position: Vector::zeros(), heading };
            let arm = turn.vector(object.pose.position - centre);
            let weight = scene.support_friction(k) * object.mass * GRAVITY;
            let own = Velocity { linear: v.at(arm), ..v };
            let (push, twist) = drag(&places[k], heading + object.pose.heading, own);
            rate.linear += push * weight / mass;
            rate.angular += weight * (cross(arm, push) + twist) / inertia;
        }
        rate
    });
    let end = slide_group(&Simulator::planar(), &scene, velocity);
    let moved = Pose { position: centre + expected.position, heading: expected.heading };
    for (object, pose) in scene.objects.iter().zip(&end.poses) {
        let stood = Pose { position: object.pose.position - centre, ..object.pose };
        let error = (pose.position - (moved * stood).position).norm();
        assert!(error < 1e-3, "{}: {error}", object.name);
        assert!((pose.heading - (moved * stood).heading).abs() < 0.01, "{pose:?} {moved:?}");
    }
}

#[test]
fn with_spin_the_3d_engine_follows_friction_at_four_corners_and_goes_further() {
    // So flat that braking hardly shifts the load between the corners.
    let mut plate = brick();
    plate.shape = Shape::Cuboid { size: [0.10, 0.06, 0.002] };
    plate.support = Support::Corners;
    let corners = [(0.05, 0.03), (-0.05, 0.03), (-0.05, -0.03), (0.05, -0.03)];
    let rho = plate.shape.footprint().gyration_radius();
    let a = 0.45 * GRAVITY;
    let expected = integrate(SPINNING, |heading, v| {
        let mut rate = Velocity::default();
        for (x, y) in corners {
            let arm = Pose::new(0.0, 0.0, heading).vector(Vector::new(x, y));
            let slip = v.at(arm);
            let push = slip * (-0.25 * a / slip.norm().max(1e-12));
            rate.linear += push;
            rate.angular += cross(arm, push) / (rho * rho);
        }
        rate
    });
    let (end, _) = slide(&Simulator::spatial(), plate.clone(), SPINNING);
    let error = (end.position - expected.position).norm();
    assert!(error < 1.5e-3, "{error}: {end:?} for {expected:?}");
    assert!((end.heading - expected.heading).abs() < 0.05, "{end:?} for {expected:?}");

    let straight = Velocity { angular: 0.0, ..SPINNING };
    let (without, _) = slide(&Simulator::spatial(), plate, straight);
    assert!(end.position.norm() > without.position.norm() + 5e-3);
}
