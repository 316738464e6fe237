//! Keys of an object, one entry each. A new property of objects needs an entry here and a field of
//! [`Object`].

use serde_json::{Value as Json, json};

use crate::asset::field::{Field, faults, keys, read, set, write};
use crate::asset::node::Node;
use crate::asset::put::{self, drawn};
use crate::asset::shapes::{PLACED_SHAPE, SHAPE, placed, shape};
use crate::asset::spec::{ANGLE, FORCE, FRICTION, Key, MASS, POSITION, Range, Value, numbers};
use crate::asset::take::name_of;
use crate::geometry::Shape;
use crate::scene::{Object, Scene, Whole};

use super::part::PARTS;
use super::support::{self, OBJECT_SUPPORT};

/// Key of an object's name.
pub(in crate::asset) const OBJECT_NAME: Key =
    Key::required("name", Value::Name, "The object's name, unique in the scene.");

/// Key of an object's shape.
pub(in crate::asset) const OBJECT_SHAPE: Key =
    Key::required("shape", SHAPE, "The object's solid, which stands upright.");

/// Key of the free height for a blade below an object.
const CLEARANCE: Key = Key::optional(
    "clearance",
    HEIGHT,
    "Free height below the underside at its edge, metres: room for a blade. An object whose `z` \
     equals this height stands on feet at its corners; default `z`.",
);

/// Key of an object's height above the table.
const Z: Key = Key::optional(
    "z",
    HEIGHT,
    "Height of the underside above the table, metres; default `clearance`, or 0 without one. An \
     object that lies higher than its clearance needs obstacles below it. Only tasks with \
     lever-ups may state it; in tasks of pushes only, objects stand on the table.",
);

const HEIGHT: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 1.0,
    advice: "6 mm is 0.006",
});

const SHARE: Value = Value::Number(Range {
    what: "a colour component",
    low: 0.0,
    high: 1.0,
    advice: "white is [1, 1, 1], red is [1, 0, 0]",
});

/// Specification of an object in a task file.
pub(super) const OBJECT: Value = Value::Map(&KEYS);

static KEYS: [Key; FIELDS.len()] = keys(&FIELDS);

