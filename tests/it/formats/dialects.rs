//! Dialects of mesh files: however a box or a bracket is written, it is the same one.

use pushplan::Shape;
use pushplan::task::Task;
use pushplan_import::{Reading, Wanted};

use super::meshes::taken_of;

/// Corners of a box of 60 x 40 x 40 mm, and its faces, counter-clockwise seen from outside.
const FACES: [[usize; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

fn corner(k: usize, [x, y]: [f64; 2]) -> [f64; 3] {
    [x + [-0.03, 0.03][k >> 2], y + [-0.02, 0.02][k >> 1 & 1], [0.0, 0.04][k & 1]]
}

/// Returns the triangles of a box.
fn triangles(at: [f64; 2]) -> Vec<[[f64; 3]; 3]> {
    let cut =
        |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]].map(|face| face.map(|k| corner(k, at)));
    FACES.into_iter().flat_map(cut).collect()
}

/// Returns a box as a solid of a text in STL.
fn solid(at: [f64; 2]) -> String {
    let vertex = |[x, y, z]: &[f64; 3]| format!("      vertex {x} {y} {z}\n");
    let facet = |face: &[[f64; 3]; 3]| {
        let corners: String = face.iter().map(vertex).collect();
        format!("  facet normal 0 0 1\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid part\n{}endsolid part\n", triangles(at).iter().map(facet).collect::<String>())
}

/// Returns a box in binary STL, with this header.
fn binary(at: [f64; 2], header: &str, count: Option<u32>) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, 0);
    let faces = triangles(at);
    bytes.extend(count.unwrap_or(faces.len() as u32).to_le_bytes());
    for face in faces {
        bytes.extend([f32::NAN; 3].iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend(face.iter().flatten().flat_map(|x| (*x as f32).to_le_bytes()));
        bytes.extend([7, 7]);
    }
    bytes
}

/// Returns a box in OBJ.
fn obj() -> String {
    let vertex = |k: usize| {
        let [x, y, z] = corner(k, [0.0; 2]);
        format!("v {x} {y} {z}\n")
    };
    let face = |face: &[usize; 4]| {
        let [a, b, c, d] = face.map(|k| k + 1);
        format!("f {a} {b} {c} {d}\n")
    };
    (0..8).map(vertex).chain(FACES.iter().map(face)).collect()
}

/// Returns a box in DAE whose scene places it through these transformations.
fn dae(asset: &str, node: &str, primitives: &str) -> String {
    let numbers: Vec<String> =
        (0..8).flat_map(|k| corner(k, [0.0; 2])).map(|x| x.to_string()).collect();
    format!(
        "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>{asset}</asset>\
         <library_geometries><geometry id='g'><mesh><source id='s'><float_array id='a' count='24'>{}</float_array>\
         <technique_common><accessor source='#a' count='8' stride='3'/></technique_common></source>\
         <vertices id='v'><input semantic='POSITION' source='#s'/></vertices>{primitives}</mesh></geometry></library_geometries>\
         <library_visual_scenes><visual_scene id='w'><node>{node}</node></visual_scene></library_visual_scenes>\
         <scene><instance_visual_scene url='#w'/></scene></COLLADA>",
        numbers.join(" ")
    )
}

fn polylist() -> String {
    let corners: Vec<String> = FACES.iter().flatten().map(|k| format!("{k} 9")).collect();
    format!(
        "<polylist count='6'><input semantic='VERTEX' source='#v' offset='0'/><input semantic='NORMAL' source='#n' offset='1'/>\
         <vcount>4 4 4 4 4 4</vcount><p>{}</p></polylist>",
        corners.join(" ")
    )
}

fn taken(name: &str, bytes: &[u8]) -> (Task, String) {
    let wood = Wanted { density: Some(700.0), ..Wanted::default() };
    let made = taken_of(&[(name, bytes)], &Reading::default(), &wood);
    made.unwrap_or_else(|faults| {
        panic!("{faults}\n{}", String::from_utf8_lossy(&bytes[..bytes.len().min(300)]))
    })
}

fn is_box(task: &Task, object: usize) -> bool {
    let object = &task.scene.objects[object];
    let area = object.shape.footprint().area();
    (object.mass - 0.0672).abs() < 1e-6
        && (area - 0.0024).abs() < 1e-7
        && (object.shape.height() - 0.04).abs() < 1e-6
}

