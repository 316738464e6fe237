//! Tests of `outline`.

use super::*;

#[test]
fn a_hook_written_with_turned_parts_has_two_pieces() {
    let row = (1..4).map(|k| {
        let x = -0.02 + 0.14 * f64::from(k);
        Part::cuboid(format!("handle-{k}"), [0.14, 0.08, 0.05], Pose::new(x, 0.0, 0.0))
    });
    let bar = Part::cuboid("bar", [0.16, 0.08, 0.05], Pose::new(0.43, 0.12, FRAC_PI_2));
    let mut parts: Vec<Part> = row.chain([bar]).collect();
    let pieces = super::pieces(&parts);
    let names: Vec<&str> = pieces.iter().map(|piece| piece.name.as_str()).collect();
    assert_eq!(names, ["handle-1+handle-2+handle-3", "bar"]);
    let Shape::Cuboid { size } = pieces[1].shape else { panic!("a cuboid") };
    assert!((size[0] - 0.08).abs() < 1e-12 && (size[1] - 0.24).abs() < 1e-12);
    // The tool at another angle has the same pieces.
    let askew = Pose::new(0.2, -0.1, 0.7);
    parts.iter_mut().for_each(|part| part.pose = askew * part.pose);
    for (piece, straight) in super::pieces(&parts).iter().zip(&pieces) {
        let expected = askew * straight.pose;
        assert!((piece.pose.position - expected.position).norm() < 1e-12);
        assert!((piece.pose.heading - expected.heading).abs() < 1e-12);
        assert_eq!(piece.name, straight.name);
    }
}

#[test]
fn parts_that_differ_stay_as_they_are() {
    let part = |name: &str, size: [f64; 3], yaw: f64| {
        Part::cuboid(name, size, Pose::new(0.1 * yaw, 0.0, yaw))
    };
    let mut parts = vec![
        part("low", [0.1, 0.02, 0.03], 0.0),
        part("high", [0.1, 0.02, 0.05], 0.0),
        part("slanted", [0.1, 0.02, 0.05], 0.8),
    ];
    parts.push(Part {
        name: "round".into(),
        shape: Shape::Cylinder { radius: 0.02, height: 0.05 },
        pose: Pose::default(),
    });
    let pieces = super::pieces(&parts);
    assert_eq!(pieces.len(), 4);
    for (piece, part) in pieces.iter().zip(&parts) {
        assert_eq!((&piece.name, piece.shape, piece.pose), (&part.name, part.shape, part.pose));
        assert_eq!(piece.rim, None);
    }
}
