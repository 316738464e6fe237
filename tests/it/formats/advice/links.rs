//! Links and joints in URDF files.

use pushplan_import::Wanted;

use super::{As::Objects as O, Row, edited, helped, import, jointed, link, urdf};

#[test]
fn links_and_joints_of_urdf_follow_the_advice() {
    let cube = "<box size='.1 .1 .1'/>";
    let one = link("a", cube);
    let gazebo = |inside: &str| urdf(&format!("{one}<gazebo reference='a'>{inside}</gazebo>"));
    let parted =
        |inside: &str| urdf(&one.replace("<inertial><mass value='.5'/></inertial>", inside));
    let circle = jointed("fixed", "").replace(
        "</robot>",
        "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
    );
    let twice = jointed("fixed", "").replace(
        "</robot>",
        "<joint name='k' type='fixed'><parent link='world'/><child link='b'/></joint></robot>",
    );
    let outside = "<inertial><origin xyz='.2 0 0'/><mass value='.5'/></inertial>";
    let rows: &[Row<'_>] = &[
        (
            urdf(&format!("{one}{one}")),
            "give each link a unique name",
            &[(one.as_str(), ""), ("</robot>", &format!("{one}</robot>"))],
        ),
        (urdf(&format!("{one}<sensor/>")), "remove it", &[("<sensor/>", "")]),
        (
            circle,
            "remove one of them",
            &[("<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint>", "")],
        ),
        (
            jointed("fixed", "").replace("child link='b'", "child link='c'"),
            "`<parent link>` and `<child link>` must name links of the file",
            &[("child link='c'", "child link='b'")],
        ),
        (
            twice,
            "a link can have only one parent",
            &[("<joint name='k' type='fixed'><parent link='world'/><child link='b'/></joint>", "")],
        ),
        (
            jointed("continuous", "<axis xyz='0 0 0'/>"),
            "write an axis such as `0 0 1`",
            &[("xyz='0 0 0'", "xyz='0 0 1'")],
        ),
        (
            jointed("hinge", "<axis xyz='0 0 1'/>"),
            "write fixed, floating, revolute, continuous or prismatic",
            &[("'hinge'", "'continuous'")],
        ),
        (
            jointed("continuous", "<axis xyz='0 0 1'/><mimic joint='k'/>"),
            "remove <mimic>",
            &[("<mimic joint='k'/>", "")],
        ),
        (
            urdf(&one.replace("collision", "visual")),
            "give it a box, a cylinder or a mesh with collision",
            &[("</link>", &format!("<collision><geometry>{cube}</geometry></collision></link>"))],
        ),
        (
            urdf(&one.replace(&format!("<geometry>{cube}</geometry>"), "")),
            "add <geometry>",
            &[("<collision>", &format!("<collision><geometry>{cube}</geometry>"))],
        ),
        (
            urdf(&one.replace(" size='.1 .1 .1'", "")),
            "add `size`",
            &[("<box", "<box size='.1 .1 .1'")],
        ),
        (
            urdf(&link("a", "<cylinder radius='.05'/>")),
            "add `length`",
            &[("radius='.05'", "radius='.05' length='.1'")],
        ),
        (
            parted("<inertial/>"),
            "or add <inertial> with its <mass>",
            &[("<inertial/>", "<inertial><mass value='.5'/></inertial>")],
        ),
        (
            parted(""),
            "add <inertial> with its <mass>",
            &[("<collision>", "<inertial><mass value='.5'/></inertial><collision>")],
        ),
        (
            parted(outside),
            "correct the position in its <inertial>",
            &[("xyz='.2 0 0'", "xyz='.02 0 0'")],
        ),
        (gazebo("<mu1>much</mu1>"), "write a number such as 0.4", &[("much", "0.4")]),
        (
            gazebo("<turnGravityOff>true</turnGravityOff>"),
            "remove it",
            &[("<turnGravityOff>true</turnGravityOff>", "")],
        ),
        (gazebo("<kinematic>1</kinematic>"), "remove it", &[("<kinematic>1</kinematic>", "")]),
    ];
    edited(O, rows);
    // Without <inertial>, a density is required.
    let wood = Wanted { density: Some(700.0), ..Wanted::default() };
    for (text, advice) in [
        (parted(""), "such as --density 700"),
        (parted("<inertial><mass value='0'/></inertial>"), "--density 700"),
    ] {
        helped((&text, O, &Wanted::default()), advice, (&text, &wood)).unwrap();
    }
    let fault = import(&parted(outside), O, &Wanted::default()).expect_err("a fault");
    assert!(fault.contains("or remove <inertial> and give --density"), "{fault}");
    import(&parted(""), O, &wood).expect("the advice was followed");
}
