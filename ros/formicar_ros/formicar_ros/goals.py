"""Goals of one action: the newest wins, any can be canceled, each ends with a result."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup

from .codes import Code, Failed, Stopped
from .interfaces import put
from .planning import Ticket

CANCELED = "the goal was canceled"
PREEMPTED = "a newer goal has taken the place of this one"

# How long a worker waits for the state that follows an accepted cancel.
_CANCEL_WAIT_S = 0.5


class GoalLine:
    """An action server whose goals follow one another.

    Parameters
    ----------
    node
        The node.
    action, name
        Type and name of the action.
    base : int
        What the action's codes count from.
    work : callable
        Takes goal and ticket, and returns the fields of the result. It runs beside the thread that
        answers, and raises `Failed` or `Stopped`.
    accepts : callable
        Returns True while goals are welcome.
    result_timeout_s : float
        How long results are kept.
    """

    def __init__(
        self,
        node: Any,
        action: Any,
        name: str,
        *,
        base: int,
        work: Callable[[Any, Ticket], dict[str, Any]],
        accepts: Callable[[], bool],
        result_timeout_s: float,
    ) -> None:
        self._action, self._name, self._base = action, name, base
        self._work, self._accepts = work, accepts
        self._log = node.get_logger()
        self._lock = threading.Lock()
        self._tickets: dict[bytes, Ticket] = {}
        self._server = ActionServer(
            node,
            action,
            name,
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
            callback_group=MutuallyExclusiveCallbackGroup(),
            result_timeout=result_timeout_s,
        )

    def stop_all(self, reason: str) -> None:
        """End every goal that is under way."""
        with self._lock:
            tickets = list(self._tickets.values())
        for ticket in tickets:
            ticket.stop(reason)

    def destroy(self) -> None:
        """End every goal, and the server."""
        self.stop_all("the server is shut down")
        self._server.destroy()

    def _on_goal(self, _: Any) -> GoalResponse:
        if self._accepts():
            return GoalResponse.ACCEPT
        self._log.warning(f"{self._name}: a goal is rejected: the node is not active")
        return GoalResponse.REJECT

    def _on_accepted(self, handle: Any) -> None:
        with self._lock:
            older = list(self._tickets.values())
            self._tickets[bytes(handle.goal_id.uuid)] = Ticket()
        for ticket in older:
            ticket.stop(PREEMPTED)
        handle.execute()

    def _on_cancel(self, handle: Any) -> CancelResponse:
        ticket = self._tickets.get(bytes(handle.goal_id.uuid))
        if ticket is not None:
            ticket.stop(CANCELED)
        return CancelResponse.ACCEPT

    def _execute(self, handle: Any) -> Any:
        key = bytes(handle.goal_id.uuid)
        ticket = self._tickets[key]
        result = self._action.Result()
        try:
            put(result, **self._work(handle.request, ticket))
            self._end_well(handle, result)
        except Stopped as stopped:
            self._end_stopped(handle, ticket, result, str(stopped))
        except Failed as failed:
            self._end_failed(handle, ticket, result, failed)
        except Exception as error:  # A goal never takes the node with it.
            self._log.error(f"{self._name}: internal failure: {type(error).__name__}: {error}")
            failure = Failed(Code.UNKNOWN, f"internal failure: {error}")
            self._end_failed(handle, ticket, result, failure)
        finally:
            with self._lock:
                self._tickets.pop(key, None)
        return result

    def _end_well(self, handle: Any, result: Any) -> None:
        if handle.is_cancel_requested:
            # The cancel came after the path was found.
            put(result, error_msg=CANCELED)
            handle.canceled()
        else:
            handle.succeed()

    def _end_stopped(self, handle: Any, ticket: Ticket, result: Any, reason: str) -> None:
        put(result, error_msg=reason)
        if ticket.reason == CANCELED and _is_canceling(handle):
            handle.canceled()
            return
        put(result, error_code=self._base + Code.UNKNOWN)
        self._log.info(f"{self._name}: {reason}")
        handle.abort()

    def _end_failed(self, handle: Any, ticket: Ticket, result: Any, failed: Failed) -> None:
        if ticket.is_stopped and ticket.reason == CANCELED:
            self._end_stopped(handle, ticket, result, CANCELED)
            return
        put(result, error_code=self._base + failed.code, error_msg=failed.sentence)
        self._log.warning(
            f"{self._name}: {failed.code.name} {self._base + failed.code}: {failed.sentence}"
        )
        handle.abort()


def _is_canceling(handle: Any) -> bool:
    """Return True if the goal is in the state from which it may end as canceled.

    The state follows the callback that accepts the cancel, on the thread that answers.
    """
    until = time.monotonic() + _CANCEL_WAIT_S
    while not handle.is_cancel_requested and time.monotonic() < until:
        time.sleep(0.0005)
    return bool(handle.is_cancel_requested)
