"""What the node says of itself on `/diagnostics`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .interfaces import optional

PERIOD_S = 1.0

Health = tuple[bool, str, Mapping[str, Any]]


class Diagnostics:
    """A status once a second: well or not, a sentence, and values."""

    def __init__(self, node: Any, health: Callable[[], Health]) -> None:
        self._node, self._health = node, health
        self._array = optional("diagnostic_msgs.msg", "DiagnosticArray")
        self._status = optional("diagnostic_msgs.msg", "DiagnosticStatus")
        self._value = optional("diagnostic_msgs.msg", "KeyValue")
        self._publisher: Any = None
        if self._array is not None:
            self._publisher = node.create_publisher(self._array, "/diagnostics", 10)
            self._timer = node.create_timer(PERIOD_S, self._publish)

    def destroy(self) -> None:
        """End."""
        if self._publisher is not None:
            self._node.destroy_timer(self._timer)
            self._node.destroy_publisher(self._publisher)
            self._publisher = None

    def _publish(self) -> None:
        is_well, sentence, values = self._health()
        status = self._status()
        status.level = self._status.OK if is_well else self._status.WARN
        status.name = f"{self._node.get_name()}: planning"
        status.message = sentence
        status.hardware_id = "formicar"
        status.values = [self._value(key=key, value=str(value)) for key, value in values.items()]
        message = self._array(status=[status])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)
