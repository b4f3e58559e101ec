"""Manners towards a behavior tree: the newest goal wins, goals can be canceled, maps come late."""

from __future__ import annotations

import time

import numpy as np
from bond.msg import Status
from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticArray
from lifecycle_msgs.srv import ChangeState
from nav2_msgs.srv import ClearEntireCostmap, IsPathValid
from nav_msgs.msg import OccupancyGrid
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from .conftest import World, hall
from .peer import ABORTED, CANCELED, EXECUTING, LATCHED, SUCCEEDED, pose, wait_until

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)

# Planning that goes on for seconds, so that there is time to interrupt it.
LONG = {
    "GridBased__planner": "formicar",
    "GridBased__improve__max_tries": 1000000000,
    "GridBased__improve__stall_gain": 0.0,
    "GridBased__improve__stall_tries_per_radius": 1000000,
    "GridBased__max_planning_time": 20.0,
}


def test_the_newest_goal_wins(world: World) -> None:
    world.start(**LONG)
    world.peer.send_map(hall())
    first = world.peer.ask(GOAL, start=START)
    time.sleep(0.3)
    second = world.peer.ask((3.0, 7.0, 0.0), start=START)
    third = world.peer.ask((4.0, 7.0, 0.0), start=START)
    for older in (first, second):
        answer = world.peer.outcome(older)
        assert (answer.status, answer.result.error_code) == (ABORTED, 200)
        assert "newer goal" in answer.result.error_msg
    third.cancel_goal_async()
    assert world.peer.outcome(third).status == CANCELED


def test_forty_goals_at_once_leave_the_newest(world: World) -> None:
    world.start()
    world.peer.send_map(hall())
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
    handles = [world.peer.ask((3.0 + 0.1 * n, 6.5, 0.0), start=START) for n in range(40)]
    answers = [world.peer.outcome(handle) for handle in handles]
    assert answers[-1].status == SUCCEEDED
    end = answers[-1].result.path.poses[-1].pose.position
    assert abs(end.x - 6.9) < 0.02 and abs(end.y - 6.5) < 0.02
    assert {answer.status for answer in answers} <= {SUCCEEDED, ABORTED}


def test_a_goal_is_executed_until_it_is_canceled(world: World) -> None:
    world.start(**LONG)
    world.peer.send_map(hall())
    handle = world.peer.ask(GOAL, start=START)
    wait_until(lambda: handle.status == EXECUTING, "execution")
    cancel = world.peer.result(handle.cancel_goal_async())
    assert len(cancel.goals_canceling) == 1
    assert world.peer.outcome(handle).status == CANCELED
    handle = world.peer.ask_through([GOAL], start=START)
    world.peer.result(handle.cancel_goal_async())
    assert world.peer.outcome(handle).status == CANCELED


def test_a_goal_that_waits_for_a_map_can_be_canceled(world: World) -> None:
    world.start(costmap_update_timeout=60.0)
    handle = world.peer.ask(GOAL, start=START)
    time.sleep(0.1)
    world.peer.result(handle.cancel_goal_async())
    assert world.peer.outcome(handle).status == CANCELED


def test_a_large_map_reaches_a_server_that_comes_late(world: World) -> None:
    cells = np.zeros((2000, 2000), dtype=np.int8)
    cells[:, 1000] = 100
    cells[1900:, 1000] = 0
    world.peer.send_map(cells, 0.05)
    world.start()
    answer = world.peer.plan((70.0, 97.0, 0.0), start=(30.0, 97.0, 0.0))
    assert answer.status == SUCCEEDED, answer.result.error_msg


def test_a_map_may_come_after_the_goal(world: World) -> None:
    world.start(costmap_update_timeout=30.0)
    handle = world.peer.ask(GOAL, start=START)
    time.sleep(0.2)
    world.peer.send_map(hall())
    assert world.peer.outcome(handle).status == SUCCEEDED


