//! Compound objects: one name, one pose, one mass.

use crate::program::{self, succeed};
use pushplan::{EffectModel, Pose, Simulated, Simulator, Task};
use pushplan::{
    outcome::Record,
    scene::{Engine, Rate, Situation},
};

/// Mug with a handle beside a can.
const MUG: &str = "
scene:
  objects:
    - name: mug
      shape: {cylinder: {radius: 0.04, height: 0.10}}
      parts:
        - {name: handle, shape: {cuboid: {size: [0.03, 0.015, 0.1]}}, position: [0.055, 0], yaw_deg: 10}
        - {shape: {cuboid: {size: [0.02, 0.015, 0.1]}}, position: [-0.045, 0], mass: 0.05}
      mass: 0.35
      friction: 0.4
      position: [0.55, 0.05]
      yaw_deg: 30
    - {name: can, shape: {cylinder: {radius: 0.03, height: 0.1}}, mass: 0.3, friction: 0.4,
       position: [0.7, 0.05]}
robot: {reach: {min: 0.3, max: 0.9}}
tools: all
goal: {object: mug, position: [0.50, -0.10], tolerance: 0.02}
";

fn task(text: &str) -> Task {
    Task::parse(text, "mug.yaml").expect("a task")
}

#[test]
fn a_thing_has_one_mass_and_its_parts_go_with_it() {
    let task = task(MUG);
    let scene = &task.scene;
    let names: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["mug", "can", "mug/handle", "mug/2"]);
    assert_eq!(scene.things().map(|(k, _)| k).collect::<Vec<_>>(), [0, 1]);
    assert!((scene.mass(0) - 0.35).abs() < 1e-12 && scene.objects[3].mass == 0.05);
    // By volume: 0.3 kg for the cylinder and the handle.
    let share = 0.03 * 0.015 / (std::f64::consts::PI * 0.04 * 0.04 + 0.03 * 0.015);
    assert!((scene.objects[2].mass - 0.3 * share).abs() < 1e-12);
    let place = Pose::new(0.055, 0.0, 10_f64.to_radians());
    assert_eq!(scene.objects[2].pose, scene.objects[0].pose * place);
}

#[test]
fn it_is_written_as_it_was_read() {
    for text in [MUG.to_owned(), MUG.replace(", mass: 0.05}", "}")] {
        let task = task(&text);
        let again = Task::parse(&task.to_yaml().expect("YAML"), "mug.yaml").expect("a task");
        // A part with its own mass causes a rounding error.
        assert_eq!(again.scene.objects.len(), task.scene.objects.len());
        for (one, other) in task.scene.objects.iter().zip(&again.scene.objects) {
            assert!((one.mass - other.mass).abs() < 1e-15, "{one:?} {other:?}");
            assert_eq!((&one.name, one.pose, one.whole), (&other.name, other.pose, other.whole));
        }
        assert_eq!(task.scene.joints, again.scene.joints);
    }
}

#[test]
fn errors_of_parts_have_their_locations() {
    let faults = |from: &str, to: &str| {
        let faults = Task::parse(&MUG.replace(from, to), "mug.yaml").expect_err("faults");
        faults.to_string()
    };
    let text = faults("mass: 0.35", "mass: 0.04");
    assert!(
        text.contains("mug.yaml:9:13") && text.contains("the parts alone have 0.05 kg"),
        "{text}"
    );
    let text = faults("position: [0.7, 0.05]", "position: [0.62, 0.07]");
    assert!(text.contains("`can` overlaps `mug/handle`"), "{text}");
    let text = faults("name: handle", "name: \"2\"");
    assert!(text.contains("two parts are called `2`"), "{text}");
}

#[test]
fn warnings_name_the_whole_object() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let file = folder.path().join("mug.yaml");
    // Both parts and the whole are outside the range of friction, the handle alone of sizes.
    let heavy = MUG.replace("friction: 0.4\n      position", "friction: 1.95\n      position");
    std::fs::write(&file, heavy.replace("0.03, 0.015", "0.03, 0.005")).expect("a file");
    let output = succeed(&format!("check {}", file.display()));
    let warnings = program::stderr(&output) + &String::from_utf8_lossy(&output.stdout);
    let of_mug = |word: &str| {
        let lines = warnings.lines().filter(|line| line.contains("mug") && line.contains(word));
        lines.count()
    };
    assert_eq!((of_mug("friction"), of_mug("mug/")), (1, 0), "{warnings}");
    assert!(of_mug("0.005") > 0, "{warnings}");
}

/// A bar cut in two also has its support cut in two; everything else is unchanged.
#[test]
fn a_bar_of_two_halves_moves_as_a_bar() {
    let bar = |object: &str| {
        let text = format!(
            "scene: {{objects: [{object}]}}\nrobot: {{hand: none, base: none, reach: {{max: 1}}}}\n\
             tools: all\ngoal: {{object: bar, position: [0.6, 0.1], tolerance: 0.02}}\n"
        );
        task(&text)
    };
    let whole =
        bar("{name: bar, shape: {cuboid: {size: [0.16, 0.06, 0.05]}}, mass: 0.5, friction: 0.4, \
         position: [0.54, 0], yaw_deg: 90}");
    let halves =
        bar("{name: bar, shape: {cuboid: {size: [0.08, 0.06, 0.05]}}, mass: 0.5, friction: 0.4, \
         position: [0.54, 0.04], yaw_deg: 90, \
         parts: [{shape: {cuboid: {size: [0.08, 0.06, 0.05]}}, position: [-0.08, 0]}]}");
    let library = pushplan::ToolLibrary::embedded().expect("tools");
    let stick = library.get("stick").expect("a stick");
    let push =
        pushplan::Push { start: [-0.12, 0.06].into(), direction: 0.0, length: 0.12, speed: 0.1 };
    let motion = pushplan::ToolMotion::pushes(stick.clone(), 0.002, 0.0, &[push], true);
    for engine in [Engine::Planar, Engine::Spatial] {
        let model = Simulated::new(Simulator::new(engine, Rate::DEFAULT));
        let end = |task: &Task| {
            let job = pushplan::Job::new(&Situation::stated(&task.scene), motion.clone());
            let mut rolled = model.rollout(&task.scene, &[job], Record::Outcome);
            let state = rolled.remove(0).outcome().clone();
            (task.scene.centre(0, &state), state.poses[0].heading)
        };
        let ((one, turned), (other, also)) = (end(&whole), end(&halves));
        assert!((turned - 90_f64.to_radians()).abs() > 0.1, "it turns: {turned}");
        // The supports of the halves are also even, but with two sets of points; in 3-D the choice
        // of support points has the largest effect.
        let (far, askew) = if engine == Engine::Planar { (2e-3, 0.03) } else { (5e-3, 0.06) };
        assert!((one - other).norm() < far, "{one} {other}");
        assert!((turned - also).abs() < askew, "{turned} {also}");
    }
}
