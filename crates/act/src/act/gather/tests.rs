//! Tests of `gather`.

use std::sync::Arc;

use super::*;
use pushplan::geometry::Pose;
use pushplan::{
    scene::{Part, Tool},
    task::Push,
};

fn motion() -> ToolMotion {
    let part = Part::cuboid("bar", [0.02, 0.1, 0.05], Pose::default());
    let tool = Arc::new(Tool::new("bar", [part]).expect("one piece"));
    let push = Push { start: Vector::zeros(), direction: 0.0, length: 0.2, speed: 0.1 };
    ToolMotion::pushes(tool, 0.0, 0.0, &[push], true)
}

fn state(places: [[f64; 2]; 2]) -> State {
    State::at_rest(places.map(|[x, y]| Pose::new(x, y, 0.0)).to_vec())
}

fn look(time: f64, places: [[f64; 2]; 2]) -> Look {
    let sight = |[x, y]: [f64; 2]| Some(ObservedPose::new(&Pose::new(x, y, 0.0), true));
    Look { time, seen: places.map(sight).to_vec() }
}

const STILL: [f64; 2] = [0.5, 0.3];

/// Observations in which the first object moves with the tool from 0.05 m on and the second rests.
fn looks() -> Vec<Look> {
    let at = |k: usize| look(0.1 * k as f64, [[0.05 + 0.01 * k as f64, 0.0], STILL]);
    (1..=21).map(at).collect()
}

fn gatherer() -> Gatherer {
    Gatherer::new(&state([[0.05, 0.0], STILL]), &state([[0.25, 0.0], STILL]))
}

#[test]
fn strokes_between_looks_are_the_motion_and_only_the_last_settles() {
    let (observations, rest) = gatherer().motion(&motion(), looks()).expect("one table");
    let strokes: Vec<&Stroke> = observations.iter().flat_map(|seen| &seen.strokes).collect();
    let travel: f64 = strokes.iter().map(|stroke| stroke.travel()).sum();
    assert!((travel - 0.2).abs() < 1e-9 && observations.len() == 20, "{travel}");
    assert!(strokes.windows(2).all(|two| two[0].to == two[1].from && !two[0].settle));
    assert!(strokes.last().is_some_and(|last| last.settle));
    assert_eq!(rest.map(|look| look.time), Some(0.1 * 21.0));
}

#[test]
fn late_looks_change_nothing_but_are_noted_and_those_of_other_times_are_left_out() {
    let (ordered, _) = gatherer().motion(&motion(), looks()).expect("one table");
    let mut late = looks();
    late.swap(3, 9);
    late.push(look(-1.0, [[9.0, 9.0], STILL]));
    late.push(look(f64::NAN, [[9.0, 9.0], STILL]));
    let mut gatherer = gatherer();
    let (again, _) = gatherer.motion(&motion(), late).expect("one table");
    assert_eq!(again, ordered);
    assert_eq!(gatherer.notes, [Note::Untimely, Note::OutOfOrder]);
}

#[test]
fn missing_looks_leave_longer_strokes_and_no_rest() {
    let few: Vec<Look> = looks().into_iter().step_by(6).take(3).collect();
    let (observations, rest) = gatherer().motion(&motion(), few).expect("one table");
    assert_eq!(observations.len(), 4);
    assert!(rest.is_none() && observations[3].seen == [None, None]);
}

#[test]
fn objects_that_were_taken_for_each_other_are_changed_back() {
    let mut swapped = looks();
    for look in &mut swapped[8..] {
        look.seen.swap(0, 1);
    }
    let (ordered, _) = gatherer().motion(&motion(), looks()).expect("one table");
    let mut gatherer = gatherer();
    let (again, _) = gatherer.motion(&motion(), swapped).expect("one table");
    assert_eq!(again, ordered);
    assert_eq!(gatherer.notes, [Note::Swapped { between: [0, 1] }]);
}

#[test]
fn impossible_observations_are_dropped_and_another_table_is_an_error() {
    let mut wild = looks();
    wild[4].seen[1] = Some(ObservedPose { position: Vector::new(2.0, 2.0), heading: None });
    wild[5].seen[0] = Some(ObservedPose { position: Vector::new(f64::NAN, 0.0), heading: None });
    let mut one = gatherer();
    let (observations, _) = one.motion(&motion(), wild).expect("one table");
    assert_eq!([observations[4].seen[1], observations[5].seen[0]], [None, None]);
    let notes = [Note::Jumped { object: 1 }, Note::Unreadable { object: 0 }];
    assert_eq!(one.notes, notes);
    let short = vec![Look { time: 1.0, seen: vec![None] }];
    let refused = gatherer().motion(&motion(), short);
    assert!(matches!(refused, Err(ActError::Objects { expected: 2, found: 1 })));
}