#[test]
fn a_box_is_the_same_in_every_dialect() {
    let text = solid([0.0; 2]);
    let wrapped = obj().replace(" 4 3\n", " \\\n 4 3\n").replace("1 2 4 3", "1 2 \\\r\n4 3");
    let negative = obj()
        .lines()
        .map(|line| match line.strip_prefix("f ") {
            Some(face) => {
                let corner = |k: &str| format!("{}/1/2", k.parse::<i32>().unwrap() - 9);
                format!("f {}\n", face.split(' ').map(corner).collect::<Vec<_>>().join(" "))
            }
            None => format!("{line} 1 0.5 0.25\n"),
        })
        .collect::<String>();
    let latin: Vec<u8> = [b"# gr\xfcn\no gr\xfcn\n".as_slice(), obj().as_bytes()].concat();
    let metre = "<unit name='mm' meter='1'/><up_axis>Z_UP</up_axis>";
    let shown = "<instance_geometry url='#g'/>";
    let half = "<unit meter='.5'/><up_axis>Z_UP</up_axis>";
    let twice = format!("<scale>2 2 2</scale><node><rotate>0 0 1 90</rotate>{shown}</node>");
    let triangles: Vec<String> = FACES
        .iter()
        .flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d])
        .map(|k| k.to_string())
        .collect();
    let triangles = format!(
        "<triangles count='12'><input semantic='VERTEX' source='#v' offset='0'/><p>{}</p></triangles>",
        triangles.join(" ")
    );
    let upright = "<matrix>1 0 0 0 0 0 -1 0 0 1 0 0 0 0 0 1</matrix>";
    let fan = |[a, b, c, d]: &[usize; 4]| {
        format!(
            "<trifans><input semantic='VERTEX' source='#v' offset='0'/><p>{a} {b} {c} {d}</p></trifans>"
        )
    };
    let strip = |[a, b, c, d]: &[usize; 4]| {
        format!(
            "<tristrips><input semantic='VERTEX' source='#v' offset='0'/><p>{a} {b} {d} {c}</p></tristrips>"
        )
    };
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("a.stl", text.clone().into()),
        ("b.stl", text.replace("solid part", "solid").into()),
        ("c.stl", text.to_uppercase().into()),
        ("d.stl", text.replace("0 0 1\n", "nan nan -nan(ind)\n").into()),
        ("e.stl", text.lines().skip(1).collect::<Vec<_>>().join("\r\n").into()),
        ("f.STL", format!("\n  {text}").replace("0.03", "3.0E-02").into()),
        ("g.stl", binary([0.0; 2], "solid, although binary", None)),
        ("h.stl", binary([0.0; 2], "", Some(0))),
        ("i.stl", binary([0.0; 2], "", Some(u32::MAX))),
        ("j.obj", obj().into()),
        ("k.obj", wrapped.into()),
        ("l.obj", negative.into()),
        ("m.obj", latin),
        ("n.OBJ", obj().replace('\n', "\r\n").replace("v ", "v\t").into()),
        ("o.obj", (obj() + "l 1 2\np 3\nf 1 2\nvp 0.1\ncurv 0 1 1 2\n").into()),
        ("p.dae", dae(metre, shown, &polylist()).into()),
        ("q.dae", dae(half, &twice, &triangles).into()),
        (
            "r.dae",
            dae("<up_axis>Y_UP</up_axis>", shown, &polylist())
                .replace(shown, &format!("<rotate>1 0 0 -90</rotate>{shown}"))
                .into(),
        ),
        (
            "s.dae",
            dae(
                metre,
                &format!("<node>{upright}<rotate>1 0 0 -90</rotate>{shown}</node>"),
                &FACES.iter().map(fan).collect::<String>(),
            )
            .into(),
        ),
        (
            "t.dae",
            dae(
                metre,
                &format!("<scale>-1 1 1</scale>{shown}"),
                &FACES.iter().map(strip).collect::<String>(),
            )
            .into(),
        ),
    ];
    for (name, bytes) in files {
        let (task, notes) = taken(name, &bytes);
        assert!(
            task.scene.objects.len() == 1 && is_box(&task, 0),
            "{name}: {:?}\n{notes}",
            task.scene.objects
        );
        assert!(!notes.contains("not closed"), "{name}: {notes}");
    }
}

