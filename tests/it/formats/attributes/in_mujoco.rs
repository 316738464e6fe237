//! Attributes that are used have the effect that MuJoCo gives them.

use std::process::Command;

use pushplan::geometry::Vector;
use pushplan_import::{Language, Treatment, treatment};
use serde_json::{Value, json};

use super::{MJCF, SCENE, listed, plain, taken, with};
use crate::mujoco_python::python;

/// Prints mass, centre of mass and bounding box of every body of the files in the arguments.
const MEASURE: &str = "
import json, sys
import mujoco, numpy as np
for text in json.load(sys.stdin):
    try:
        model = mujoco.MjModel.from_xml_string(text)
    except ValueError:
        print('null')
        continue
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    found = {}
    for body in range(1, model.nbody):
        ends = []
        for geom in np.flatnonzero(model.geom_bodyid == body):
            turn, at = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
            mesh = model.geom_dataid[geom]
            if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
                first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
                points = model.mesh_vert[first : first + count]
            else:
                half = model.geom_aabb[geom][3:]
                points = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
                points = points + model.geom_aabb[geom][:3]
            ends.append(points @ turn.T + at)
        ends = np.concatenate(ends)
        low, high = ends.min(0), ends.max(0)
        found[model.body(body).name] = [model.body_mass[body], *data.xipos[body][:2], *low[:2], *high[:2], high[2] - low[2]]
    print(json.dumps(found))
";

/// Returns the same numbers of a task.
fn measured(text: &str) -> Option<Value> {
    let (task, _) = taken(text).ok()?;
    let rows = task.scene.things().map(|(_, object)| {
        let corner =
            |angle: f64| object.shape.footprint().extent(Vector::new(angle.cos(), angle.sin()));
        let reach = |world: f64| corner(world - object.pose.heading);
        let [x, y] = [object.pose.position.x, object.pose.position.y];
        let quarter = std::f64::consts::FRAC_PI_2;
        let box_ =
            [x - reach(2.0 * quarter), y - reach(-quarter), x + reach(0.0), y + reach(quarter)];
        let [a, b, c, d] = box_;
        (object.name.clone(), json!([object.mass, x, y, a, b, c, d, object.shape.height()]))
    });
    Some(Value::Object(rows.collect()))
}

#[test]
fn what_is_used_has_the_effect_that_it_has_in_mujoco() {
    let Some(python) = python() else { return };
    let used = listed(MJCF).filter(|(element, attribute)| {
        treatment(Language::Mjcf, element, attribute) == Some(Treatment::Used)
    });
    let mut files: Vec<(String, String)> = used
        .map(|(element, attribute)| {
            (format!("{element} {attribute}"), with(Language::Mjcf, element, attribute))
        })
        .collect();
    // Primitives that are fitted to a mesh, and the order of its reference pose and scale.
    for kind in ["box", "cylinder"] {
        for more in ["", " fitscale='1.5'"] {
            let geom = format!("type='{kind}' mesh='m'{more} mass='.5'");
            let text = SCENE.replace("type='box' size='.05 .04 .05' @geom", &geom);
            let text = text.replace("@mesh", "refpos='.02 0 0' refquat='1 0 0 .4' scale='1 2 1'");
            files.push((format!("{kind} fitted{more}"), plain(&text)));
            let bounding = text.replace("@compiler", "fitaabb='true'");
            files.push((format!("{kind} fitted to the bounding box{more}"), plain(&bounding)));
        }
    }
    let input =
        json!(files.iter().map(|(_, text)| text.replace("'none'", "'d'")).collect::<Vec<_>>())
            .to_string();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("files.json");
    std::fs::write(&path, input).expect("a file");
    let out = Command::new(python)
        .args(["-c", MEASURE])
        .stdin(std::fs::File::open(&path).expect("a file"))
        .output()
        .expect("MuJoCo");
    let noted = String::from_utf8_lossy(&out.stdout).into_owned();
    assert_eq!(noted.lines().count(), files.len(), "{}", String::from_utf8_lossy(&out.stderr));
    let (mut wrong, mut compared) = (Vec::new(), 0);
    for ((name, text), line) in files.iter().zip(noted.lines()) {
        let theirs: Value = serde_json::from_str(line).expect("JSON");
        let (Some(theirs), Some(Value::Object(ours))) = (theirs.as_object(), measured(text)) else {
            continue;
        };
        compared += 1;
        for (body, own) in &ours {
            let Some(their) = theirs.get(body).and_then(Value::as_array) else { continue };
            let pairs = own.as_array().expect("numbers").iter().zip(their);
            let off = pairs
                .map(|(a, b)| (a.as_f64().unwrap() - b.as_f64().unwrap()).abs())
                .fold(0.0, f64::max);
            if off > 1e-4 {
                wrong.push(format!("{name}: `{body}` {own}\n MuJoCo: {their:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(compared > 50, "{compared} files compared");
}
