"""The planner server: what Nav2 asks of `planner_server`, answered with certified paths."""

from __future__ import annotations

import sys
import time
from array import array
from typing import Any

import formicar
import numpy as np
import rclpy
from builtin_interfaces.msg import Duration
from nav2_msgs.action import ComputePathThroughPoses, ComputePathToPose
from nav2_msgs.srv import ClearEntireCostmap, IsPathValid
from nav_msgs.msg import OccupancyGrid, Path
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Header
from visualization_msgs.msg import MarkerArray

from .bond import Bond
from .codes import THROUGH_POSES, TO_POSE, Code, Failed
from .diagnostics import Diagnostics, Health
from .executor import PlanningExecutor
from .goals import GoalLine
from .interfaces import goals_of, put, value_of
from .listening import Listening
from .maps import MapStore
from .markers import markers_of
from .parameter_node import ParameterNode
from .paths import path_of, rows_of
from .planning import Scene, Ticket
from .poses import message_of
from .queries import Frames, query_of
from .transforms import NoTransform, Transforms
from .validity import Validity, cut, first_ahead, judged
from .vehicles import corners_of

LATCHED = QoSProfile(
    depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, reliability=ReliabilityPolicy.RELIABLE
)

# How often the map that is planned on is shown, if it has changed, seconds.
SHOW_S = 0.5


