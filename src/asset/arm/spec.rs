//! Keys of a robot that is an arm.

use crate::asset::spec::{ANGLE, COORDINATE, Key, Range, SIZE, Value};
use crate::scene::MAX_JOINTS;

pub(in crate::asset) const URDF: Key = Key::optional(
    "urdf",
    Value::Text,
    "A URDF file of the arm, relative to this file. The arm then defines reach, hand and base, \
     plans contain its joint motion, and plans that it cannot execute are rejected. By default the \
     robot is an end effector within a reach.",
);

pub(in crate::asset) const FLANGE: Key = Key::optional(
    "flange",
    Value::Text,
    "With `urdf`: the link on which the tool is mounted, its z axis pointing out of it, such as \
     `panda_link8` or `tool0`; links attached to it in the file are ignored. No default.",
);

pub(in crate::asset) const TOOL_MOUNT: Key = Key::optional(
    "tool_mount",
    Value::Map(&[
        Key::optional(
            "length",
            Value::Number(Range {
                what: "a length in metres",
                low: 0.0,
                high: 2.0,
                advice: "a gripper that holds a tool is about 0.15 m long",
            }),
            "From the flange to the tool's underside, metres, at least the height of the tool; \
             default 0.15.",
        ),
        Key::optional(
            "yaw_deg",
            ANGLE,
            "Rotation of the tool about the flange's z axis, degrees; default 0.",
        ),
    ]),
    "With `urdf`: how the tool is mounted on the flange; by default 0.15 m below it.",
);

pub(in crate::asset) const ARM: Key = Key::optional(
    "arm",
    Value::Anything,
    "The arm as stored in plan files, instead of `urdf`; by default none.",
);

pub(in crate::asset) const BASE: Key = Key::optional(
    "base",
    Value::Either(&[
        Value::Word(&["none"]),
        SIZE,
        Value::Map(&[
            Key::optional(
                "height",
                COORDINATE,
                "Height of the arm's root above the table, metres; default 0.",
            ),
            Key::optional(
                "yaw_deg",
                ANGLE,
                "Rotation of the arm about the vertical, degrees; default 0.",
            ),
        ]),
    ]),
    "Half the side in metres of the square column at the origin that carries the arm, or `none`. \
     By default 0.08, or 0.06 less than a stated `reach.min` if that is less, but at least 0.04; \
     none for lever-ups. With `urdf`, how the arm is mounted at the origin: `height` and \
     `yaw_deg`.",
);

pub(in crate::asset) const HOME: Key = Key::optional(
    "home",
    Value::List { of: &COORDINATE, items: "numbers", min: 1, max: MAX_JOINTS },
    "Start of chained pushes, [x, y] in metres; by default the nearest point of the reach in \
     front of the base. With `urdf`, the joint positions at which plans begin, radians (metres for \
     prismatic joints); by default above the middle of the arm's reach.",
);
