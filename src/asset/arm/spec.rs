//! Keys of a robot that is an arm.

use crate::asset::spec::{ANGLE, COORDINATE, Key, Range, SIZE, Value};
use crate::scene::MAX_JOINTS;

pub(in crate::asset) const URDF: Key = Key::optional(
    "urdf",
    Value::Text,
    "A URDF file of the arm, as seen from this file; then reach, hand and base are the arm's own, \
     plans carry the motion of its joints, and what it cannot do is no plan. By default the robot is a \
     hand within a reach.",
);

pub(in crate::asset) const FLANGE: Key = Key::optional(
    "flange",
    Value::Text,
    "With `urdf`: the link on which the tool is mounted, its z axis pointing out of it, such as \
     `panda_link8` or `tool0`; what hangs on it in the file is left out. No default.",
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
            "From the flange to the tool's underside, metres; default 0.15.",
        ),
        Key::optional(
            "yaw_deg",
            ANGLE,
            "Turn of the tool about the flange's z axis, degrees; default 0.",
        ),
    ]),
    "With `urdf`: how the tool hangs on the flange; by default 0.15 m below it.",
);

pub(in crate::asset) const ARM: Key = Key::optional(
    "arm",
    Value::Anything,
    "The arm as plan files hold it, instead of `urdf`; by default none.",
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
                "Height of the arm's root over the table, metres; default 0.",
            ),
            Key::optional("yaw_deg", ANGLE, "Turn of the arm about the vertical; default 0."),
        ]),
    ]),
    "Half the side in metres of the square column at the origin on which the arm stands, or \
     `none`; by default 0.08, or as much less as the hand comes nearer: 0.06 less than the \
     smallest reach. With `urdf` how the arm stands at the origin: `height` and `yaw_deg`.",
);

pub(in crate::asset) const HOME: Key = Key::optional(
    "home",
    Value::List { of: &COORDINATE, items: "numbers", min: 1, max: MAX_JOINTS },
    "Where chained pushes start, [x, y] in metres; by default the nearest point of the reach \
     in front of the base. With `urdf` the joint positions at which plans begin, radians (metres of \
     joints that slide); by default above the middle of what the arm reaches.",
);
