"""The bond by which a lifecycle manager knows that a node lives."""

from __future__ import annotations

import uuid
from typing import Any

from rclpy.qos import QoSProfile

from .interfaces import optional

TIMEOUT_S = 4.0


class Bond:
    """Heartbeats on the topic `bond`, from activation to deactivation."""

    def __init__(self, node: Any, period_s: float) -> None:
        self._node, self._period_s = node, period_s
        self._status = optional("bond.msg", "Status")
        self._publisher: Any = None
        self._timer: Any = None
        self._id = ""

    def form(self) -> None:
        """Begin to beat."""
        if self._status is None or self._period_s <= 0.0:
            return
        self._id = uuid.uuid4().hex
        if self._publisher is None:
            quality = QoSProfile(depth=100)
            self._publisher = self._node.create_publisher(self._status, "bond", quality)
        self._timer = self._node.create_timer(self._period_s, self._beat)

    def break_(self) -> None:
        """Say goodbye; the publisher stays, so that the last word is delivered."""
        if self._timer is None:
            return
        self._node.destroy_timer(self._timer)
        self._timer = None
        self._publish(active=False)

    def destroy(self) -> None:
        """Give back the publisher."""
        if self._publisher is not None:
            self._node.destroy_publisher(self._publisher)
            self._publisher = None

    def _beat(self) -> None:
        self._publish(active=True)

    def _publish(self, *, active: bool) -> None:
        message = self._status()
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.id = self._node.get_name()
        message.instance_id = self._id
        message.active = active
        message.heartbeat_timeout = TIMEOUT_S
        message.heartbeat_period = self._period_s
        self._publisher.publish(message)