class PlannerServer(ParameterNode):
    """Plans for Nav2.

    A lifecycle node; with the parameter `autostart` it configures and activates itself.
    """

    def __init__(self, **how: Any) -> None:
        super().__init__("planner_server", **how)
        self._is_active = False
        self._transforms = Transforms()
        self._store = MapStore()
        self._scene: Scene | None = None
        self._lines: list[GoalLine] = []
        self._made: list[tuple[Any, Any]] = []
        self._last = "no goal yet"
        self._is_well = True
        self._plan_s = 0.0
        self._bond: Bond | None = None
        self._diagnostics: Diagnostics | None = None
        self._listening: Listening | None = None

    def start_alone(self) -> bool:
        """Configure and activate, and return True if both have worked."""
        done = TransitionCallbackReturn.SUCCESS
        return bool(self.trigger_configure() == done and self.trigger_activate() == done)

    def stop(self) -> None:
        """End every goal, before the executor waits for its workers."""
        for line in self._lines:
            line.stop_all("the node is shut down")

    def close(self) -> None:
        """Destroy everything that is made while the node is configured."""
        self._is_active = False
        self._close()

    # What a lifecycle manager asks.

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Check the parameters, and listen to the map and to transforms."""
        try:
            self.configure_settings()
        except Exception as error:  # A manager wants an answer; any cause is logged.
            self.drop_settings()
            self.get_logger().error(f"not configured: {error}")
            return TransitionCallbackReturn.FAILURE
        self._scene = Scene(self._store, self.settings, int(self.value("n_threads")))
        self._open()
        return super().on_configure(state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Take goals."""
        self._is_active = True
        assert self._bond is not None, "the node is configured"
        self._bond.form()
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Take no more goals, and end those under way."""
        self._rest()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Forget the map and everything else."""
        self._close()
        return super().on_cleanup(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """End."""
        self._rest()
        self._close()
        return super().on_shutdown(state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Begin again, unconfigured."""
        self._rest()
        self._close()
        return TransitionCallbackReturn.SUCCESS

    def on_settings_changed(self) -> None:
        """Plan by the new settings from the next goal on."""
        if self._scene is not None:
            self._scene.settings = self.settings

    def _rest(self) -> None:
        self._is_active = False
        for line in self._lines:
            line.stop_all("the node is deactivated")
        if self._bond is not None:
            self._bond.break_()

    # What exists while the node is configured.

    def _open(self) -> None:
        self._bond = Bond(self, float(self.value("bond_heartbeat_period")))
        self._plan_publisher = self._publisher(Path, "plan", 1)
        self._marker_publisher = self._publisher(MarkerArray, "plan_markers", 1)
        self._costmap_publisher: Any = None
        self._open_costmap()
        self._listening = Listening(self, self._store, self._transforms)
        service = self.create_service(IsPathValid, "is_path_valid", self._on_is_path_valid)
        self._made.append((self.destroy_service, service))
        kept_s = float(self.value("action_server_result_timeout"))
        self._lines = [
            GoalLine(
                self,
                action,
                name,
                base=base,
                work=work,
                accepts=lambda: self._is_active,
                result_timeout_s=kept_s,
            )
            for action, name, base, work in (
                (ComputePathToPose, "compute_path_to_pose", TO_POSE, self._to_pose),
                (
                    ComputePathThroughPoses,
                    "compute_path_through_poses",
                    THROUGH_POSES,
                    self._through_poses,
                ),
            )
        ]
        self._diagnostics = Diagnostics(self, self._health)

    def _open_costmap(self) -> None:
        """Offer what behavior trees expect of a global costmap, unless there is one already."""
        own = self.resolve_topic_name("global_costmap/costmap")
        if not self.value("publish_costmap") or own == self.resolve_topic_name(
            self.value("map_topic")
        ):
            return
        self._costmap_publisher = self.create_publisher(OccupancyGrid, own, LATCHED)
        self._made.append((self.destroy_publisher, self._costmap_publisher))
        self._n_shown = 0
        self._made.append((self.destroy_timer, self.create_timer(SHOW_S, self._show_map)))
        clear = self.create_service(
            ClearEntireCostmap, "global_costmap/clear_entirely_global_costmap", self._on_clear
        )
        self._made.append((self.destroy_service, clear))

    def _publisher(self, kind: Any, topic: str, depth: int) -> Any:
        publisher = self.create_publisher(kind, topic, depth)
        self._made.append((self.destroy_publisher, publisher))
        return publisher

    def _close(self) -> None:
        for line in self._lines:
            line.destroy()
        for destroy, entity in self._made:
            destroy(entity)
        for part in (self._listening, self._diagnostics, self._bond):
            if part is not None:
                part.destroy()
        self._lines, self._made = [], []
        self._listening = self._diagnostics = self._bond = None
        self._scene = None
        self._store.clear()
        self._transforms.clear()
        self.drop_settings()

    # What clients ask.

    def _to_pose(self, goal: Any, ticket: Ticket) -> dict[str, Any]:
        points = [
            self._frames().pose(stamped, f"via point {n}")[:2]
            for n, stamped in enumerate(value_of(goal, "viapoints", []), 1)
        ]
        return self._answer(goal, [(goal.goal, "")], points, ticket)

    def _through_poses(self, goal: Any, ticket: Ticket) -> dict[str, Any]:
        goals, frame = goals_of(goal)
        if not goals:
            raise Failed(Code.NO_VIAPOINTS_GIVEN, "goals is empty; it must hold one pose or more")
        fields = self._answer(goal, [(pose, frame) for pose in goals], [], ticket)
        return {**fields, "last_reached_index": len(goals) - 1}

    def _answer(
        self,
        goal: Any,
        goals: list[tuple[Any, str]],
        points: list[tuple[float, float]],
        ticket: Ticket,
    ) -> dict[str, Any]:
        """Plan, publish, and return the fields of the result."""
        begun = time.monotonic()
        try:
            planner_id = self._planner_id(goal.planner_id)
            start = goal.start if goal.use_start else None
            query = query_of(self._frames(), planner_id, goals, start, ticket, points)
            self._wait_for_map(ticket)
            assert self._scene is not None, "the node is configured"
            plan = self._scene.plan(query, ticket)
        except Failed as failed:
            self._is_well, self._last = False, failed.sentence
            raise
        path = self._published(plan)
        self._note_time(time.monotonic() - begun, plan)
        return {"path": path, "planning_time": _duration(time.monotonic() - begun)}

    def _planner_id(self, asked: str) -> str:
        known = list(self.settings.planners)
        if not asked and len(known) == 1:
            return known[0]
        if asked not in known:
            raise Failed(
                Code.INVALID_PLANNER,
                f"planner_id = {asked!r}; there are {', '.join(known)}; hint: "
                "planner_plugins names them",
            )
        return asked

    def _wait_for_map(self, ticket: Ticket) -> None:
        until = time.monotonic() + float(self.value("costmap_update_timeout"))
        while self._store.frame is None:
            if time.monotonic() > until:
                topic = self.resolve_topic_name(self.value("map_topic"))
                raise Failed(
                    Code.TIMEOUT,
                    f"no map on {topic} within {self.value('costmap_update_timeout'):g} s; hint: "
                    "map_topic names the topic, map_subscribe_transient_local fits its durability",
                )
            ticket.wait(0.01)

    def _published(self, plan: formicar.Plan) -> Path:
        header = Header(frame_id=self._frames().fixed, stamp=self.get_clock().now().to_msg())
        path = path_of(rows_of(plan), header)
        if self._plan_publisher.get_subscription_count():
            self._plan_publisher.publish(path)
        if self._marker_publisher.get_subscription_count():
            self._marker_publisher.publish(markers_of(plan, header))
        return path

    def _note_time(self, took_s: float, plan: formicar.Plan) -> None:
        self._is_well, self._plan_s, self._last = True, took_s, repr(plan)
        expected_hz = float(self.value("expected_planner_frequency"))
        if expected_hz > 0.0 and took_s > 1.0 / expected_hz:
            self.get_logger().warning(
                f"planning took {took_s:.2f} s, longer than the {1.0 / expected_hz:.2f} s of "
                "expected_planner_frequency"
            )

    def _on_is_path_valid(self, request: Any, response: Any) -> Any:
        try:
            verdict = self._verdict(request)
        except (Failed, ValueError) as error:
            self.get_logger().warning(f"is_path_valid: {error}")
            put(response, success=False, is_valid=False)
            return response
        if verdict.sentence:
            self.get_logger().debug(f"is_path_valid: {verdict.sentence}")
        put(response, success=True, is_valid=verdict.is_valid)
        put(response, invalid_pose_indices=verdict.indices)
        return response

    def _verdict(self, request: Any) -> Validity:
        vehicle, grid = self._judged_by(request)
        frames = self._frames()
        frame = request.path.header.frame_id
        rows = np.array(
            [frames.pose(pose, f"pose {n}", frame) for n, pose in enumerate(request.path.poses)]
        ).reshape(-1, 3)
        if not len(rows):
            raise formicar.InvalidPath("the path is empty")
        first = first_ahead(rows, self._robot_position())
        ahead = cut(rows[first:], value_of(request, "max_lookahead_distance", -1.0))
        verdict = judged(ahead, grid, vehicle, first=first)
        if value_of(request, "stop_at_first_collision", False):
            return Validity(verdict.is_valid, verdict.indices[:1], verdict.sentence)
        return verdict

    def _judged_by(self, request: Any) -> tuple[formicar.Vehicle, formicar.OccupancyGrid]:
        layer = value_of(request, "layer_name", "")
        if layer:
            raise Failed(Code.UNKNOWN, f"layer_name = {layer!r}; the map has no layers")
        vehicle = self.settings.vehicle
        footprint = value_of(request, "footprint", "")
        if footprint:
            radius = vehicle.min_turning_radius
            vehicle = formicar.Vehicle(footprint=corners_of(footprint), min_turning_radius_m=radius)
        first = next(iter(self.settings.planners.values()))
        blocks = value_of(request, "consider_unknown_as_obstacle", not first.allow_unknown)
        grid = self._store.grid(unknown_is_free=not blocks)
        if grid is None:
            raise Failed(Code.UNKNOWN, "there is no map yet")
        return vehicle, grid

    def _robot_position(self) -> tuple[float, float] | None:
        try:
            return self._frames().robot()[:2]
        except NoTransform:
            return None

    def _on_clear(self, _: Any, response: Any) -> Any:
        if self._scene is not None:
            self._scene.forget()
        put(response, success=True)
        return response

    def _show_map(self) -> None:
        """Show the map that is planned on, as a global costmap does, if it has changed."""
        number, frame = self._store.number, self._store.frame
        if frame is None or number == self._n_shown:
            return
        self._n_shown = number
        message = OccupancyGrid()
        message.header.frame_id = self._frames().fixed
        message.header.stamp = self.get_clock().now().to_msg()
        message.info.resolution = frame.resolution
        message.info.height, message.info.width = frame.data.shape
        message.info.origin = message_of(frame.origin)
        message.data = _bytes_of(frame.data)
        self._costmap_publisher.publish(message)

    def _frames(self) -> Frames:
        return Frames(
            self._transforms,
            self.get_clock(),
            self.value("global_frame"),
            self.value("robot_base_frame"),
            float(self.value("transform_tolerance")),
        )

    def _health(self) -> Health:
        frame = self._store.frame
        values: dict[str, Any] = {
            "active": self._is_active,
            "planning time of the last path, s": f"{self._plan_s:.3f}",
            "changes of the map": self._store.number,
        }
        if frame is None:
            return False, "no map yet", values
        return self._is_well, self._last, values


def _duration(seconds: float) -> Duration:
    return Duration(sec=int(seconds), nanosec=int(seconds % 1.0 * 1e9))


def _bytes_of(cells: Any) -> Any:
    """Return cells as the array type that messages take without looking at every value."""
    return array("b", np.ascontiguousarray(cells).tobytes())


def _spin(executor: PlanningExecutor, node: PlannerServer) -> None:
    """Spin, and outlive callbacks that fail."""
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        raise
    except Exception as error:  # One message or request must not end the node.
        node.get_logger().error(f"internal failure: {type(error).__name__}: {error}")


def main(args: list[str] | None = None) -> None:
    """Run the node until it is shut down."""
    # A thread that makes a long message lets the one that answers in after a millisecond.
    sys.setswitchinterval(0.001)
    rclpy.init(args=args)
    node = PlannerServer()
    executor = PlanningExecutor()
    executor.add_node(node)
    try:
        if node.value("autostart"):
            node.start_alone()
        while rclpy.ok():
            _spin(executor, node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.stop()
        executor.shutdown()
        # Goals before their server, and it before the node: rclpy does not keep them in order.
        node.close()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
