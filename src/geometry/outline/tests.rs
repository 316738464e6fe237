//! Tests of `outline`.

use super::*;
use crate::geometry::Vector;

/// Creates an extent from centre and size.
fn extent(x: f64, y: f64, width: f64, height: f64) -> Extent {
    [[x - width / 2.0, y - height / 2.0], [x + width / 2.0, y + height / 2.0]]
}

fn close(a: Extent, b: Extent) -> bool {
    a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn a_row_is_one_rectangle_touched_all_around() {
    let row: Vec<Extent> =
        (0..4).map(|k| extent(0.12 + 0.14 * k as f64, 0.0, 0.14, 0.08)).collect();
    let pieces = outline(&row);
    assert_eq!(pieces.len(), 1);
    assert!(close(pieces[0].extent, extent(0.33, 0.0, 0.56, 0.08)));
    assert_eq!(pieces[0].rim.corners, [true; 4]);
    for (side, half) in [0.04, 0.28, 0.04, 0.28].into_iter().enumerate() {
        let [(low, high)] = pieces[0].rim.sides[side][..] else { panic!("one stretch") };
        assert!((low + half).abs() < 1e-9 && (high - half).abs() < 1e-9);
    }
}

#[test]
fn each_face_of_an_l_belongs_to_one_of_two_rectangles() {
    let parts: Vec<Extent> = [(0.12, 0.0, 0.14, 0.08), (0.26, 0.0, 0.14, 0.08)]
        .into_iter()
        .chain([(0.40, 0.0, 0.14, 0.08), (0.43, 0.12, 0.08, 0.16)])
        .map(|(x, y, width, height)| extent(x, y, width, height))
        .collect();
    let pieces = outline(&parts);
    assert_eq!(pieces.len(), 2);
    let [handle, bar] = [0.42, 0.24].map(|length| {
        pieces.iter().find(|piece| {
            let [from, to] = piece.extent;
            ((to[0] - from[0]).max(to[1] - from[1]) - length).abs() < 1e-9
        })
    });
    let (handle, bar) = (handle.expect("the handle"), bar.expect("the bar"));
    // The end face belongs to the bar, the long back face to the handle, and none to both.
    let shows = |piece: &OutlinePiece, x: f64, y: f64, normal: Vector| {
        let [from, to] = piece.extent;
        let centre = Vector::new(from[0] + to[0], from[1] + to[1]) / 2.0;
        piece.rim.shows(Vector::new(x, y) - centre, normal)
    };
    for y in [-0.04, 0.0, 0.04, 0.1, 0.2] {
        assert!(shows(bar, 0.47, y, Vector::x()) && !shows(handle, 0.47, y, Vector::x()));
    }
    for x in [0.05, 0.3, 0.4, 0.47] {
        let down = -Vector::y();
        assert!(shows(handle, x, -0.04, down) && !shows(bar, x, -0.04, down), "{x}");
    }
    // The corner that would catch a box sliding along the back.
    assert!(!shows(bar, 0.39, -0.04, -Vector::x()));
    assert!(!shows(bar, 0.39, -0.04, Vector::new(-0.8, -0.6)));
    // The inner corner has both faces, and the outer corners are corners.
    assert!(shows(bar, 0.39, 0.05, -Vector::x()) && shows(handle, 0.38, 0.04, Vector::y()));
    let outer = Vector::new(0.6, -0.8);
    assert!(shows(bar, 0.47, -0.04, outer) || shows(handle, 0.47, -0.04, outer));
    assert!(shows(bar, 0.39, 0.20, Vector::new(-0.8, 0.6)));
}

#[test]
fn separate_outlines_stay_apart_and_a_hole_is_no_error() {
    let apart = [extent(0.0, 0.0, 0.1, 0.1), extent(0.3, 0.0, 0.1, 0.1)];
    assert_eq!(outline(&apart).len(), 2);
    let frame = [
        extent(0.0, 0.1, 0.3, 0.1),
        extent(0.0, -0.1, 0.3, 0.1),
        extent(0.1, 0.0, 0.1, 0.3),
        extent(-0.1, 0.0, 0.1, 0.3),
    ];
    let pieces = outline(&frame);
    assert_eq!(pieces.len(), 4);
    let inner = pieces.iter().filter(|piece| {
        let [from, to] = piece.extent;
        let centre = Vector::new(from[0] + to[0], from[1] + to[1]) / 2.0;
        let is_its_side = (from[0] - 0.05).abs() < 1e-9;
        is_its_side && piece.rim.shows(Vector::new(0.05, 0.0) - centre, -Vector::x())
    });
    assert_eq!(inner.count(), 1);
}
