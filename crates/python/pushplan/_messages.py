"""Types of ROS 2 that the node uses."""

from __future__ import annotations

from typing import Any


def types() -> dict[str, Any]:
    """Returns the types by name; ``Push`` is None where its package is not installed.

    Raises
    ------
    ImportError
        If ROS 2 is not installed; the message states the remedy.
    """
    try:
        from geometry_msgs.msg import PoseStamped  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from nav_msgs.msg import Path  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from rclpy.action import ActionServer, CancelResponse, GoalResponse  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from rclpy.callback_groups import ReentrantCallbackGroup  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from rclpy.node import Node as RosNode  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from std_msgs.msg import String  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from std_srvs.srv import Trigger  # type: ignore[import-not-found,import-untyped,unused-ignore]
        from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint  # type: ignore[import-not-found,import-untyped,unused-ignore]
    except ImportError as error:
        raise ImportError(
            "the node needs ROS 2: source an installation, or pip install 'pushplan[ros]'"
        ) from error
    try:
        from pushplan_interfaces.action import Push  # type: ignore[import-not-found,import-untyped,unused-ignore]
    except ImportError:
        Push = None
    names = locals()
    return {("Node" if name == "RosNode" else name): thing for name, thing in names.items()}
