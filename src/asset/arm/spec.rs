//! Keys of a robot that is an arm.

use crate::asset::spec::{ANGLE, COORDINATE, Key, POSITION, Range, SIZE, Value};
use crate::scene::MAX_JOINTS;

/// Words for the axes of a frame.
pub(super) const AXES: [&str; 6] = ["x", "y", "z", "-x", "-y", "-z"];

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
    "With `urdf`: the link on which the tool is mounted, such as `panda_link8` or `tool0`; its z \
     axis points out of it unless `tool_mount` states another `axis`. Links attached to it in the \
     file are ignored. No default.",
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
            "Rotation of the tool about that axis, degrees; default 0.",
        ),
        Key::optional(
            "axis",
            Value::Word(&AXES),
            "Axis of the flange's frame that points out of it, towards the tool: `x`, `-x`, `y`, \
             `-y`, `z` or `-z`; default `z`.",
        ),
    ]),
    "With `urdf`: how the tool is mounted on the flange; by default 0.15 m below it.",
);

pub(in crate::asset) const ARM: Key = Key::optional(
    "arm",
    Value::Anything,
    "The arm as stored in plan files, instead of `urdf`; by default none.",
);

const HEIGHT: Key = Key::optional(
    "height",
    COORDINATE,
    "Height of the arm's root above the table, metres; default 0.",
);

const YAW: Key =
    Key::optional("yaw_deg", ANGLE, "Rotation of the arm about the vertical, degrees; default 0.");

pub(in crate::asset) const BASE: Key = Key::optional(
    "base",
    Value::Either(&[Value::Word(&["none"]), SIZE, Value::Map(&[HEIGHT, YAW])]),
    "Half the side in metres of the square column at the origin that carries the arm, or `none`. \
     By default 0.08, or 0.06 less than a stated `reach.min` if that is less, but at least 0.04; \
     none for lever-ups. With `urdf`, the former name of `base_pose`.",
);

pub(in crate::asset) const BASE_POSE: Key = Key::optional(
    "base_pose",
    Value::Map(&[
        Key::optional(
            "position",
            POSITION,
            "Position [x, y] of the arm's root, metres; default [0, 0].",
        ),
        HEIGHT,
        YAW,
    ]),
    "With `urdf`: where the arm stands; by default at the origin, on the table.",
);

pub(in crate::asset) const JOINT_LIMITS: Key = Key::optional(
    "joint_limits",
    Value::Map(&[
        Key::optional(
            "acceleration",
            Value::Either(&[ACCELERATION, rates(&ACCELERATION)]),
            "Maximum acceleration of the joints, rad/s^2 (m/s^2 for prismatic joints): one number \
             for all, or a list with one for each. By default from the URDF, or 10 (1).",
        ),
        Key::optional(
            "jerk",
            Value::Either(&[JERK, rates(&JERK)]),
            "Maximum jerk of the joints, rad/s^3 (m/s^3): one number or a list. By default from \
             the URDF, or 200 (20).",
        ),
    ]),
    "With `urdf`: limits of the joints that URDFs rarely state; defaults as described.",
);

const ACCELERATION: Value = Value::Number(Range {
    what: "an acceleration in rad/s^2 or m/s^2",
    low: 0.01,
    high: 1e4,
    advice: "arms allow about 2 to 20 rad/s^2",
});

const JERK: Value = Value::Number(Range {
    what: "a jerk in rad/s^3 or m/s^3",
    low: 0.01,
    high: 1e6,
    advice: "arms allow about 100 to 10000 rad/s^3",
});

const fn rates(of: &'static Value) -> Value {
    Value::List { of, items: "numbers", min: 1, max: MAX_JOINTS }
}

pub(in crate::asset) const HOME: Key = Key::optional(
    "home",
    Value::List { of: &COORDINATE, items: "numbers", min: 1, max: MAX_JOINTS },
    "Start of chained pushes, [x, y] in metres; by default the nearest point of the reach in \
     front of the base. With `urdf`, the joint positions at which plans begin, radians (metres for \
     prismatic joints); by default above the middle of the arm's reach.",
);
