//! MCAP files.

use std::sync::Arc;

use mcap::MessageStream;
use pushplan::asset::PlanFile;
use pushplan::effect::Simulated;
use pushplan::{EffectModel, Simulator, ToolLibrary, Vector};
use pushplan::{
    outcome::Record,
    task::{Job, Plan, Push, PushForm, Task},
};
use serde_json::Value as Json;

#[test]
fn a_recording_holds_every_frame_and_the_whole_plan_and_is_always_the_same() {
    let library = ToolLibrary::embedded().unwrap();
    let tool = Arc::clone(library.get("stick").unwrap());
    let task = Task::example("pull-back-behind-wall").unwrap();
    let push = Push { start: Vector::new(0.3, 0.0), direction: 0.1, length: 0.1, speed: 0.1 };
    let form = PushForm::Placed;
    let plan = Plan::pushing(&tool.name, 0.0, form, 0.002, [push]);
    let job = Job::stated(&task.scene, plan.motion(&tool));
    let model = Simulated::new(Simulator::planar());
    let trajectory = model.rollout(&task.scene, &[job], Record::Frames).remove(0);
    let file = PlanFile::new(task, vec![tool], plan);
    let bytes = pushplan_export::mcap(&file, &trajectory).unwrap();
    assert!(bytes == pushplan_export::mcap(&file, &trajectory).unwrap());
    let messages: Vec<_> = MessageStream::new(&bytes).unwrap().map(Result::unwrap).collect();
    let of = |topic: &str| -> Vec<(u64, Json)> {
        let on = messages.iter().filter(|message| message.channel.topic == topic);
        on.map(|message| (message.log_time, serde_json::from_slice(&message.data).unwrap()))
            .collect()
    };
    let (states, frames) = (of("/state"), of("/tf"));
    assert_eq!((states.len(), frames.len()), (trajectory.frames.len(), trajectory.frames.len()));
    for ((frame, (at, state)), (_, tf)) in trajectory.frames.iter().zip(&states).zip(&frames) {
        assert!((*at as f64 / 1e9 - frame.time).abs() < 1e-9);
        let pose = frame.state.poses[0];
        assert_eq!(state["objects"][0]["x"], pose.position.x);
        assert_eq!(state["objects"][0]["heading"], pose.heading);
        assert_eq!(tf["transforms"][0]["translation"]["y"], pose.position.y);
        let rotation = &tf["transforms"][0]["rotation"];
        let half = rotation["z"].as_f64().unwrap().atan2(rotation["w"].as_f64().unwrap());
        assert!(pushplan::geometry::wrap_angle(2.0 * half - pose.heading).abs() < 1e-12);
    }
    let scene = &of("/scene")[0].1;
    let names: Vec<&str> = scene["entities"]
        .as_array()
        .unwrap()
        .iter()
        .map(|entity| entity["id"].as_str().unwrap())
        .collect();
    let bodies = file.task.scene.objects.len() + file.task.scene.obstacles.len();
    assert_eq!(names.len(), bodies + 2, "{names:?}");
    let summary = mcap::Summary::read(&bytes).unwrap().expect("a summary");
    let attachment = mcap::read::attachment(&bytes, &summary.attachment_indexes[0]).unwrap();
    let text = std::str::from_utf8(&attachment.data).unwrap();
    assert_eq!(PlanFile::parse(text, "plan.json").unwrap(), file);
}
