"""ROS 2 node with a simulated robot on the loopback interface: plans, feedback, cancel, restart."""

from __future__ import annotations

import json
import math
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable, Iterator

import numpy as np
import pytest

import pushplan
from pushplan import _messages

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
os.environ.setdefault("ROS_DOMAIN_ID", "47")
rclpy = pytest.importorskip("rclpy")
ros = pytest.importorskip("pushplan.ros")

TASK: Any = {
    "scene": {"objects": [{
        "name": "can", "shape": {"cylinder": {"radius": 0.04, "height": 0.1}},
        "mass": 0.4, "friction": 0.4, "position": [0.45, 0.1],
    }]},
    "robot": {"reach": {"min": 0.1, "max": 0.9}},
    "tools": ["paddle"],
    "goal": {"object": "can", "position": [0.55, 0.1], "tolerance": 0.02},
}


class Robot:
    """Publishes the pose of the can, and pushes it in the 2-D engine unless it is ``stuck``."""

    def __init__(self, task: pushplan.Task, stuck: bool = False) -> None:
        parts = _messages.types()
        self.parts, self.task, self.stuck = parts, task, stuck
        self.poses = np.array(task.start)
        self.node = parts["Node"]("robot")
        self.out = self.node.create_publisher(parts["PoseStamped"], "/pushplan/pose/can", 10)
        self.done = self.node.create_publisher(parts["String"], "/pushplan/done", 10)
        self.node.create_subscription(parts["Path"], "/pushplan/path", self.push, 10)
        self.states: list[dict[str, Any]] = []
        self.node.create_subscription(
            parts["String"],
            "/pushplan/feedback",
            lambda message: self.states.append(json.loads(message.data)),
            10,
        )
        self.stops = 0
        self.node.create_subscription(
            parts["JointTrajectory"], "/pushplan/trajectory", self.stop, 10
        )
        self.node.create_timer(0.05, self.publish_poses)

    def publish_poses(self) -> None:
        message = self.parts["PoseStamped"]()
        x, y, heading = map(float, self.poses[0])
        message.pose.position.x, message.pose.position.y = x, y
        message.pose.orientation.z, message.pose.orientation.w = (
            math.sin(heading / 2),
            math.cos(heading / 2),
        )
        self.out.publish(message)

    def stop(self, message: Any) -> None:
        self.stops += not message.points

    def push(self, path: Any) -> None:
        if self.stuck:
            return
        pushes = []
        for a, b in zip(path.poses[::2], path.poses[1::2]):
            way = np.array(
                [b.pose.position.x - a.pose.position.x, b.pose.position.y - a.pose.position.y]
            )
            start = (a.pose.position.x, a.pose.position.y)
            pushes.append(
                pushplan.Push(start, math.atan2(way[1], way[0]), float(np.hypot(*way)), 0.1)
            )
        yaw = 2 * math.atan2(path.poses[0].pose.orientation.z, path.poses[0].pose.orientation.w)
        plan = pushplan.Plan.of(self.task.at(self.poses), "paddle", pushes, grip_yaw=yaw)
        self.poses = np.array(pushplan.predict(plan, "planar").poses[-1])
        self.done.publish(self.parts["String"](data="done"))

    def call(self, service: str) -> dict[str, Any]:
        client = self.node.create_client(self.parts["Trigger"], f"/pushplan/{service}")
        assert client.wait_for_service(timeout_sec=20)
        future = client.call_async(self.parts["Trigger"].Request())
        wait(future.done, 60)
        answer = future.result()
        return {"success": answer.success, **json.loads(answer.message)}

    def state(self, *wanted: str) -> dict[str, Any]:
        wait(lambda: any(report["state"] in wanted for report in self.states), 60)
        return next(report for report in self.states if report["state"] in wanted)


def wait(until: Callable[[], bool], seconds: float) -> None:
    end = time.monotonic() + seconds
    while not until():
        assert time.monotonic() < end, "nothing happened"
        time.sleep(0.02)