const FIELDS: [Field<Object>; 13] = [
    Field {
        key: OBJECT_NAME,
        read: |_, node, object| set(&mut object.name, node.text().map(str::to_owned)),
        write: |object| Some(json!(object.name)),
        fault: |_| None,
    },
    Field {
        key: Key::required("shape", PLACED_SHAPE, "The object's solid, which stands upright."),
        read: |_, node, object| set(&mut object.shape, shape(node)),
        write: |object| {
            Some(if object.in_space() { drawn(&object.shape) } else { put::shape(&object.shape) })
        },
        fault: |object| {
            let footprint = object.shape.footprint();
            let sound = footprint.area() > 0.0
                && object.shape.height() > 0.0
                && footprint.bounding_radius().is_finite();
            (!sound).then_some("needs a positive finite size")
        },
    },
    // Parts are separate objects of the scene, which reads and writes them.
    Field { key: PARTS, read: |_, _, _| Some(()), write: |_| None, fault: |_| None },
    Field {
        key: Key::required("mass", MASS, "Mass in kg, including parts."),
        read: |_, node, object| set(&mut object.mass, node.number()),
        write: |object| Some(json!(object.mass)),
        fault: |object| positive(object.mass),
    },
    Field {
        key: Key::required(
            "friction",
            FRICTION,
            "Friction value; the coefficient of a pair is the mean of the two values.",
        ),
        read: |_, node, object| set(&mut object.friction, node.number()),
        write: |object| Some(json!(object.friction)),
        fault: |object| from_zero(object.friction),
    },
    Field {
        key: OBJECT_SUPPORT,
        // Points are written in the frame of the solid's corners.
        read: |map, _, object| set(&mut object.support, support::support(map)),
        write: |object| Some(support::emitted(&object.support)),
        fault: |_| None,
    },
    Field {
        key: Key::optional(
            "may_fall",
            Value::Switch,
            "Whether the object may topple or fall off the table; default false.",
        ),
        read: |_, node, object| set(&mut object.may_fall, node.switch()),
        write: |object| object.may_fall.then_some(Json::Bool(true)),
        fault: |_| None,
    },
    Field {
        key: Key::optional(
            "max_force",
            FORCE,
            "Largest force in newtons with which a tool may press on the object, including its \
             parts, for longer than an impact; by default any.",
        ),
        read: |_, node, object| set(&mut object.max_force, node.number().map(Some)),
        write: |object| object.max_force.map(|force| json!(force)),
        fault: |object| object.max_force.and_then(positive),
    },
    Field {
        key: Key::optional(
            "color",
            numbers(&SHARE, 3),
            "Red, green and blue, each from 0 to 1, for simulators and viewers; by default chosen \
             by them.",
        ),
        read: |_, node, object| {
            let [red, green, blue] = node.items() else { return None };
            object.color = Some([red.number()?, green.number()?, blue.number()?]);
            Some(())
        },
        write: |object| object.color.map(|color| json!(color)),
        fault: |object| {
            let inside = |share: &f64| (0.0..=1.0).contains(share);
            (!object.color.iter().flatten().all(inside))
                .then_some("must contain numbers from 0 to 1")
        },
    },
    Field {
        key: CLEARANCE,
        read: |_, node, object| set(&mut object.clearance, node.number()),
        write: |object| object.in_space().then(|| json!(object.clearance)),
        fault: |object| from_zero(object.clearance),
    },
    Field {
        key: Z,
        read: |_, node, object| set(&mut object.z, node.number()),
        write: |object| object.in_space().then(|| json!(object.z)),
        fault: |object| from_zero(object.z),
    },
    Field {
        key: Key::required("position", POSITION, "Centre at the start, [x, y] in metres."),
        read: |map, _, object| set(&mut object.pose, placed(map)),
        write: |object| Some(json!([object.pose.position.x, object.pose.position.y])),
        fault: |object| (!object.pose.is_finite()).then_some("must be finite"),
    },
    Field {
        key: Key::optional("yaw_deg", ANGLE, "Heading at the start, degrees; default 0."),
        // Read together with the position, because the reference point of the position rotates with
        // the object.
        read: |_, _, _| Some(()),
        write: |object| Some(json!(put::degrees(object.pose.heading))),
        fault: |_| None,
    },
];

/// Reads an object without its parts.
pub(super) fn object(node: &Node) -> Option<Object> {
    read(&FIELDS, node, Object::new(name_of(node)?, Shape::Cuboid { size: [0.0; 3] }))
}

/// Returns an object without its parts as in a task file.
pub(in crate::asset) fn emitted_object(object: &Object) -> serde_json::Value {
    write(&FIELDS, object)
}

impl Scene {
    /// Returns the values of objects that cannot be used in computations, each by its key path in a
    /// task file, with a message. Only values set in code can be faulty.
    pub fn object_faults(&self) -> Vec<(String, &'static str)> {
        let path = |index: usize| match self.objects[index].whole {
            Some(Whole { object, .. }) => {
                let before = self.parts_of(object).take_while(|part| *part < index).count();
                format!("scene.objects[{object}].parts[{before}]")
            }
            None => format!("scene.objects[{index}]"),
        };
        let each = self.objects.iter().enumerate().flat_map(|(index, object)| {
            faults(&FIELDS, object).map(move |(key, message)| (index, key, message))
        });
        each.map(|(index, key, message)| (format!("{}.{key}", path(index)), message)).collect()
    }
}

fn positive(value: f64) -> Option<&'static str> {
    (!(value.is_finite() && value > 0.0)).then_some("must be a positive finite number")
}

fn from_zero(value: f64) -> Option<&'static str> {
    (!(value.is_finite() && value >= 0.0)).then_some("must be finite and not negative")
}
