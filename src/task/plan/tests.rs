//! Tests of `plan`.

use super::*;
use crate::geometry::Vector;
use crate::{
    scene::{Blade, Part},
    task::Place,
};

fn push(x: f64) -> Push {
    Push { start: Vector::new(x, 0.0), direction: 0.0, length: 0.1, speed: 0.1 }
}

fn lever() -> LeverUp {
    let place = Place { edge: 0, fraction: 0.5 };
    LeverUp {
        plate: 0,
        place,
        depth: 0.01,
        pivot: 0.1,
        angle: 1.0,
        speed: 0.1,
        hold: 0.2,
        retreat: 0.1,
    }
}

#[test]
fn pushes_in_a_row_with_one_tool_are_one_motion() {
    let bar = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let bar = Arc::new(Tool::new("bar", [bar]).expect("one piece"));
    let blade = Blade { length: 0.1, width: 0.01, thickness: 0.002, friction: 0.4 };
    let tools = [bar, Arc::new(Tool::with_blade("blade", blade))];
    let pushing = |count: usize, yaw: f64| {
        let pushes = (0..count).map(|k| push(0.1 * k as f64));
        Plan::pushing("bar", yaw, PushForm::Placed, 0.002, pushes)
    };
    let plan = pushing(2, 0.0)
        .then(Plan::levering("blade", lever()))
        .then(pushing(1, 0.0))
        .then(pushing(1, 0.5));
    let motions = plan.motions(&tools).expect("its tools");
    let strokes: Vec<usize> = motions.iter().map(|m| m.slide().strokes.len()).collect();
    // The hand rotates between pushes and keeps the tool.
    assert_eq!(strokes, [2, 0, 2]);
    assert!(motions[1].is_lever() && !motions[0].is_lever());
    assert_eq!(plan.tools(), ["bar", "blade"]);
    assert_eq!(plan.motions(&tools[..1]), None, "no blade");
    let whole = pushing(2, 0.0);
    let motions = whole.motions(&tools).expect("its tool");
    assert_eq!(motions, [Motion::Slide(whole.motion(&tools[0]))]);
    assert_eq!(Plan::default().motions(&tools), Some(Vec::new()));
}