class Turning:
    """Node that spins in its own thread on its own context."""

    def __init__(self, node: Any) -> None:
        self.node = node
        self.executor = _messages.types()["MultiThreadedExecutor"](num_threads=3)
        self.executor.add_node(node)
        self.thread = threading.Thread(target=self.executor.spin, daemon=True)
        self.thread.start()

    def stop(self) -> None:
        self.executor.shutdown(timeout_sec=5)
        self.thread.join(5)
        self.node.destroy_node()


@pytest.fixture
def context() -> Iterator[None]:
    rclpy.init()
    yield
    rclpy.shutdown()


def started(stuck: bool = False) -> tuple[Any, Turning, Robot, Turning]:
    task = pushplan.Task.from_dict(TASK)
    planner = ros.Node(task, effort="draft")
    robot = Robot(task, stuck)
    return planner, Turning(planner.node), robot, Turning(robot.node)


def test_a_run_looks_plans_sends_and_ends_at_the_goal(context: None) -> None:
    _, node, robot, turning = started()
    solved = robot.call("solve")
    assert solved["success"] and solved["status"] == "solved" and solved["plan"]["steps"]
    assert (robot.poses == np.array(robot.task.start)).all(), "`~/solve` moves nothing"
    assert robot.call("run")["success"]
    ended = robot.state("ended", "failed")
    assert ended["state"] == "ended" and ended["reached"], robot.states
    assert {"looked", "planned", "sent"} <= {report["state"] for report in robot.states}
    assert np.linalg.norm(robot.poses[0, :2] - [0.55, 0.1]) <= 0.02
    node.stop()
    turning.stop()


def test_a_run_is_cancelled_and_either_side_starts_again(context: None) -> None:
    planner, node, robot, turning = started(stuck=True)
    assert robot.call("run")["success"]
    robot.state("sent")
    assert not robot.call("run")["success"]
    assert robot.call("cancel")["cancelled"]
    assert robot.state("cancelled", "ended")["state"] == "cancelled"
    wait(lambda: robot.stops > 0, 10)
    # The robot disconnects, reconnects and works again.
    turning.stop()
    robot = Robot(robot.task)
    turning = Turning(robot.node)
    assert robot.call("run")["success"]
    assert robot.state("ended", "failed")["state"] == "ended", robot.states
    # The planner also restarts.
    node.stop()
    planner = ros.Node(robot.task, effort="draft")
    node = Turning(planner.node)
    robot.states.clear()
    robot.poses = np.array(robot.task.start)
    assert robot.call("run")["success"]
    assert robot.state("ended", "failed").get("reached"), robot.states
    node.stop()
    turning.stop()


@pytest.mark.parametrize("busy", [False, True])
def test_a_signal_ends_the_node_within_a_second(busy: bool, tmp_path: Path, context: None) -> None:
    path = tmp_path / "push.yaml"
    path.write_text(json.dumps(TASK))
    effort = "thorough" if busy else "draft"
    node = subprocess.Popen([sys.executable, "-m", "pushplan.ros", str(path), "--effort", effort])
    robot = Robot(pushplan.Task.from_dict(TASK), stuck=True)
    turning = Turning(robot.node)
    try:
        client = robot.node.create_client(robot.parts["Trigger"], "/pushplan/solve")
        assert client.wait_for_service(timeout_sec=20)
        if busy:
            client.call_async(robot.parts["Trigger"].Request())
            time.sleep(0.3)
        began = time.monotonic()
        node.send_signal(signal.SIGTERM)
        assert node.wait(10) == 0
        assert time.monotonic() - began < 1.0
    finally:
        node.kill()
        turning.stop()


def test_a_task_with_one_of_two_goals_met_is_not_reached() -> None:
    two: Any = json.loads(json.dumps(TASK))
    [can] = two["scene"]["objects"]
    two["scene"]["objects"] = [can, {**can, "name": "cup", "position": [0.45, -0.1]}]
    two["goal"] = [
        {"object": "can", "position": [0.45, 0.1], "tolerance": 0.02},
        {"object": "cup", "position": [0.55, -0.1], "tolerance": 0.02},
    ]
    task = pushplan.Task.from_dict(two)

    # A node that receives the start and makes no plan, without a context of rclpy.
    still: Any = ros.Node.__new__(ros.Node)
    still.tries = 0
    still._look = lambda given, since: given
    still._publish = lambda state, **more: {"state": state, **more}
    assert still._run_through(task)["reached"] is False
    assert still._run_through(task.at(np.array([[0.45, 0.1, 0.0], [0.55, -0.1, 0.0]])))["reached"]


