"""Latencies of the planner server, beside the library alone.

    python benches/latency.py [N]

A server in a process of its own plans on the built-in map warehouse between random free poses. Of N
goals, milliseconds from sending to acceptance and to the result; of N goals that are canceled 5 ms
after acceptance, from the cancel to the result. In turn with them, N goals to an action server of
rclpy that does nothing, which is the least that rclpy takes here.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import formicar
import numpy as np
import rclpy
from nav2_msgs.action import ComputePathToPose
from rclpy.action import ActionClient, ActionServer

sys.path.insert(0, str(Path(__file__).parents[1]))

from tests import domains  # noqa: E402
from tests.peer import CANCELED, SUCCEEDED, Peer, pose, request  # noqa: E402

MAP, VEHICLE = "warehouse", "warehouse_amr"
Pose = tuple[float, float, float]


def pairs(grid: formicar.OccupancyGrid) -> Iterator[tuple[Pose, Pose]]:
    """Yield free poses, two by two."""
    rng = np.random.default_rng(1)
    width, height = grid.extent

    def free_pose() -> Pose:
        while True:
            x, y = rng.uniform(0, width) + grid.origin[0], rng.uniform(0, height) + grid.origin[1]
            pose = (float(x), float(y), float(rng.uniform(-np.pi, np.pi)))
            if formicar.check(np.array([pose]), grid, VEHICLE):
                return pose

    while True:
        yield free_pose(), free_pose()


def main() -> None:
    """Measure and print."""
    if sys.argv[1:] == ["--serve"]:
        serve_nothing()
        return
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    grid = formicar.OccupancyGrid.builtin(MAP)
    options = ["autostart:=true", f"vehicle.preset:={VEHICLE}", "expected_planner_frequency:=0.0"]
    given = [part for option in options for part in ("-p", option)]
    with servers_and_peer(given) as peer:
        peer.send_map(grid.data, grid.resolution, origin=grid.origin)
        show(measured(peer, formicar.Planner(grid, VEHICLE), n))


@contextmanager
def servers_and_peer(given: list[str]) -> Iterator[Peer]:
    """Run the planner server and a bare one, in a domain of their own."""
    domain = domains.claim()
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain)}
    commands = (["-m", "formicar_ros.planner_server", "--ros-args", *given], [__file__, "--serve"])
    servers = [subprocess.Popen([sys.executable, *c], env=environment) for c in commands]
    peer = Peer(domain, is_threaded=False)
    try:
        yield peer
    finally:
        for server in servers:
            server.kill()
            server.wait(20)
        peer.close()
        domains.release(domain)


def serve_nothing() -> None:
    """Accept every goal, and do nothing for it."""
    rclpy.init()
    node = rclpy.create_node("bare")

    def execute(handle: Any) -> Any:
        handle.succeed()
        return ComputePathToPose.Result()

    ActionServer(node, ComputePathToPose, "bare", execute)
    rclpy.spin(node)


def show(times: dict[str, list[float]]) -> None:
    """Print a table."""
    print("| | n | median ms | 99 % ms |\n|---|---|---|---|")
    for name, values in times.items():
        low, high = np.percentile(np.array(values) * 1e3, [50, 99])
        print(f"| {name} | {len(values)} | {low:.1f} | {high:.1f} |", flush=True)


def measured(peer: Peer, planner: formicar.Planner, n: int) -> dict[str, list[float]]:
    """Ask for paths, cancel goals, and return times in seconds."""
    names = ("library", "acceptance", "bare acceptance", "result", "added", "cancel")
    times: dict[str, list[float]] = {name: [] for name in names}
    between = pairs(planner.map)
    bare = ActionClient(peer.node, ComputePathToPose, "bare")
    assert peer.to_pose.wait_for_server(20.0) and bare.wait_for_server(20.0)
    time.sleep(1.0)
    for k in range(2 * n + 10):
        start, goal = next(between)
        taken = canceled(peer, start, goal) if k % 2 else planned(peer, planner, start, goal)
        if not k % 2:
            handle, taken["bare acceptance"], _ = accepted(peer, bare, start, goal)
            waited(peer, handle.get_result_async())
        if k >= 10:  # The first ones find the other side, and wait for the map.
            for name, value in taken.items():
                times[name].append(value)
    return times


def planned(peer: Peer, planner: formicar.Planner, start: Pose, goal: Pose) -> dict[str, float]:
    """Return the times of a goal, and that of the library alone."""
    handle, acceptance_s, sent = accepted(peer, peer.to_pose, start, goal)
    answer = waited(peer, handle.get_result_async())
    result_s = time.perf_counter() - sent
    begun = time.perf_counter()
    plan = planner.plan(start, goal, deadline_s=5.0)
    library_s = time.perf_counter() - begun
    assert (answer.status == SUCCEEDED) == bool(plan), answer.result.error_msg
    return {
        "library": library_s,
        "acceptance": acceptance_s,
        "result": result_s,
        "added": result_s - library_s,
    }


def canceled(peer: Peer, start: Pose, goal: Pose) -> dict[str, float]:
    """Return how long a cancel takes; nothing if the path was quicker."""
    handle, _, _ = accepted(peer, peer.to_pose, start, goal)
    ending = handle.get_result_async()
    time.sleep(0.005)
    begun = time.perf_counter()
    handle.cancel_goal_async()
    answer = waited(peer, ending)
    taken_s = time.perf_counter() - begun
    return {"cancel": taken_s} if answer.status == CANCELED else {}


def accepted(peer: Peer, client: Any, start: Pose, goal: Pose) -> tuple[Any, float, float]:
    """Send a goal, and return its handle, the time to its acceptance, and when it was sent."""
    asked = request(ComputePathToPose.Goal(goal=pose(*goal)), start=start)
    sent = time.perf_counter()
    handle = waited(peer, client.send_goal_async(asked))
    assert handle.accepted
    return handle, time.perf_counter() - sent, sent


def waited(peer: Peer, future: Any) -> Any:
    """Spin until a future is done, and return its result."""
    peer.executor.spin_until_future_complete(future, 30.0)
    assert future.done(), "no answer within 30 s"
    return future.result()


if __name__ == "__main__":
    main()
