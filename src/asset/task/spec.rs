//! Specification of a task file.

use crate::asset::arm::{ARM, BASE, BASE_POSE, FLANGE, HOME, JOINT_LIMITS, TOOL_MOUNT, URDF};
use crate::asset::spec::{
    ANGLE, FORCE, FRICTION, Key, MOST_BODIES, POSITION, Range, SIZE, Value, numbers,
};

use super::frictions::FRICTIONS;
use super::goals::GOAL;
use super::joints::JOINT;
use super::keep::{KEEP, KEEP_OUT};
use super::levers::LEVERS;
use super::object::OBJECT;
use super::obstacles::OBSTACLES;
use super::tools::TOOLS;

/// Specification of a task file.
pub(in crate::asset) static TASK: Value = Value::Map(TASK_KEYS);

/// Keys of a task.
pub(in crate::asset) const TASK_KEYS: &[Key] = &[
    Key::optional("name", Value::Name, "The task's name; by default the file's."),
    Key::optional("description", Value::Text, "One line for people; by default empty."),
    Key::required("scene", SCENE, "The scene on the table."),
    UNKNOWN_KEY,
    Key::required("robot", ROBOT, "Limits of the robot."),
    TOOLS,
    LEVERS,
    Key::optional(
        "pushes",
        PUSHES,
        "The pushes that a plan may contain; every key has a default. In a task with lever-ups, \
         pushes come before or after the lever-up, and only if this key is given.",
    ),
    Key::required(
        "goal",
        Value::Either(&[GOAL, Value::List { of: &GOAL, items: "goals", min: 1, max: 8 }]),
        "Required final pose or state of an object; or a list of such goals, in any order, for \
         several objects.",
    ),
    KEEP,
    KEEP_OUT,
    ROBUSTNESS,
];

/// Key of the share of replays in which a plan must succeed.
const ROBUSTNESS: Key = Key::optional(
    "robustness",
    Value::Number(Range {
        what: "a share",
        low: 0.0,
        high: 1.0,
        advice: "three quarters are 0.75",
    }),
    "Share of the perturbed replays (small errors of starts and frictions) that must reach the \
     goal for a plan to pass; default 0.75.",
);

/// Key of the unknown properties of a scene.
const UNKNOWN_KEY: Key = Key::optional("unknown", UNKNOWN, UNKNOWN_MEANING);

const UNKNOWN: Value = Value::List {
    of: &Value::Word(&["joints", "masses", "frictions", "support"]),
    items: "words",
    min: 0,
    max: 4,
};

const UNKNOWN_MEANING: &str = "Properties of the scene that are unknown, so that `pushplan run` \
    has to estimate them by pushing. `joints`: any two objects with a gap below 30 mm may be \
    joined, and the scene states no joints. `masses`: within a factor of 2 of the stated value, \
    nine times in ten. `frictions`, of objects and table: within a factor of 1.5. `support`: \
    anything from even pressure to the corners. Stated values are the middle of the range, with \
    which `pushplan solve` plans; by default nothing is unknown.";

const SCENE: Value = Value::Map(&[
    TABLE,
    PUSH_HEIGHT,
    Key::required(
        "objects",
        Value::List { of: &OBJECT, items: "objects", min: 1, max: MOST_BODIES },
        "The movable objects.",
    ),
    Key::optional("joints", JOINTS, "Joints between objects; by default none."),
    OBSTACLES,
    FRICTIONS,
]);

/// Key of the height at which tools press.
pub(in crate::asset) const PUSH_HEIGHT: Key = Key::optional(
    "push_height",
    Value::Number(Range {
        what: "a share",
        low: 0.0,
        high: 1.0,
        advice: "a fingertip at half the height of the middle is 0.5",
    }),
    "Height at which the tool presses on objects, relative to the mean height of the contacting \
     faces: 0 at the table, 1 in the middle. With a larger height more of the object's weight \
     moves to its front. By default unknown, like the contact of two flat faces.",
);

/// Key of the table.
pub(in crate::asset) const TABLE: Key = Key::optional(
    "table",
    Value::Map(&[
        Key::optional("friction", FRICTION, "Friction value of the table top; default 0.5."),
        Key::optional(
            "size",
            numbers(&SIZE, 2),
            "Size [x, y] of the table top in metres; by default unlimited. An object whose centre \
             leaves it has fallen off.",
        ),
        Key::optional(
            "position",
            POSITION,
            "Middle of a table top with a size, [x, y] in metres; default [0, 0], the robot's \
             base.",
        ),
    ]),
    "The table; by default unlimited, with friction 0.5.",
);

/// Specification of the joints of a scene.
pub(in crate::asset) const JOINTS: Value =
    Value::List { of: &JOINT, items: "joints", min: 0, max: MOST_BODIES };