@pytest.fixture(scope="module")
def types(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Builds and imports the types of the action `Push`."""
    for module in ("rosidl_adapter.action", "rosidl_generator_c", "catkin_pkg", "em"):
        pytest.importorskip(module)
    from pushplan import ros_types

    sys.path.insert(0, str(ros_types.build(tmp_path_factory.mktemp("types"))))
    from pushplan_interfaces.action import Push  # type: ignore[import-not-found,unused-ignore]

    return Push


class Client:
    """Client of the action."""

    def __init__(self, node: Any, kind: Any) -> None:
        from rclpy.action import ActionClient  # type: ignore[import-not-found,unused-ignore]

        self.kind = kind
        self.feedback: list[str] = []
        self.client = ActionClient(node, kind, "/pushplan/push")

    def asks(self, task: str = "") -> Any:
        assert self.client.wait_for_server(timeout_sec=20)
        self.feedback = []
        asked = self.client.send_goal_async(
            self.kind.Goal(task=task),
            feedback_callback=lambda message: self.feedback.append(message.feedback.state),
        )
        wait(asked.done, 60)
        return asked.result()

    @staticmethod
    def ends(goal: Any) -> tuple[str, dict[str, Any]]:
        from action_msgs.msg import GoalStatus  # type: ignore[import-not-found,unused-ignore]

        result = goal.get_result_async()
        wait(result.done, 60)
        names = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "cancelled"}
        found = result.result()
        return names.get(found.status, "aborted"), {
            **json.loads(found.result.report),
            "reached": found.result.reached,
        }


def test_a_goal_has_feedback_a_result_and_is_cancelled(types: Any, context: None) -> None:
    _, node, robot, turning = started()
    client = Client(robot.node, types)
    goal = client.asks()
    assert goal.accepted
    status, report = client.ends(goal)
    assert status == "succeeded" and report["reached"] and report["state"] == "ended", report
    assert (
        client.feedback[0] == "looked"
        and client.feedback[-1] == "ended"
        and {"planned", "sent"} <= set(client.feedback)
    )
    assert np.linalg.norm(robot.poses[0, :2] - [0.55, 0.1]) <= 0.02
    # Another goal for the same can, and one for an object that the node does not observe.
    further: Any = json.loads(json.dumps(TASK))
    further["goal"]["position"] = [0.55, 0.2]
    status, report = client.ends(client.asks(json.dumps(further)))
    assert status == "succeeded" and report["reached"], report
    assert np.linalg.norm(robot.poses[0, :2] - [0.55, 0.2]) <= 0.02
    further["scene"]["objects"][0]["name"] = further["goal"]["object"] = "cup"
    assert not client.asks(json.dumps(further)).accepted
    assert not client.asks("no task").accepted
    # The robot does not answer: the goal is cancelled, and nothing else starts meanwhile.
    robot.stuck, robot.poses = True, np.array(robot.task.start)
    time.sleep(0.3)
    goal = client.asks()
    wait(lambda: "sent" in client.feedback, 60)
    assert not client.asks().accepted and not robot.call("run")["success"]
    stops = robot.stops
    goal.cancel_goal_async()
    assert client.ends(goal)[0] == "cancelled"
    wait(lambda: robot.stops > stops, 10)
    # Either side restarts.
    robot.stuck = False
    node.stop()
    node = Turning(ros.Node(robot.task, effort="draft").node)
    status, report = client.ends(client.asks())
    assert status == "succeeded" and report["reached"], report
    turning.stop()
    robot = Robot(robot.task)
    turning = Turning(robot.node)
    status, report = Client.ends(Client(robot.node, types).asks())
    assert status == "succeeded" and report["reached"], report
    node.stop()
    turning.stop()
