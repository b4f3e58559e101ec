"""What the node hears: the map, its updates, and transforms."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from .interfaces import optional
from .maps import MapStore, cells_of_update, frame_of_costmap, frame_of_grid
from .poses import BadPose, pose_of_transform
from .transforms import Transforms

# How often a message that cannot be used is reported, seconds.
_REPORT_S = 5.0


class Listening:
    """The subscriptions. A message that cannot be used is reported, and changes nothing."""

    def __init__(self, node: Any, store: MapStore, transforms: Transforms) -> None:
        self._node, self._store, self._transforms = node, store, transforms
        self._fixed = node.value("global_frame").lstrip("/")
        self._subscriptions: list[Any] = []
        self._reported: dict[str, float] = {}
        self._hear_map()
        self._hear_transforms()

    def destroy(self) -> None:
        """End the subscriptions."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._subscriptions = []

    def _hear_map(self) -> None:
        topic, kind = self._node.value("map_topic"), self._node.value("map_type")
        if kind == "costmap":
            message_type = optional("nav2_msgs.msg", "Costmap")
            frame_of = frame_of_costmap
        else:
            message_type, frame_of = OccupancyGrid, frame_of_grid
        self._subscribe(message_type, topic, lambda m: self._take_map(m, frame_of), self._map_qos())
        update = optional("map_msgs.msg", "OccupancyGridUpdate")
        if update is not None and kind != "costmap":
            self._subscribe(update, f"{topic}_updates", self._take_update, 10)

    def _map_qos(self) -> QoSProfile:
        is_latched = self._node.value("map_subscribe_transient_local")
        durability = DurabilityPolicy.TRANSIENT_LOCAL if is_latched else DurabilityPolicy.VOLATILE
        return QoSProfile(depth=1, durability=durability, reliability=ReliabilityPolicy.RELIABLE)

    def _hear_transforms(self) -> None:
        message_type = optional("tf2_msgs.msg", "TFMessage")
        if message_type is None:
            self._node.get_logger().warning("tf2_msgs is missing: goals must bring their start")
            return
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._subscribe(message_type, "/tf", lambda m: self._take_tf(m, is_static=False), 100)
        self._subscribe(
            message_type, "/tf_static", lambda m: self._take_tf(m, is_static=True), latched
        )

    def _subscribe(
        self, kind: Any, topic: str, callback: Callable[[Any], None], qos: QoSProfile | int
    ) -> None:
        self._subscriptions.append(self._node.create_subscription(kind, topic, callback, qos))

    def _take_map(self, message: Any, frame_of: Callable[[Any], Any]) -> None:
        frame = message.header.frame_id.lstrip("/")
        if frame and frame != self._fixed:
            self._report(f"map: it is in frame {frame!r}, and global_frame is {self._fixed!r}")
            return
        try:
            self._store.replace(frame_of(message))
        except (ValueError, TypeError) as error:
            self._report(f"map: {error}")

    def _take_update(self, message: Any) -> None:
        try:
            self._store.patch(cells_of_update(message), message.x, message.y)
        except ValueError as error:
            self._report(f"map update: {error}")

    def _take_tf(self, message: Any, *, is_static: bool) -> None:
        for stamped in message.transforms:
            stamp = stamped.header.stamp
            try:
                pose = pose_of_transform(stamped.transform)
            except BadPose as error:
                parent, child = stamped.header.frame_id, stamped.child_frame_id
                self._report(f"transform from {parent!r} to {child!r}: {error}")
                continue
            self._transforms.add(
                stamped.header.frame_id,
                stamped.child_frame_id,
                stamp.sec + 1e-9 * stamp.nanosec,
                pose,
                is_static=is_static,
            )

    def _report(self, sentence: str) -> None:
        """Log an error, and the same one not again for a while."""
        now = time.monotonic()
        self._reported = {s: t for s, t in self._reported.items() if now - t < _REPORT_S}
        if sentence not in self._reported:
            self._reported[sentence] = now
            self._node.get_logger().error(sentence)
