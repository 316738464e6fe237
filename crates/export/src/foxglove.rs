//! Messages in the JSON schemas of Foxglove, which similar viewers also draw.
//!
//! Messages contain all fields of `foxglove.SceneUpdate` and `foxglove.FrameTransforms`; see
//! <https://docs.foxglove.dev/docs/sdk/schemas> for their names and meanings.

use serde_json::{Value as Json, json};

use pushplan::geometry::{ConvexPolygon, Pose, Pose3, Shape};

/// Red, green, blue and opacity, 0 to 1.
pub(super) type Colour = [f64; 4];

/// Returns a time as whole seconds and the rest in nanoseconds.
pub(super) fn time(nanoseconds: u64) -> Json {
    json!({"sec": nanoseconds / 1_000_000_000, "nsec": nanoseconds % 1_000_000_000})
}

/// Returns the quaternion of a rotation about the vertical.
fn quaternion(heading: f64) -> Json {
    let (z, w) = (heading / 2.0).sin_cos();
    json!({"x": 0.0, "y": 0.0, "z": z, "w": w})
}

fn vector([x, y, z]: [f64; 3]) -> Json {
    json!({"x": x, "y": y, "z": z})
}

/// Returns a pose at a height, metres.
fn pose(pose: &Pose, height: f64) -> Json {
    let position = [pose.position.x, pose.position.y, height];
    json!({"position": vector(position), "orientation": quaternion(pose.heading)})
}

/// Returns a `foxglove.FrameTransform`: the pose of a frame in the table frame; heights in metres.
pub(super) fn transform(at: u64, child: &str, frame: &Pose, height: f64) -> Json {
    json!({
        "timestamp": time(at),
        "parent_frame_id": TABLE,
        "child_frame_id": child,
        "translation": vector([frame.position.x, frame.position.y, height]),
        "rotation": quaternion(frame.heading),
    })
}

/// Returns a `foxglove.FrameTransform` of a 3-D pose.
pub(super) fn transform_3d(at: u64, child: &str, frame: &Pose3) -> Json {
    let [x, y, z, w] = frame.quaternion();
    json!({
        "timestamp": time(at),
        "parent_frame_id": TABLE,
        "child_frame_id": child,
        "translation": vector(frame.position.into()),
        "rotation": {"x": x, "y": y, "z": z, "w": w},
    })
}

/// Root frame: the table's top, with x ahead of the robot.
pub(super) const TABLE: &str = "table";

/// Returns a `foxglove.SceneEntity`: solids in a frame, each with its pose there and the height of
/// its middle, metres.
pub(super) fn entity(frame: &str, id: &str, solids: &[(Shape, Pose, f64)], colour: Colour) -> Json {
    let [r, g, b, a] = colour;
    let colour = json!({"r": r, "g": g, "b": b, "a": a});
    let (mut cubes, mut cylinders, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    for (shape, place, height) in solids {
        let pose = pose(place, *height);
        match shape {
            Shape::Cuboid { size } => {
                cubes.push(json!({"pose": pose, "size": vector(*size), "color": colour}));
            }
            Shape::Cylinder { radius, height } => cylinders.push(json!({
                "pose": pose,
                "size": vector([2.0 * radius, 2.0 * radius, *height]),
                "bottom_scale": 1.0,
                "top_scale": 1.0,
                "color": colour,
            })),
            Shape::Prism { base, height } => {
                let (points, indices) = faces(base, *height);
                triangles.push(json!({
                    "pose": pose, "points": points, "color": colour, "colors": [],
                    "indices": indices,
                }));
            }
        }
    }
    json!({
        "timestamp": time(0),
        "frame_id": frame,
        "id": id,
        "lifetime": time(0),
        "frame_locked": true,
        "metadata": [],
        "arrows": [],
        "cubes": cubes,
        "spheres": [],
        "cylinders": cylinders,
        "lines": [],
        "triangles": triangles,
        "texts": [],
        "models": [],
    })
}

/// Returns the corners of a prism about its middle, and the triangles between them.
fn faces(base: &ConvexPolygon, height: f64) -> (Vec<Json>, Vec<usize>) {
    let ring = |z: f64| base.corners().iter().map(move |at| vector([at.x, at.y, z]));
    let points: Vec<Json> = ring(-height / 2.0).chain(ring(height / 2.0)).collect();
    let count = base.corners().len();
    let mut indices = Vec::new();
    for k in 1..count - 1 {
        // Corners are counter-clockwise from outside.
        indices.extend([0, k + 1, k, count, count + k, count + k + 1]);
    }
    for k in 0..count {
        let next = (k + 1) % count;
        indices.extend([k, next, count + next, k, count + next, count + k]);
    }
    (points, indices)
}

/// Returns the JSON schema of `foxglove.FrameTransforms`.
pub(super) fn transforms_schema() -> Json {
    let one = object(json!({
        "timestamp": a_time(),
        "parent_frame_id": {"type": "string"},
        "child_frame_id": {"type": "string"},
        "translation": three(),
        "rotation": turn(),
    }));
    titled("foxglove.FrameTransforms", object(json!({"transforms": list(one)})))
}

/// Returns the JSON schema of `foxglove.SceneUpdate`, with the solids that are used here.
pub(super) fn scene_schema() -> Json {
    let place = || object(json!({"position": three(), "orientation": turn()}));
    let colour = || {
        let share = json!({"type": "number"});
        object(json!({"r": share, "g": share, "b": share, "a": share}))
    };
    let number = json!({"type": "number"});
    let cube = object(json!({"pose": place(), "size": three(), "color": colour()}));
    let cylinder = object(json!({
        "pose": place(), "size": three(), "bottom_scale": number, "top_scale": number,
        "color": colour(),
    }));
    let triangles = object(json!({
        "pose": place(), "points": list(three()), "color": colour(), "colors": list(colour()),
        "indices": list(json!({"type": "integer", "minimum": 0})),
    }));
    let pair = object(json!({"key": {"type": "string"}, "value": {"type": "string"}}));
    let unused = || list(json!({"type": "object"}));
    let entity = object(json!({
        "timestamp": a_time(),
        "frame_id": {"type": "string"},
        "id": {"type": "string"},
        "lifetime": a_time(),
        "frame_locked": {"type": "boolean"},
        "metadata": list(pair),
        "arrows": unused(),
        "cubes": list(cube),
        "spheres": unused(),
        "cylinders": list(cylinder),
        "lines": unused(),
        "triangles": list(triangles),
        "texts": unused(),
        "models": unused(),
    }));
    let deletion = object(json!({
        "timestamp": a_time(), "type": {"type": "integer"}, "id": {"type": "string"},
    }));
    let fields = json!({"deletions": list(deletion), "entities": list(entity)});
    titled("foxglove.SceneUpdate", object(fields))
}

/// Returns the JSON schema of an object with these fields.
pub(super) fn object(fields: Json) -> Json {
    json!({"type": "object", "properties": fields})
}

/// Returns the JSON schema of a list.
pub(super) fn list(items: Json) -> Json {
    json!({"type": "array", "items": items})
}

/// Adds a title to a schema.
pub(super) fn titled(title: &str, mut schema: Json) -> Json {
    schema["title"] = json!(title);
    schema
}

fn a_time() -> Json {
    let fields = json!({
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999_999_999},
    });
    titled("time", object(fields))
}

fn three() -> Json {
    let number = json!({"type": "number"});
    object(json!({"x": number, "y": number, "z": number}))
}

fn turn() -> Json {
    let number = json!({"type": "number"});
    object(json!({"x": number, "y": number, "z": number, "w": number}))
}