const ROBOT: Value = Value::Map(&[
    HOME,
    Key::optional(
        REACH_KEY.name,
        REACH_KEY.value,
        "Range of distances of the end effector from the base, which is the origin; no default, \
         except with `urdf`, which defines it.",
    ),
    URDF,
    FLANGE,
    TOOL_MOUNT,
    ARM,
    MAX_FORCE,
    Key::optional(
        "hand",
        Value::Either(&[
            Value::Word(&["none"]),
            Value::Map(&[
                Key::optional("radius", SIZE, "Its radius in metres; default 0.05."),
                Key::optional(
                    "from",
                    SIZE,
                    "Height of its lower end above the table, metres; by default the height of the \
                     tool's upper end at the grip, but at least 0.12.",
                ),
            ]),
        ]),
        "The hand about the end effector: an upright cylinder that must not touch bodies at its \
         height, or `none`; by default a usual gripper. Behind a blade, the hand is fingers, which \
         need 2 cm on both sides of the shaft.",
    ),
    BASE,
    BASE_POSE,
    JOINT_LIMITS,
    Key::optional(
        "travel",
        SIZE,
        "Height above the table at which the tool's underside travels between pushes, from and to \
         home, metres; the tool bypasses taller bodies. Default 0.3.",
    ),
]);

/// Key of the maximum force of the arm.
const MAX_FORCE: Key = Key::optional(
    "max_force",
    FORCE,
    "Largest force in newtons that the arm can sustain; impacts are not limited. By default any, \
     with a warning above 150.",
);

/// Key of the reach of the end effector.
pub(super) const REACH_KEY: Key = Key::required(
    "reach",
    Value::Map(&[
        Key::optional(
            "min",
            REACH,
            "Smallest distance from the base, metres; by default what base and hand need, 0.14.",
        ),
        Key::required("max", REACH, "Largest distance from the base, metres."),
    ]),
    "Range of distances of the end effector from the base, which is the origin.",
);

const REACH: Value = Value::Number(Range {
    what: "a reach in metres",
    low: 0.0,
    high: 10.0,
    advice: "reach is measured from the base at the origin, in metres",
});

/// Specification of the pushes that a plan may contain.
const PUSHES: Value = Value::Map(&[
    Key::optional(
        "form",
        Value::Word(&["placed", "chained"]),
        "`placed`: each push has its own best start; the tool is lowered to it, and after the push \
         it retreats by 5 mm and is lifted. `chained`: the first push starts at `home`, and each \
         further push continues from the end of the previous one. Default placed.",
    ),
    Key::optional(
        "directions",
        Value::Either(&[
            Value::Word(&["principal"]),
            Value::Count(Range {
                what: "a number of directions",
                low: 1.0,
                high: 64.0,
                advice: "8 or 16 directions are usual",
            }),
            Value::List { of: &ANGLE, items: "angles in degrees", min: 1, max: 64 },
        ]),
        "Directions of pushes in the world frame: `principal` (+x, -x, +y, -y), a number of \
         equally spaced directions, or a list in degrees; default principal.",
    ),
    Key::optional(
        "offsets",
        Value::List { of: &OFFSET, items: "offsets", min: 1, max: 64 },
        "Signed distances in metres of the object's centre from the centre line of the contacting \
         face, positive to the left of the direction (placed pushes only); by default chosen by \
         the planner.",
    ),
    Key::optional(
        "grip_yaws_deg",
        Value::List { of: &ANGLE, items: "angles in degrees", min: 1, max: 16 },
        "Rotations of the end effector against world +x, degrees; default 0, 90, -90. A plan uses \
         one of them unless it needs several.",
    ),
    Key::optional(
        "length",
        LENGTH,
        "Length of a push in metres, which planning may shorten or lengthen by half; default 0.20.",
    ),
    Key::optional("speed", SPEED, "Speed of a push in m/s; default 0.10."),
    Key::optional(
        "max_count",
        MAX_COUNT,
        "Maximum number of pushes in a plan; default 3. More pushes are tried only if fewer do not \
         suffice.",
    ),
    Key::optional(
        "tool_changes",
        TOOL_CHANGES,
        "Maximum number of tool changes in a plan of placed pushes; by default any. Plans with \
         tool changes are tried only if no single tool suffices.",
    ),
    Key::optional(
        "lift",
        LIFT,
        "Height of the tool's underside above the table in metres; default 0.002.",
    ),
]);

const OFFSET: Value = Value::Number(Range {
    what: "an offset in metres",
    low: -1.0,
    high: 1.0,
    advice: "offsets are in metres: 20 mm is 0.02",
});

const LENGTH: Value = Value::Number(Range {
    what: "a length in metres",
    low: 0.01,
    high: 2.0,
    advice: "20 cm is 0.20; longer distances take several pushes, see `max_count`",
});

const SPEED: Value = Value::Number(Range {
    what: "a speed in m/s",
    low: 0.01,
    high: 1.0,
    advice: "10 cm/s is 0.10",
});

const TOOL_CHANGES: Value = Value::Count(Range {
    what: "a number of changes",
    low: 0.0,
    high: 64.0,
    advice: "0 allows a single tool per plan",
});

const MAX_COUNT: Value = Value::Count(Range {
    what: "a number of pushes",
    low: 1.0,
    high: 64.0,
    advice: "three pushes move an object around a corner",
});

/// Height of a tool's underside above the table.
pub(in crate::asset) const LIFT: Value = Value::Number(Range {
    what: "a height in metres",
    low: 0.0,
    high: 1.0,
    advice: "2 mm is 0.002",
});
