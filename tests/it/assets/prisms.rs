//! Prisms in files: interpretation, and messages for invalid prisms.

use pushplan::geometry::{ConvexPolygon, Shape, Vector};
use pushplan::{
    scene::{Support, Tool},
    task::Task,
};

/// Returns a task with an object of this shape, with additional keys of the object and of the goal.
fn task(shape: &str, object: &str, goal: &str) -> String {
    format!(
        "
scene:
  objects:
    - name: block
      shape: {shape}
      mass: 0.5
      friction: 0.4
      position: [0.5, 0.1]{object}
robot: {{reach: {{max: 0.8}}}}
tools: [stick]
goal: {{object: block, position: [0.6, 0.1], tolerance: 0.02{goal}}}
"
    )
}

fn read(shape: &str, object: &str, goal: &str) -> Task {
    let text = task(shape, object, goal);
    let read = Task::parse(&text, "t.yaml").unwrap_or_else(|faults| panic!("{faults}"));
    let again = Task::parse(&read.to_yaml().unwrap(), "t.yaml").unwrap();
    assert_eq!(again, Task { name: again.name.clone(), ..read.clone() });
    read
}

/// Asserts that the only fault of `text` is at the start of `place`, with these words.
fn refused(text: &str, place: &str, words: &str) {
    let at = text.find(place).expect("the place is there");
    let line = text[..at].matches('\n').count() + 1;
    let column = at - text[..at].rfind('\n').map_or(0, |end| end + 1) + 1;
    let message = Task::parse(text, "t.yaml").unwrap_err().to_string();
    assert!(message.starts_with(&format!("t.yaml:{line}:{column}: error: {words}")), "{message}");
    assert_eq!(message.matches("error:").count(), 1, "{message}");
}

#[test]
fn a_prism_lies_about_its_centroid_or_the_centre_of_mass_that_is_given() {
    let corners = [[0.0, 0.0], [0.09, 0.0], [0.0, 0.06]].map(|[x, y]| Vector::new(x, y));
    let base = |task: &Task| match task.scene.objects[0].shape {
        Shape::Prism { base, height: 0.05 } => base,
        other => panic!("{other:?}"),
    };
    let plain = read("{prism: {corners: [[0, 0], [0.09, 0], [0, 0.06]], height: 0.05}}", "", "");
    assert_eq!(base(&plain), ConvexPolygon::new(&corners).unwrap());
    assert_eq!(plain.scene.objects[0].pose.position, Vector::new(0.5, 0.1));
    // Another origin and clockwise corners give the same prism.
    let other = read("{prism: {corners: [[1, 1], [1, 1.06], [1.09, 1]], height: 0.05}}", "", "");
    for (a, b) in base(&plain).corners().iter().zip(base(&other).corners()) {
        assert!((a - b).norm() < 1e-12);
    }
    let shape = "{prism: {corners: [[0, 0], [0.09, 0], [0, 0.06]], height: 0.05, \
                 centre_of_mass: [0.02, 0.02]}}";
    let support = "\n      support: {points: [[0.01, 0.01], [0.06, 0.01], [0.01, 0.04]]}";
    let loaded = read(shape, support, "");
    let centre = Vector::new(0.02, 0.02);
    assert_eq!(base(&loaded), ConvexPolygon::balanced(&corners, centre).unwrap());
    // Support points are in the frame of the corners.
    let points = [[0.01, 0.01], [0.06, 0.01], [0.01, 0.04]];
    let points = points.map(|[x, y]| Vector::new(x, y) - centre).to_vec();
    assert_eq!(loaded.scene.objects[0].support, Support::Points(points));
}

