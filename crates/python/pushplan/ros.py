"""ROS 2 node that plans and carries out a task: ``python -m pushplan.ros TASK``.

The node needs `rclpy` and messages, from an installed ROS 2 or from ``pip install 'pushplan[ros]'``
(CPython 3.11). It uses standard messages only, so that nothing has to be built. With the types of
the action `Push` (``python -m pushplan.ros_types FOLDER``) it also offers that action:

==================  =========================  ====================================================
``~/pose/OBJECT``   geometry_msgs/PoseStamped  in: pose of an object in the table's frame, heading
                                               about z; ``_`` replaces invalid characters of a name
``~/solve``         std_srvs/Trigger           plans from the last poses; returns JSON
``~/run``           std_srvs/Trigger           observes, plans, sends and waits until the goal is
                                               reached; returns at once whether the run has started
``~/cancel``        std_srvs/Trigger           cancels the run and stops the robot
``~/push``          pushplan_interfaces/Push   action for ``~/run`` with feedback, cancel, result;
                                               also for a client's task with the same objects
``~/feedback``      std_msgs/String            out: JSON with ``state`` and its details
``~/path``          nav_msgs/Path              out: path of the end effector for the robot, two
                                               poses per push
``~/trajectory``    trajectory_msgs/           out: joint trajectory of tasks with an arm; an empty
                    JointTrajectory            one stops the robot
``~/done``          std_msgs/String            in: ``done``, or a fault, after the robot has run the
                                               last path or trajectory
==================  =========================  ====================================================

Lengths are metres, angles radians, times seconds. The node sends only verified plans, from poses
that are newer than the last motion. After a restart of node or robot no run is active, and
``~/run`` starts with an observation.
"""

from __future__ import annotations

import argparse
import json
import math
import re
import threading
import time
from typing import Any, Optional, Sequence

import numpy as np

from . import _native
from ._ending import until_signal
from ._messages import types

__all__ = ["Node", "Stopped", "main"]

#: Maximum age of poses when a plan is requested, seconds.
FRESH = 2.0
#: Timeout of an observation, and extra time for a robot beyond the duration of a plan, seconds.
PATIENCE = 10.0
#: Frame of published paths.
FRAME = "table"


class Stopped(Exception):
    """Cancelled or failed run; the text states the reason."""


