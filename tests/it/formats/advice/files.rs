//! Files that a file names.

use pushplan_import::{Reading, Wanted};

use super::super::meshes::{cube, strict, taken_of};

/// Files by name, of which the first is imported, and the root folder.
type Folder<'a> = (&'a [(&'a str, &'a str)], Option<&'a str>);

/// Returns `true` if the first file is refused with this advice, and accepted once it is followed.
fn helped(refused: Folder<'_>, advice: &str, followed: Folder<'_>) {
    let solid = cube(60.0);
    let taken = |(files, root): Folder<'_>| {
        let texts = files.iter().map(|(name, text)| (*name, text.as_bytes()));
        let files: Vec<(&str, &[u8])> = texts.chain([("parts/cube.obj", &solid[..])]).collect();
        taken_of(&files, &Reading { root: root.map(Into::into), ..strict() }, &Wanted::default())
    };
    let fault = taken(refused).expect_err(advice);
    assert!(fault.contains(advice), "{advice}\nnot in\n{fault}");
    taken(followed).unwrap_or_else(|faults| panic!("after following `{advice}`:\n{faults}"));
}

#[test]
fn files_are_found_and_read_after_following_the_advice() {
    let body = "<worldbody><geom type='plane' size='1 1 1'/><body name='c' pos='.5 0 0'><freejoint/>\
                <geom type='mesh' mesh='cube'/></body></worldbody>";
    let mesh = |file: &str| {
        format!("<asset><mesh name='cube' file='{file}' scale='.001 .001 .001'/></asset>")
    };
    let whole = |section: &str| format!("<mujoco>{section}{body}</mujoco>");
    let sound = whole(&mesh("parts/cube.obj"));
    let assets = format!("<mujocoinclude>{}</mujocoinclude>", mesh("parts/cube.obj"));
    let including = |file: &str| whole(&format!("<include{file}/>"));
    let included = including(" file='assets.xml'");
    let attached = |file: &str| {
        format!(
            "<mujoco><asset><model name='m'{file}/></asset><worldbody><geom type='plane' size='1 1 1'/>\
             <attach model='m' body='c'/></worldbody></mujoco>"
        )
    };
    let (other, scene) = (("other.xml", sound.as_str()), "scene.xml");
    for (refused, advice, followed) in [
        (including(""), "add its `file`", included.clone()),
        (
            including(" file='asset.xml'"),
            "names are relative to the folder of the file",
            included.clone(),
        ),
        (
            format!("<mujoco><include file='scene.xml'/>{}</mujoco>", &sound[8..sound.len() - 9]),
            "break the cycle",
            sound.clone(),
        ),
        (attached(""), "add its `file`", attached(" file='other.xml'")),
        (
            attached(" file='others.xml'"),
            "names are relative to the folder of the file",
            attached(" file='other.xml'"),
        ),
        (whole(&mesh("cube.obj")), "names are relative to the folder of the file", sound.clone()),
        (whole(&mesh("cube.ply")), "convert it to STL, OBJ or DAE", sound.clone()),
        (whole(&mesh("cube.stl")), "export it again (MeshLab, trimesh)", sound.clone()),
        (assets.clone(), "give the file that includes this one", included.clone()),
    ] {
        let beside =
            [other, ("assets.xml", &assets), ("cube.ply", "ply"), ("cube.stl", "solid x\nfacet")];
        let folder = |text| [&[(scene, text)], &beside[..]].concat();
        helped((&folder(&refused), None), advice, (&folder(&followed), None));
    }
    let link = "<robot name='r'><link name='a'><inertial><origin xyz='.03 .03 .03'/><mass value='.5'/></inertial><collision><geometry>\
                <mesh filename='package://parts/cube.obj' scale='.001 .001 .001'/></geometry></collision></link></robot>";
    let robot = [("robots/r.urdf", link)];
    helped((&robot, None), "or its parent, with --root", (&robot, Some("")));
    helped((&robot, Some("none")), "give an existing folder with --root", (&robot, Some("")));
    let above = whole(&mesh("../parts/cube.obj"));
    let scenes = [("scenes/scene.xml", above.as_str())];
    helped((&scenes, None), "--root", (&scenes, Some("")));
}