#[test]
fn invalid_prisms_are_refused_at_the_wrong_corner() {
    let prism = |corners: &str| format!("{{prism: {{corners: [{corners}], height: 0.05}}}}");
    let of = |corners: &str| task(&prism(corners), "", "");
    refused(
        &of("[0, 0], [0.1, 0]"),
        "[[0, 0]",
        "expected a list of 3 to 8 corners, found a list of 2 items",
    );
    let nine = "[0, 0], [1, 0], [2, 0.1], [3, 0.3], [4, 0.6], [4, 1], [3, 2], [2, 2], [1, 2]";
    refused(&of(nine), "[[0, 0]", "expected a list of 3 to 8 corners, found a list of 9 items");
    refused(
        &of("[0, 0], [0.1, 0], [0.1, 0.1], [0.05, 0.03], [0, 0.1]"),
        "[0.05, 0.03]",
        "the outline turns inwards at corner 4",
    );
    refused(
        &of("[0, 0.1], [0.05, 0.03], [0.1, 0.1], [0.1, 0], [0, 0]"),
        "[0.05, 0.03]",
        "the outline turns inwards at corner 2",
    );
    refused(
        &of("[0, 0], [0.05, 0.0001], [0.1, 0], [0, 0.1]"),
        "[0.05, 0.0001]",
        "corner 2 lies on the line between its neighbours",
    );
    refused(
        &of("[0, 0], [0.1, 0], [0.1003, 0], [0, 0.1]"),
        "[0.1003, 0]",
        "corner 3 lies on another one",
    );
    refused(
        &of("[0.1, 0], [-0.081, 0.059], [0.031, -0.095], [0.031, 0.095], [-0.081, -0.059]"),
        "[[0.1, 0]",
        "the outline crosses itself",
    );
    refused(
        &of("[0, 0], [0.1, 0], [0.05, 0.00095]"),
        "[[0, 0]",
        "the polygon is thinner than 1 mm or larger than 10 m",
    );
    let shape = "{prism: {corners: [[0, 0], [0.1, 0], [0, 0.1]], height: 0.05, \
                 centre_of_mass: [0.06, 0.06]}}";
    refused(
        &task(shape, "", ""),
        "[0.06, 0.06]",
        "the centre of mass does not lie within the outline",
    );
    let part = "
name: tee
friction: 0.4
parts:
  - {name: head, shape: {prism: {corners: [[0, 0], [0.1, 0.1], [0.05, 0], [0.1, -0.1]], height: 0.05}}, position: [0, 0]}
";
    let message = Tool::parse(part, "t.yaml").unwrap_err().to_string();
    assert!(
        message.contains("t.yaml:5:64: error: the outline turns inwards at corner 3"),
        "{message}"
    );
    Tool::parse(&part.replace("[0.05, 0]", "[0.12, 0]"), "t.yaml").unwrap();
}

#[test]
fn symmetric_headings_are_equivalent_unless_the_goal_excludes_it() {
    let heading = ", heading_deg: 30, heading_tolerance_deg: 5";
    let alike = |shape: &str, more: &str| {
        read(shape, "", &format!("{heading}{more}")).goals[0].heading().unwrap().symmetry
    };
    let square = "{cuboid: {size: [0.08, 0.08, 0.05]}}";
    assert_eq!(alike(square, ""), 4);
    assert_eq!(alike(square, ", symmetric: true"), 4);
    assert_eq!(alike(square, ", symmetric: false"), 1);
    assert_eq!(alike("{cuboid: {size: [0.08, 0.05, 0.05]}}", ""), 2);
    // In whole millimetres: a hexagon of 5 cm up to rounding, and an irregular one.
    let hexagon = "{prism: {corners: [[0.05, 0], [0.025, 0.043], [-0.025, 0.043], [-0.05, 0], \
                   [-0.025, -0.043], [0.025, -0.043]], height: 0.05}}";
    assert_eq!(alike(hexagon, ""), 6);
    assert_eq!(alike(&hexagon.replace("0.05,", "0.06,"), ""), 2);
    assert_eq!(alike("{prism: {corners: [[0, 0], [0.09, 0], [0, 0.06]], height: 0.05}}", ""), 1);
    let text = task(square, "", ", symmetric: false");
    refused(&text, "false", "`symmetric` without a heading");
}