class Node:
    """Node on an initialised context of rclpy.

    Parameters
    ----------
    task : Task
        Task of the node.
    name : str, default "pushplan"
        Name of the node.
    tries : int, default 8
        Maximum number of plans in a run.
    **solve
        Options of `pushplan.solve`.
    """

    def __init__(
        self, task: _native.Task, *, name: str = "pushplan", tries: int = 8, **solve: Any
    ) -> None:
        ros = types()
        self.task, self.tries, self.options = task, tries, solve
        self.node = ros["Node"](name)
        self.ros = ros
        self._seen: dict[str, tuple[float, np.ndarray]] = {}
        self._changed = threading.Condition()
        self._answer: Optional[str] = None
        self._cancelled = threading.Event()
        self._worker: Optional[threading.Thread] = None
        self._one = threading.Lock()
        self._goal: Any = None
        group = ros["ReentrantCallbackGroup"]()
        for thing in task.objects:
            topic = "~/pose/" + re.sub(r"\W", "_", thing)
            self.node.create_subscription(
                ros["PoseStamped"],
                topic,
                lambda message, thing=thing: self._sight(thing, message),
                10,
                callback_group=group,
            )
        self.node.create_subscription(ros["String"], "~/done", self._done, 10, callback_group=group)
        self.feedback = self.node.create_publisher(ros["String"], "~/feedback", 10)
        # Late subscribers do not receive old motions.
        self.path = self.node.create_publisher(ros["Path"], "~/path", 10)
        self.trajectory = self.node.create_publisher(ros["JointTrajectory"], "~/trajectory", 10)
        for service, answer in [
            ("solve", self._solve),
            ("run", self._run),
            ("cancel", self._cancel),
        ]:
            self.node.create_service(ros["Trigger"], f"~/{service}", answer, callback_group=group)
        if ros["Push"] is not None:
            self.action = ros["ActionServer"](
                self.node, ros["Push"], "~/push", self._pursue, callback_group=group,
                goal_callback=self._may_begin, cancel_callback=self._may_cancel,
            )

    def spin(self) -> None:
        """Serves requests until the context is shut down."""
        executor = self.ros["MultiThreadedExecutor"](num_threads=4)
        executor.add_node(self.node)
        try:
            executor.spin()
        except (KeyboardInterrupt, self.ros["ExternalShutdownException"]):
            pass
        finally:
            self._cancelled.set()
            if self._worker is not None:
                self._worker.join()

    def stop(self) -> None:
        """Stops the robot if a run is active, and shuts the context down."""
        if self._one.locked():
            self._stop()
        self.node.context.try_shutdown()

    # Subscriptions.

    def _sight(self, thing: str, message: Any) -> None:
        at, q = message.pose.position, message.pose.orientation
        heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        pose = np.array([at.x, at.y, heading])
        if not np.isfinite(pose).all():
            self._publish("ignored", what=f"pose of {thing} with numbers that are not finite")
            return
        with self._changed:
            self._seen[thing] = (time.monotonic(), pose)
            self._changed.notify_all()

    def _done(self, message: Any) -> None:
        with self._changed:
            self._answer = message.data
            self._changed.notify_all()

    # Services.

    def _solve(self, _: Any, answer: Any) -> Any:
        if self._one.locked():
            return _answer(answer, False, {"error": "a run is active; cancel it first"})
        try:
            solution = self._planned(self._look(self.task, time.monotonic() - FRESH))
        except (Stopped, ValueError, RuntimeError) as error:
            return _answer(answer, False, {"error": str(error)})
        best = solution.best
        return _answer(answer, solution.solved, {
            "status": solution.status, "plan": best.to_dict()["plan"] if best else None,
        })

    def _run(self, _: Any, answer: Any) -> Any:
        if not self._one.acquire(blocking=False):
            return _answer(answer, False, {"error": "a run is already active; cancel it first"})
        self._cancelled.clear()
        self._worker = threading.Thread(target=self._runs, args=(self.task,), daemon=True)
        self._worker.start()
        return _answer(answer, True, {"state": "begun"})

    def _cancel(self, _: Any, answer: Any) -> Any:
        return _answer(answer, True, {"cancelled": self._stop()})

    def _stop(self) -> bool:
        """Cancels the run and stops the robot; returns whether a run was active."""
        going = self._one.locked()
        self._cancelled.set()
        # A controller stops at a trajectory without points.
        self.trajectory.publish(self.ros["JointTrajectory"]())
        with self._changed:
            self._changed.notify_all()
        return going

    # Action.

    def _may_begin(self, goal: Any) -> Any:
        answers = self.ros["GoalResponse"]
        try:
            self._task_of(goal)
        except ValueError as error:
            self._publish("refused", why=str(error))
            return answers.REJECT
        # Held until the goal has ended.
        if not self._one.acquire(blocking=False):
            return answers.REJECT
        self._cancelled.clear()
        return answers.ACCEPT

    def _may_cancel(self, _: Any) -> Any:
        self._stop()
        return self.ros["CancelResponse"].ACCEPT

    def _pursue(self, goal: Any) -> Any:
        self._goal = goal
        last = self._runs(self._task_of(goal.request))
        if last["state"] == "cancelled" and goal.is_cancel_requested:
            goal.canceled()
        elif last["state"] == "ended":
            goal.succeed()
        else:
            goal.abort()
        return self.ros["Push"].Result(reached=bool(last.get("reached")), report=json.dumps(last))

    def _task_of(self, goal: Any) -> _native.Task:
        if not goal.task:
            return self.task
        task = _native.Task.parse(goal.task)
        if task.objects != self.task.objects:
            raise ValueError(
                f"the task must have the node's objects {', '.join(self.task.objects)}, found "
                f"{', '.join(task.objects)}"
            )
        return task

    # Run.

    def _runs(self, task: _native.Task) -> dict[str, Any]:
        """Carries out a run and returns its last feedback."""
        try:
            return self._publish("ended", **self._run_through(task))
        except Stopped as stop:
            return self._publish(
                "cancelled" if self._cancelled.is_set() else "failed", why=str(stop)
            )
        except Exception as error:  # noqa: BLE001 - the waiting client must receive the error
            return self._publish("failed", why=f"{type(error).__name__}: {error}")
        finally:
            self._goal = None
            self._one.release()

    def _run_through(self, given: _native.Task) -> dict[str, Any]:
        since = time.monotonic() - FRESH
        for tried in range(self.tries + 1):
            task = self._look(given, since)
            score = task.score(np.array(task.start))
            self._publish("looked", tried=tried, score=score)
            if score <= 1.0:
                return {"reached": True, "plans": tried}
            if tried == self.tries:
                break
            solution = self._planned(task)
            best = solution.best
            self._publish("planned", status=solution.status, tool=best.tool.name if best else None)
            if best is None or not solution.solved:
                return {"reached": False, "plans": tried, "why": solution.status}
            self._carry_out(best)
            since = time.monotonic()
        return {"reached": False, "plans": self.tries, "why": "maximum number of plans reached"}

    def _look(self, task: _native.Task, since: float) -> _native.Task:
        """Returns the task with poses observed after this time; waits for them."""
        until = time.monotonic() + PATIENCE
        with self._changed:
            while True:
                missing = [
                    thing for thing in task.objects
                    if thing not in self._seen or self._seen[thing][0] < since
                ]
                if not missing:
                    return task.at(np.array([self._seen[thing][1] for thing in task.objects]))
                self._go_on()
                if time.monotonic() > until:
                    raise Stopped(
                        f"no pose of {', '.join(missing)} within {PATIENCE:.0f} s; check the "
                        "topics ~/pose/OBJECT"
                    )
                self._changed.wait(0.1)

    def _planned(self, task: _native.Task) -> _native.Solution:
        solution = _native.solve(task, **self.options)
        self._go_on()
        return solution

    def _carry_out(self, plan: _native.Plan) -> None:
        self._answer = None
        joints = plan.to_dict().get("joints")
        takes = sum(push.length / push.speed for push in plan.pushes if push.length and push.speed)
        self.path.publish(self._path_of(plan))
        if joints:
            self.trajectory.publish(self._trajectory_of(joints))
            takes = joints["points"][-1]["time"]
        self._publish("sent", seconds=takes, joints=bool(joints))
        until = time.monotonic() + takes + PATIENCE
        with self._changed:
            while self._answer is None:
                self._go_on()
                if time.monotonic() > until:
                    raise Stopped("the robot sent no message on ~/done in time")
                self._changed.wait(0.1)
            if self._answer != "done":
                raise Stopped(f"the robot reports a fault: {self._answer}")

    def _go_on(self) -> None:
        if self._cancelled.is_set() and self._one.locked():
            raise Stopped("cancelled")

    # Publications.

    def _publish(self, state: str, **more: Any) -> dict[str, Any]:
        published = {"state": state, **more}
        self.feedback.publish(self.ros["String"](data=json.dumps(published)))
        goal = self._goal
        if goal is not None:
            goal.publish_feedback(self.ros["Push"].Feedback(state=state, report=json.dumps(more)))
        return published

    def _path_of(self, plan: _native.Plan) -> Any:
        path = self.ros["Path"]()
        path.header.frame_id = FRAME
        for step in plan.steps:
            push = step.get("push")
            if push is None:
                continue
            ahead = np.array([math.cos(push["direction"]), math.sin(push["direction"])])
            for along in (0.0, push["length"]):
                stamped = self.ros["PoseStamped"]()
                stamped.header.frame_id = FRAME
                at = np.array(push["start"]) + along * ahead
                stamped.pose.position.x, stamped.pose.position.y = map(float, at)
                stamped.pose.position.z = float(push["lift"])
                stamped.pose.orientation.z = math.sin(push["grip_yaw"] / 2)
                stamped.pose.orientation.w = math.cos(push["grip_yaw"] / 2)
                path.poses.append(stamped)
        return path

    def _trajectory_of(self, joints: dict[str, Any]) -> Any:
        message = self.ros["JointTrajectory"](joint_names=list(joints["joints"]))
        for point in joints["points"]:
            there = self.ros["JointTrajectoryPoint"](
                positions=list(map(float, point["positions"])),
                velocities=list(map(float, point["velocities"])),
            )
            nanos = round(point["time"] * 1e9)
            there.time_from_start.sec, there.time_from_start.nanosec = divmod(nanos, 10**9)
            message.points.append(there)
        return message


def _answer(answer: Any, success: bool, report: dict[str, Any]) -> Any:
    answer.success, answer.message = success, json.dumps(report)
    return answer


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the node for a task file."""
    parser = argparse.ArgumentParser(
        prog="python -m pushplan.ros", description="ROS 2 node that plans and carries out a task."
    )
    parser.add_argument("task", help="task file")
    parser.add_argument("--name", default="pushplan", help="name of the node [default: pushplan]")
    parser.add_argument("--effort", default="standard", choices=["draft", "standard", "thorough"])
    parser.add_argument(
        "--tries", type=int, default=8, help="maximum number of plans in a run [default: 8]"
    )
    options = parser.parse_args(arguments)
    import rclpy  # type: ignore[import-not-found,import-untyped,unused-ignore]
    from rclpy.signals import SignalHandlerOptions  # type: ignore[import-not-found,import-untyped,unused-ignore]

    task = _native.Task.load(options.task)
    # The handlers of rclpy wait for callbacks, which may be solving.
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = Node(task, name=options.name, tries=options.tries, effort=options.effort)
        until_signal(node.spin, node.stop)
    finally:
        if rclpy.ok():
            rclpy.shutdown()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