def test_all_that_a_standard_behavior_tree_waits_for_is_there(world: World) -> None:
    world.start()
    peer = world.peer
    costmaps = peer.hear(OccupancyGrid, "global_costmap/costmap", LATCHED)
    peer.send_map(hall())
    name = "global_costmap/clear_entirely_global_costmap"
    assert peer.to_pose.wait_for_server(20.0) and peer.through.wait_for_server(20.0)
    for kind, service in (
        (ClearEntireCostmap, name),
        (IsPathValid, "is_path_valid"),
        (ChangeState, "planner_server/change_state"),
    ):
        assert peer.node.create_client(kind, service).wait_for_service(20.0), service
    wait_until(lambda: costmaps, "the global costmap")
    sent = np.array(costmaps[0].data, dtype=np.int8).reshape(80, 120)
    assert (sent == hall()).all()
    peer.call(ClearEntireCostmap, name, ClearEntireCostmap.Request())
    assert peer.plan(GOAL, start=START).status == SUCCEEDED


def test_a_path_that_is_followed_stays_and_clearing_forgets_it(world: World) -> None:
    world.start()
    peer = world.peer
    peer.send_map(hall())
    first = peer.plan(GOAL, start=START).result.path
    ahead = first.poses[len(first.poses) // 3]
    assert peer.plan(pose(*GOAL), start=ahead).status == SUCCEEDED
    name = "global_costmap/clear_entirely_global_costmap"
    peer.call(ClearEntireCostmap, name, ClearEntireCostmap.Request())
    again = peer.plan(GOAL, start=START).result.path
    assert again.poses[10].pose == first.poses[10].pose


def test_a_manager_hears_the_bond_while_the_node_is_active(world: World) -> None:
    world.start()
    beats = world.peer.hear(Status, "bond", 100)
    wait_until(lambda: len(beats) > 3, "heartbeats")
    assert {(beat.id, beat.active) for beat in beats} == {("planner_server", True)}
    assert abs(beats[0].heartbeat_period - 0.1) < 1e-6
    assert world.peer.change("deactivate")
    wait_until(lambda: not beats[-1].active, "the end of the bond")


def test_diagnostics_tell_the_last_failure(world: World) -> None:
    world.start(costmap_update_timeout=0.05)
    heard = world.peer.hear(DiagnosticArray, "/diagnostics")
    wait_until(lambda: heard, "diagnostics")
    assert heard[-1].status[0].message == "no map yet"
    world.peer.send_map(hall())
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
    wait_until(lambda: heard[-1].status[0].level == b"\x00", "good news")
    world.peer.plan((6.0, 2.0, 0.0), start=START)
    wait_until(lambda: "footprint overlaps" in heard[-1].status[0].message, "bad news")
    assert heard[-1].status[0].level == b"\x01"


def test_markers_show_the_swept_ground_and_the_tightest_place(world: World) -> None:
    world.start()
    heard = world.peer.hear(MarkerArray, "plan_markers")
    world.peer.send_map(hall())
    wait_until(lambda: world.peer.node.count_publishers("plan_markers"), "markers")
    world.peer.plan(GOAL, start=START)
    wait_until(lambda: world.peer.plan(GOAL, start=START) and heard, "markers")
    swept, tight, text = heard[-1].markers
    assert len(swept.points) % 3 == 0 and len(swept.points) > 100
    assert tight.ns == "tightest_place" and text.text.endswith(" m")


def test_the_clock_of_a_simulation_is_the_clock(world: World) -> None:
    world.start(use_sim_time="true", transform_tolerance=0.5)
    peer = world.peer
    peer.send_map(hall())
    clock = peer.publisher(Clock, "/clock", 10)
    wait_until(lambda: clock.get_subscription_count() > 0, "a reader of the clock")

    def at(second: int) -> str:
        clock.publish(Clock(clock=Time(sec=second)))
        peer.send_tf("map", "base_link", START, age_s=time.time() - 100.0)
        return str(peer.plan(GOAL).result.error_msg)

    wait_until(lambda: at(100) == "", "the time of the simulation")
    wait_until(lambda: "60.00 s old" in at(160), "a minute later")


def test_two_actions_do_not_disturb_each_other(world: World) -> None:
    world.start()
    world.peer.send_map(hall())
    one = world.peer.ask(GOAL, start=START)
    other = world.peer.ask_through([(4.0, 6.5, 0.0), GOAL], start=START)
    assert world.peer.outcome(one).status == SUCCEEDED
    assert world.peer.outcome(other).status == SUCCEEDED
