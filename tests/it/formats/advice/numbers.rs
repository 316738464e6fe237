//! Numbers and names in MJCF files.

use super::{As::Objects as O, BOX, Row, edited, free, mesh, with};

#[test]
fn numbers_and_names_of_mjcf_are_corrected_by_the_advice() {
    let geom = "<geom type='mesh' mesh='m'/>";
    let classes = "<default><default class='own'><geom mass='.3'/></default></default>";
    let rows: &[Row<'_>] = &[
        (
            free("<geom type='box' size='.05 .04 x'/>"),
            "write numbers separated by spaces",
            &[(" x'", " .05'")],
        ),
        (
            free(&format!("<inertial mass='.3' pos='0 0'/>{BOX}")),
            "write 3 numbers",
            &[("'0 0'", "'0 0 0'")],
        ),
        (free(&BOX.replace("/>", " mass='1 2'/>")), "write one number", &[("'1 2'", "'1'")]),
        (
            free(&BOX.replace("/>", " colour='red'/>")),
            "correct its name, or remove it",
            &[("colour='red'", "")],
        ),
        (
            free(&BOX.replace("/>", " mas='1'/>")),
            "correct its name, or remove it",
            &[("mas=", "mass=")],
        ),
        (
            free("<geom type='box' size='.05 .05'/>"),
            "a box has three half extents",
            &[(".05 .05'", ".05 .05 .05'")],
        ),
        (
            free("<geom type='cylinder' size='.05'/>"),
            "a cylinder radius and half its length",
            &[("'.05'", "'.05 .05'")],
        ),
        (
            free("<geom type='cone' size='.05 .05'/>"),
            "write box, cylinder or mesh",
            &[("cone", "cylinder")],
        ),
        (
            with(&mesh("", 0.06), "<geom type='mesh'/>"),
            "add `mesh`",
            &[("<geom type='mesh'", "<geom type='mesh' mesh='m'")],
        ),
        (
            with(&mesh("", 0.06), &geom.replace("'m'", "'n'")),
            "use a mesh defined under <asset>",
            &[("'n'", "'m'")],
        ),
        (
            with(&mesh("", 0.06).replace("vertex='0 ", "vertex='"), geom),
            "write x, y and z of each vertex",
            &[("vertex='", "vertex='0 ")],
        ),
        (
            with(&mesh("scale='.001 .001 .001'", 0.06), geom),
            "check its scale; lengths are metres",
            &[(".001 .001 .001", "1 1 1")],
        ),
        (
            with(&mesh("", 300.0), geom),
            "set its `scale` to 0.001 0.001 0.001",
            &[("name='m'", "name='m' scale='.001 .001 .001'")],
        ),
        (
            with(&mesh("", 6.0), geom),
            "such as 0.01 0.01 0.01",
            &[("name='m'", "name='m' scale='.01 .01 .01'")],
        ),
        (
            with(classes, &BOX.replace("/>", " class='other'/>")),
            "use a class defined under <default>",
            &[("'other'", "'own'")],
        ),
        (
            with(&classes.replace(" class='own'", ""), BOX),
            "add its `class`",
            &[("<default><default>", "<default><default class='own'>")],
        ),
        (
            with("<default class='all'><geom mass='.3'/></default>", BOX),
            "remove its `class`",
            &[(" class='all'", "")],
        ),
        (
            with("<compiler eulerseq='abc'/>", BOX),
            "write three of the letters x, y, z, X, Y, Z",
            &[("abc", "xyz")],
        ),
        (
            with("<compiler settotalmass='.3'/>", BOX),
            "write the masses themselves",
            &[("<compiler settotalmass='.3'/>", ""), ("'box'", "'box' mass='.3'")],
        ),
        (
            with("<compiler coordinate='global'/>", BOX),
            "correct it, or remove it",
            &[(" coordinate='global'", "")],
        ),
        (
            free(&BOX.replace("/>", " quat='0 0 0 0'/>")),
            "correct its numbers",
            &[("'0 0 0 0'", "'1 0 0 0'")],
        ),
        (with("<contact><cluster/></contact>", BOX), "remove it", &[("<cluster/>", "")]),
        (
            with("<option><flag contact='disable'/></option>", BOX),
            "remove the flag",
            &[("<flag contact='disable'/>", "")],
        ),
        (
            with("<option gravity='0 0 0'/>", BOX),
            "write `0 0 -9.81`",
            &[("'0 0 0'", "'0 0 -9.81'")],
        ),
        // The table is upright.
        (
            with("<option gravity='0 -9.81 0'/>", BOX)
                .replace("'plane'", "'plane' zaxis='0 1 0'")
                .replace(".5 0 .05", ".5 .05 0"),
            "rotate the scene, so that gravity is `0 0 -9.81`",
            &[
                ("'0 -9.81 0'", "'0 0 -9.81'"),
                ("zaxis='0 1 0'", "zaxis='0 0 1'"),
                (".5 .05 0", ".5 0 .05"),
            ],
        ),
        (
            free(BOX).replace("name='b'", "name='b' gravcomp='1'"),
            "remove it; in pushplan every body has its full weight",
            &[(" gravcomp='1'", "")],
        ),
        (
            with("<compiler inertiafromgeom='false'/>", BOX),
            "add <inertial>",
            &[("<geom type='box'", "<inertial mass='.3' pos='0 0 0'/><geom type='box'")],
        ),
        (
            free(&format!("<inertial pos='0 0 0'/>{BOX}")),
            "add `mass`",
            &[("<inertial", "<inertial mass='.3'")],
        ),
    ];
    edited(O, rows);
}
