use pushplan::{geometry::*, report::*, scene::*};
use std::sync::Arc;
fn main() {
    let part = |name: &str, x: f64, y: f64, h: f64, s: [f64; 3]| Part {
        name: name.into(),
        size: s,
        pose: Pose::new(x, y, h),
    };
    let tool = Arc::new(
        Tool::assemble(
            "l-hook".into(),
            "".into(),
            Pose::default(),
            0.4,
            vec![
                part("a", 0.12, 0.0, 0.0, [0.14, 0.08, 0.05]),
                part("b", 0.26, 0.0, 0.0, [0.14, 0.08, 0.05]),
                part("c", 0.40, 0.0, 0.0, [0.14, 0.08, 0.05]),
                part("d", 0.43, 0.12, 1.5708, [0.16, 0.08, 0.05]),
            ],
            &[],
        )
        .unwrap(),
    );
    let obj = |n: &str, x: f64, y: f64, h: f64, shape| Object {
        name: n.into(),
        shape,
        mass: 0.4,
        friction: 0.4,
        pose: Pose::new(x, y, h),
    };
    let scene = Scene {
        table_friction: 0.5,
        objects: vec![
            obj("can", 0.80, 0.12, 0.0, Shape::Cylinder { radius: 0.05, height: 0.1 }),
            obj("box", 0.55, -0.25, 0.5, Shape::Cuboid { size: [0.12, 0.08, 0.1] }),
            obj("tin", 0.40, 0.32, 0.0, Shape::Cylinder { radius: 0.04, height: 0.1 }),
        ],
        joints: vec![],
        obstacles: vec![
            Obstacle {
                name: "wall".into(),
                size: [0.04, 0.4, 0.1],
                pose: Pose::new(0.62, -0.35, 0.1),
                friction: 0.4,
            },
            Obstacle {
                name: "post".into(),
                size: [0.04, 0.04, 0.1],
                pose: Pose::new(0.3, -0.3, 0.1),
                friction: 0.4,
            },
        ],
    };
    let goal = Goal {
        object: 0,
        position: Vector::new(0.60, 0.10),
        tolerance: 0.05,
        heading: std::env::args().nth(2).map(|_| (0.5, 0.2)),
    };
    let robot = Robot { home: Vector::zeros(), reach_min: 0.1, reach_max: 0.9 };
    let pushes = [
        Push { start: Vector::new(0.42, 0.0), direction: 3.14159, length: 0.2, speed: 0.1 },
        Push { start: Vector::new(0.15, 0.18), direction: -1.2, length: 0.1, speed: 0.1 },
    ];
    let motion = ToolMotion::pushes(tool, 0.002, 0.0, &pushes, true);
    let traj = |k: f64| {
        let mut t = Trajectory::default();
        for i in 0..=20 {
            let f = i as f64 / 20.0;
            let mut s = scene.start();
            s.poses[0].position += Vector::new(-0.19 * f, -0.03 * f * f * k);
            s.poses[1].position += Vector::new(0.02 * f, -0.1 * f * k);
            s.poses[1].heading += f;
            t.frames.push(Frame { time: f, stroke: 0, tool: Pose::default(), state: s })
        }
        t
    };
    let (a, b, c) = (traj(1.0), traj(1.2), traj(1.3));
    let pic = ScenePicture { title: "pull-back: l-hook, grip yaw 0°, 2 pushes".into(),
        notes: vec!["error predicted 3.1 mm, planar 3.9 mm, 3-D 5.2 mm of 50 mm allowed; verified, 8 of 8 disturbed replays pass".into()],
        scene: &scene, goal: Some(&goal), robot: Some(&robot), motion: Some(&motion),
        tracks: vec![Track { source: Source::Simulated(Engine::Planar), trajectory: &b }, Track { source: Source::Simulated(Engine::Spatial), trajectory: &c }, Track { source: Source::Predicted, trajectory: &a }] };
    let dir = std::env::args().nth(1).unwrap();
    std::fs::write(format!("{dir}/scene.svg"), pic.to_svg()).unwrap();
    let s = |name: &str, f: f64, m| Series {
        name: name.into(),
        points: (1..60).map(|k| [k as f64 * 2000.0, f * 20.0 / (k as f64).sqrt()]).collect(),
        mark: m,
        labels: vec![(20, "here".into())],
    };
    let chart = Chart {
        title: "Training".into(),
        x: Axis::linear("steps"),
        y: Axis::log("error, mm"),
        series: vec![s("train", 1.0, Mark::Line), s("held out", 1.4, Mark::DottedLine)],
    };
    std::fs::write(format!("{dir}/chart.svg"), chart.to_svg()).unwrap();
}
