//! Bodies, joints and tables in MJCF files.

use super::{As::Objects as O, BOX, Row, edited, free, mjcf};

#[test]
fn bodies_and_joints_of_mjcf_follow_the_advice() {
    let pair = |joint: &str| {
        free(&format!("{BOX}<body name='c' pos='.2 0 0'><joint {joint}/>{BOX}</body>"))
    };
    let feet = |last: &str| {
        let foot = |at: &str| format!("<geom type='sphere' size='.005' mass='0' pos='{at}'/>");
        let box_ = "<geom type='box' size='.05 .04 .045' pos='0 0 .005'/>";
        free(&format!("{box_}{}{}{last}", foot(".04 0 -.045"), foot("-.03 .03 -.045")))
    };
    let foot = "<geom type='sphere' size='.005' mass='0' pos='-.03 -.03 -.045'/>";
    let second = |at: &str| {
        free(BOX).replace(
            "</worldbody>",
            &format!("<body name='c' pos='{at}'><freejoint/>{BOX}</body></worldbody>"),
        )
    };
    let plane = "<geom type='plane' size='1 1 1'/>";
    let box_at = |at: &str, size: &str| format!("<geom type='box' size='{size}' pos='{at}'/>");
    let tables = box_at(".7 0 -.1", ".5 .3 .1") + &box_at(".8 0 -.1", ".4 .2 .1");
    let double = second(".9 0 .05").replace(plane, &tables);
    let beside = second(".9 0 .05").replace(plane, &box_at(".5 0 -.1", ".1 .1 .1"));
    let contradicting = second(".9 0 .05").replace("<geom type='box'", "<geom name='g' type='box'");
    let contradicting = contradicting.replacen("name='g'", "name='f'", 1).replace(
        "</mujoco>",
        "<contact><pair geom1='f' geom2='g' friction='.3'/><pair geom1='f' geom2='g' friction='.4'/></contact></mujoco>",
    );
    let leaning = "<geom name='bar' type='box' size='.3 .02 .02' pos='.5 0 .3' euler='0 45 0'/>";
    let rows: &[Row<'_>] = &[
        (
            pair("stiffness='3'"),
            "remove it; pushplan's joints have no springs",
            &[(" stiffness='3'", "")],
        ),
        (pair("axis='0 0 0'"), "write an axis such as `0 0 1`", &[("'0 0 0'/", "'0 0 1'/")]),
        (
            pair("axis='0 1 0'"),
            "rotate about the vertical, or slide along the table",
            &[("'0 1 0'", "'0 0 1'")],
        ),
        (
            pair("axis='0 1 0'"),
            "rotate about the vertical, or slide along the table",
            &[("axis='0 1 0'", "type='slide' axis='0 1 0'")],
        ),
        (
            pair("axis='0 1 0'"),
            "joints between objects must be fixed",
            &[("<joint axis='0 1 0'/>", "")],
        ),
        (
            mjcf(&format!("<body name='b' pos='.5 0 .05'><joint axis='0 1 0'/>{BOX}</body>")),
            "a <freejoint/>",
            &[("<joint axis='0 1 0'/>", "<freejoint/>")],
        ),
        (
            mjcf(""),
            "objects must be free (<freejoint/>",
            &[(
                "</worldbody>",
                "<body pos='.5 0 .05'><freejoint/><geom type='box' size='.05 .05 .05'/></body></worldbody>",
            )],
        ),
        (
            free(BOX).replace("</mujoco>", "<tendon><spatial/></tendon></mujoco>"),
            "remove it, or select bodies with --body",
            &[("<tendon><spatial/></tendon>", "")],
        ),
        (
            second(".9 0 .05").replace(
                "</mujoco>",
                "<equality><connect body1='b' body2='c'/></equality></mujoco>",
            ),
            "remove it, or select other bodies with --body",
            &[("<connect body1='b' body2='c'/>", "")],
        ),
        (
            second(".9 0 .05")
                .replace("</mujoco>", "<contact><exclude body1='b' body2='c'/></contact></mujoco>"),
            "remove the element, or select one of them with --body",
            &[("<exclude body1='b' body2='c'/>", "")],
        ),
        (second(".54 0 .05"), "move one of them", &[(".54 0", ".9 0")]),
        (
            free(&BOX.replace("/>", " contype='0' conaffinity='0'/>")),
            "give it a box, a cylinder or a mesh with collision",
            &[(" contype='0' conaffinity='0'", "")],
        ),
        (
            free(&BOX.replace("/>", " mass='0'/>")),
            "state its mass in kilograms (<inertial>)",
            &[("<geom type='box'", "<inertial mass='.3' pos='0 0 0'/><geom type='box'")],
        ),
        (
            free(&format!("{BOX}<geom type='sdf' contype='0' conaffinity='0'/>")),
            "state `mass`",
            &[("'sdf'", "'sdf' mass='.1'")],
        ),
        (
            free(&format!("{BOX}<geom type='sdf' contype='0' conaffinity='0'/>")),
            "add <inertial> to its body",
            &[("<geom type='box'", "<inertial mass='.3' pos='0 0 0'/><geom type='box'")],
        ),
        (
            feet(&foot.replace("-.045", "-.043")),
            "spheres must be the support points of a body",
            &[("-.043", "-.045")],
        ),
        (
            feet(""),
            "give it three to eight support points",
            &[("</body>", &format!("{foot}</body>"))],
        ),
        (
            free("<geom type='sphere' size='.05'/>"),
            "replace it by a box, an upright cylinder",
            &[("type='sphere' size='.05'", "type='box' size='.05 .05 .05'")],
        ),
        (
            free("<geom type='capsule' size='.03 .05'/>"),
            "replace it by a box, an upright cylinder",
            &[("capsule", "cylinder")],
        ),
        (
            free(&format!("{BOX}<geom type='plane' size='1 1 1'/>")),
            "disable its collision",
            &[(
                "<geom type='plane' size='1 1 1'/></body>",
                "<geom type='plane' size='1 1 1' contype='0' conaffinity='0'/></body>",
            )],
        ),
        (
            free(&BOX.replace("/>", " euler='0 20 0'/>")),
            "rotate it by multiples of 90 degrees",
            &[("'0 20 0'", "'0 90 0'")],
        ),
        (second(".9 0 1.05"), "lower it, or select other bodies with --body", &[("1.05", ".05")]),
        (free(BOX).replace(".5 0 .05", ".5 0 1.05"), "move them onto it", &[("1.05", ".05")]),
        (double.clone(), "make the table one box, or a plane", &[(&tables, plane)]),
        (
            double,
            "make the table one box, or a plane",
            &[(&tables, &box_at(".7 0 -.1", ".5 .3 .1"))],
        ),
        (
            beside,
            "move it onto the box that carries the other objects",
            &[(".9 0 .05", ".5 .085 .05")],
        ),
        (
            free(BOX).replace("'plane' size='1 1 1'", "'plane' size='1 1 1' euler='0 80 0'"),
            "replace it by a box; obstacles are cuboids",
            &[(
                "type='plane' size='1 1 1' euler='0 80 0'",
                "type='box' size='.1 1 1' pos='-.5 0 0'",
            )],
        ),
        (
            free(BOX).replace(plane, &format!("{plane}{leaning}")),
            "replace it by several boxes",
            &[(leaning, &(box_at(".3 0 .5", ".1 .02 .1") + &box_at(".7 0 .15", ".05 .02 .1")))],
        ),
        (
            contradicting,
            "state one for all solids of the two bodies",
            &[("friction='.4'", "friction='.3'")],
        ),
    ];
    edited(O, rows);
}
