//! Tests of `cuboids`.

use super::*;
use crate::geometry::Pose;

fn cuboid(at: [f64; 3], half: [f64; 3]) -> Box3 {
    Box3 { pose: Pose3 { position: at.into(), ..Pose3::default() }, half: half.into() }
}

fn contacts(a: &Box3, b: &Box3, reach: f64) -> Vec<BoxContact> {
    let mut found = Vec::new();
    a.contacts(b, reach, |contact| found.push(contact));
    found
}

#[test]
fn a_cuboid_stands_on_another_with_four_corners() {
    let (floor, on) = (cuboid([0.0; 3], [0.1, 0.1, 0.01]), cuboid([0.0, 0.0, 0.021], [0.01; 3]));
    let found = contacts(&on, &floor, 0.005);
    assert_eq!(found.len(), 4);
    for contact in found {
        assert!((contact.normal - Vector3::z()).norm() < 1e-12);
        assert!((contact.gap - 0.001).abs() < 1e-12);
        assert!((contact.point.z - 0.011).abs() < 1e-12);
    }
    assert_eq!(contacts(&on, &floor, 0.0005), []);
}

#[test]
fn crossed_edges_touch_in_one_point() {
    // Both rotated about their edges so that the edges face each other, one along x, one along y.
    let eighth = std::f64::consts::FRAC_PI_4;
    let turned = |at: Vector3, axis| {
        Box3 {
            pose: Pose3::upright(Pose::default(), 0.0).turned_about(Vector3::zeros(), axis, eighth),
            half: Vector3::repeat(0.01),
        }
        .at(at)
    };
    let below = turned(Vector3::zeros(), Vector3::x_axis());
    let above = turned(Vector3::new(0.0, 0.0, 0.03), Vector3::y_axis());
    let found = contacts(&above, &below, 0.002);
    let contact = found.iter().min_by(|a, b| a.gap.total_cmp(&b.gap)).expect("a contact");
    assert!((contact.gap - (0.03 - 0.02 * 2f64.sqrt())).abs() < 1e-9, "{}", contact.gap);
    assert!((contact.normal - Vector3::z()).norm() < 1e-9);
}

impl Box3 {
    fn at(mut self, at: Vector3) -> Self {
        self.pose.position = at;
        self
    }
}
