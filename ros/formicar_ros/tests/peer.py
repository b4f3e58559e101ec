"""A ROS node of the tests' own, beside the server: sends maps and transforms, asks for paths."""

from __future__ import annotations

import math
import threading
import time
from array import array
from collections.abc import Callable
from typing import Any

import numpy as np
import rclpy
from geometry_msgs.msg import PoseStamped, TransformStamped
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from map_msgs.msg import OccupancyGridUpdate
from nav2_msgs.action import ComputePathThroughPoses, ComputePathToPose
from nav_msgs.msg import OccupancyGrid, Path
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import DescribeParameters, ListParameters, SetParameters
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

PATIENCE_S = 30.0
MEETING_S = 0.7
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)

ACCEPTED, EXECUTING, SUCCEEDED, CANCELED, ABORTED = 1, 2, 4, 5, 6


class Peer:
    def __init__(self, domain: int, *, is_threaded: bool = True) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = rclpy.create_node(f"peer_{domain}", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self._spin, daemon=True)
        if is_threaded:
            self.thread.start()
        self._publishers: dict[str, Any] = {}
        self._clients: dict[str, Any] = {}
        self._met: list[Any] = []
        self.to_pose = ActionClient(self.node, ComputePathToPose, "compute_path_to_pose")
        self.through = ActionClient(
            self.node, ComputePathThroughPoses, "compute_path_through_poses"
        )

    def _spin(self) -> None:
        try:
            self.executor.spin()
        except ExternalShutdownException:
            pass

    def close(self) -> None:
        self.executor.shutdown()
        if self.thread.ident is not None:
            self.thread.join(5.0)
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)

    # What a robot sends.

    def publisher(self, kind: Any, topic: str, qos: Any = LATCHED) -> Any:
        if topic not in self._publishers:
            self._publishers[topic] = self.node.create_publisher(kind, topic, qos)
        return self._publishers[topic]

    def send_map(self, cells: np.ndarray, resolution: float = 0.1, **changes: Any) -> None:
        self.publisher(OccupancyGrid, changes.pop("topic", "map")).publish(
            map_message(cells, resolution, **changes)
        )

    def send_update(self, cells: np.ndarray, col: int, row: int) -> None:
        message = OccupancyGridUpdate(x=col, y=row, height=cells.shape[0], width=cells.shape[1])
        message.header.frame_id = "map"
        message.data = array("b", np.ascontiguousarray(cells, dtype=np.int8).tobytes())
        publisher = self.publisher(OccupancyGridUpdate, "map_updates", 10)
        wait_until(lambda: publisher.get_subscription_count() > 0, "a reader of updates")
        publisher.publish(message)

    def send_tf(
        self,
        parent: str,
        child: str,
        pose: tuple[float, float, float],
        *,
        age_s: float = 0.0,
        is_static: bool = False,
    ) -> None:
        stamped = TransformStamped(child_frame_id=child)
        stamped.header.frame_id = parent
        stamp_s = time.time() - age_s
        stamped.header.stamp.sec = int(stamp_s)
        stamped.header.stamp.nanosec = int(stamp_s % 1.0 * 1e9)
        stamped.transform.translation.x, stamped.transform.translation.y = pose[:2]
        stamped.transform.rotation.z = math.sin(pose[2] / 2)
        stamped.transform.rotation.w = math.cos(pose[2] / 2)
        if is_static:
            self.publisher(TFMessage, "/tf_static").publish(TFMessage(transforms=[stamped]))
            return
        publisher = self.publisher(TFMessage, "/tf", 100)
        wait_until(lambda: publisher.get_subscription_count() > 0, "a reader of transforms")
        publisher.publish(TFMessage(transforms=[stamped]))

    # What a behavior tree asks.

    def ask(self, goal: tuple[float, float, float] | PoseStamped, **how: Any) -> Any:
        """Ask for a path to a pose, and return the handle of the accepted goal."""
        stamped = goal if isinstance(goal, PoseStamped) else pose(*goal)
        return self.send(self.to_pose, request(ComputePathToPose.Goal(goal=stamped), **how))

    def ask_through(self, goals: list[Any], **how: Any) -> Any:
        asked = ComputePathThroughPoses.Goal()
        poses = [goal if isinstance(goal, PoseStamped) else pose(*goal) for goal in goals]
        if hasattr(asked.goals, "goals"):
            asked.goals.goals = poses
            asked.goals.header.frame_id = "map"
        else:
            asked.goals = poses
        return self.send(self.through, request(asked, **how))

    def send(self, client: ActionClient, goal: Any) -> Any:
        assert client.wait_for_server(PATIENCE_S), "no action server"
        self._let_meet(client)
        # On the thread that spins: an answer that is quicker than the sender would be dropped.
        sending = self.executor.create_task(client.send_goal_async, goal)
        return self.result(self.result(sending))

    def _let_meet(self, client: Any) -> None:
        """Wait until answers reach a new client too, which may be later than its requests do."""
        if client not in self._met:
            time.sleep(MEETING_S)
            self._met.append(client)

    def plan(self, goal: Any, **how: Any) -> Any:
        """Ask for a path to a pose, and return status and result."""
        return self.outcome(self.ask(goal, **how))

    def plan_through(self, goals: list[Any], **how: Any) -> Any:
        return self.outcome(self.ask_through(goals, **how))

    def outcome(self, handle: Any) -> Any:
        assert handle.accepted
        return self.result(handle.get_result_async())

    def result(self, future: Any) -> Any:
        wait_until(future.done, "an answer")
        return future.result()

    # Services.

    def call(self, kind: Any, name: str, asked: Any) -> Any:
        if name not in self._clients:
            self._clients[name] = self.node.create_client(kind, name)
        assert self._clients[name].wait_for_service(PATIENCE_S), f"no service {name}"
        self._let_meet(self._clients[name])
        return self.result(self._clients[name].call_async(asked))

    def change(self, transition: str) -> bool:
        number = getattr(Transition, f"TRANSITION_{transition.upper()}")
        asked = ChangeState.Request(transition=Transition(id=number))
        return bool(self.call(ChangeState, "planner_server/change_state", asked).success)

    def state(self) -> str:
        answer = self.call(GetState, "planner_server/get_state", GetState.Request())
        return str(answer.current_state.label)

    def set(self, name: str, value: Any) -> Any:
        asked = SetParameters.Request(parameters=[Parameter(name=name, value=typed(value))])
        return self.call(SetParameters, "planner_server/set_parameters", asked).results[0]

    def parameters(self) -> list[str]:
        answer = self.call(
            ListParameters, "planner_server/list_parameters", ListParameters.Request()
        )
        return list(answer.result.names)

    def describe(self, name: str) -> Any:
        asked = DescribeParameters.Request(names=[name])
        answer = self.call(DescribeParameters, "planner_server/describe_parameters", asked)
        return answer.descriptors[0]

    def hear(self, kind: Any, topic: str, qos: Any = 10) -> list[Any]:
        """Return the list into which the messages of a topic go."""
        heard: list[Any] = []
        self.node.create_subscription(kind, topic, heard.append, qos)
        return heard