#[test]
fn separate_solids_of_a_file_are_separate_objects() {
    let two = [solid([0.0; 2]), solid([0.08, 0.0])].concat();
    let both: Vec<u8> = [binary([0.0; 2], "a", None), binary([0.08, 0.0], "b", None)].concat();
    for (name, bytes) in [("two.stl", two.into_bytes()), ("both.stl", both)] {
        let (task, notes) = taken(name, &bytes);
        assert!(
            task.scene.things().count() == 2 && is_box(&task, 0) && is_box(&task, 1),
            "{notes}"
        );
        assert!(notes.contains("2 separate solids"), "{notes}");
    }
    // Solids that touch are one object.
    let joined = [solid([0.0; 2]), solid([0.06, 0.0])].concat();
    let (task, _) = taken("one.stl", joined.as_bytes());
    assert_eq!(task.scene.things().count(), 1);
    assert!((task.scene.mass(0) - 0.1344).abs() < 1e-5, "{}", task.scene.mass(0));
}

#[test]
fn concave_faces_are_cut_inside_and_the_note_compares_with_the_mesh() {
    let outline = [[0, 0], [8, 0], [8, 3], [3, 3], [3, 8], [0, 8]];
    for first in 0..6 {
        let mut text = String::new();
        for z in [0.0, 0.04] {
            for [x, y] in outline {
                text += &format!("v {} {} {z}\n", 0.01 * f64::from(x), 0.01 * f64::from(y));
            }
        }
        let ring = |top: usize| (0..6).map(move |k| (k + first) % 6 + top).map(|k| k.to_string());
        text += &format!("f {}\n", ring(1).rev().collect::<Vec<_>>().join(" "));
        text += &format!("f {}\n", ring(7).collect::<Vec<_>>().join(" "));
        for k in 0..6 {
            let next = (k + 1) % 6;
            text += &format!("f {} {} {} {}\n", k + 1, next + 1, next + 7, k + 7);
        }
        let (task, notes) = taken("ell.obj", text.as_bytes());
        let area: f64 = task.scene.objects.iter().map(|o| o.shape.footprint().area()).sum();
        assert!((task.scene.mass(0) - 0.1092).abs() < 1e-6, "{}", task.scene.mass(0));
        assert!(area < 1.08 * 0.0039, "{first}: {area}\n{notes}");
        let more = notes.split("cover ").nth(1).and_then(|note| note.split(' ').next());
        let more: f64 = more.expect("a note").parse().expect("a share");
        assert!(more < 5.0, "{notes}");
        let heights = task.scene.objects.iter().map(|object| object.shape.height());
        assert!(heights.fold(f64::INFINITY, f64::min) > 0.039, "no slab that is not there");
    }
}

#[test]
fn a_mesh_that_bulges_above_the_table_is_a_stack_of_outlines() {
    // A mushroom: a stem of 20 mm below a cap of 40 mm in radius.
    let mut text = String::new();
    let rings = [(0.02, 0.0), (0.02, 0.04), (0.04, 0.045), (0.04, 0.07)];
    for (radius, z) in rings {
        for k in 0..24 {
            let angle = std::f64::consts::TAU * f64::from(k) / 24.0;
            text += &format!("v {} {} {z}\n", radius * angle.cos(), radius * angle.sin());
        }
    }
    let ring = |first: usize| (0..24).map(move |k| (first + k + 1).to_string()).collect::<Vec<_>>();
    text += &format!("f {}\n", ring(0).into_iter().rev().collect::<Vec<_>>().join(" "));
    text += &format!("f {}\n", ring(72).join(" "));
    for level in 0..3 {
        for k in 0..24 {
            let [a, b] = [k, (k + 1) % 24].map(|k| 24 * level + k + 1);
            text += &format!("f {a} {b} {} {}\n", b + 24, a + 24);
        }
    }
    let (task, notes) = taken("mushroom.obj", text.as_bytes());
    let solids = &task.scene.objects;
    let radius = |k: usize| match &solids[k].shape {
        Shape::Cylinder { radius, .. } => *radius,
        shape => panic!("{shape:?}\n{notes}"),
    };
    assert!(solids.len() > 1 && task.scene.things().count() == 1, "{notes}");
    assert!(
        (radius(0) - 0.02).abs() < 1e-3 && solids[0].z == 0.0 && solids[0].shape.height() < 0.043
    );
    let last = solids.len() - 1;
    assert!((radius(last) - 0.04).abs() < 1e-3 && solids[last].z > 0.038, "{notes}");
    let volume = std::f64::consts::PI * (0.04 * 0.0004 + 0.025 * 0.0016 + 0.005 / 3.0 * 0.0028);
    assert!((task.scene.mass(0) / (700.0 * volume) - 1.0).abs() < 0.02, "{}", task.scene.mass(0));
}
