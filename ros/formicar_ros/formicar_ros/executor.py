"""An executor that answers while a goal is planned."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Task

# Goals that are preempted leave within milliseconds; a few threads let the newest one in meanwhile.
N_WORKERS = 4


class PlanningExecutor(SingleThreadedExecutor):  # type: ignore[misc]
    """Runs callbacks one after another, and tasks, which goals are, on threads of their own.

    So a goal is accepted, preempted and canceled by a thread that never plans. In a
    ``MultiThreadedExecutor`` the server works as well, with a longer way to every callback.
    """

    def __init__(self, **how: Any) -> None:
        super().__init__(**how)
        self._workers = ThreadPoolExecutor(N_WORKERS, thread_name_prefix="plan")

    def create_task(self, callback: Callable[..., Any], *args: Any, **kwargs: Any) -> Task:
        """Run a callback on a worker, and return its future."""
        task = Task(callback, args, kwargs)
        self._workers.submit(task)
        return task

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Wait for the workers, and end."""
        self._workers.shutdown(wait=True, cancel_futures=True)
        return bool(super().shutdown(timeout_sec))