def typed(value: Any) -> ParameterValue:
    if isinstance(value, bool):
        return ParameterValue(type=1, bool_value=value)
    if isinstance(value, int):
        return ParameterValue(type=2, integer_value=value)
    if isinstance(value, float):
        return ParameterValue(type=3, double_value=value)
    return ParameterValue(type=4, string_value=value)


def request(goal: Any, start: Any = None, planner_id: str = "") -> Any:
    goal.planner_id = planner_id
    if start is not None:
        goal.use_start = True
        goal.start = start if isinstance(start, PoseStamped) else pose(*start)
    return goal


def pose(x: float, y: float, yaw: float, frame: str = "map") -> PoseStamped:
    stamped = PoseStamped()
    stamped.header.frame_id = frame
    stamped.pose.position.x, stamped.pose.position.y = float(x), float(y)
    stamped.pose.orientation.z = math.sin(yaw / 2)
    stamped.pose.orientation.w = math.cos(yaw / 2)
    return stamped


def map_message(cells: np.ndarray, resolution: float, **changes: Any) -> OccupancyGrid:
    message = OccupancyGrid()
    message.header.frame_id = changes.get("frame", "map")
    message.info.resolution = resolution
    message.info.height, message.info.width = cells.shape
    x, y, yaw = changes.get("origin", (0.0, 0.0, 0.0))
    message.info.origin = pose(x, y, yaw).pose
    if "orientation" in changes:
        message.info.origin.orientation = changes["orientation"]
    message.data = array("b", np.ascontiguousarray(cells, dtype=np.int8).tobytes())
    return message


def rows(path: Path) -> np.ndarray:
    """Return the rows ``x, y, yaw`` of a path."""
    found = [
        (
            p.pose.position.x,
            p.pose.position.y,
            2.0 * math.atan2(p.pose.orientation.z, p.pose.orientation.w),
        )
        for p in path.poses
    ]
    return np.array(found).reshape(-1, 3)


def wait_until(is_done: Callable[[], Any], what: str) -> None:
    until = time.monotonic() + PATIENCE_S
    while not is_done():
        assert time.monotonic() < until, f"waited {PATIENCE_S:g} s for {what}"
        time.sleep(0.002)
