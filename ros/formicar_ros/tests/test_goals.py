"""Goals: certified paths, and every code that a failure may have."""

from __future__ import annotations

import math

import formicar
import numpy as np
import pytest
from nav_msgs.msg import Path

from .conftest import World, hall
from .peer import ABORTED, SUCCEEDED, pose, rows, wait_until

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)
GRID = formicar.OccupancyGrid(hall(), 0.1)


def test_a_path_is_the_librarys_and_the_judge_says_that_it_can_be_driven(shared: World) -> None:
    heard = shared.peer.hear(Path, "plan")
    wait_until(lambda: shared.peer.node.count_publishers("plan"), "the topic plan")
    answer = shared.peer.plan(GOAL, start=START)
    assert (answer.status, answer.result.error_code) == (SUCCEEDED, 0), answer.result.error_msg
    path = rows(answer.result.path)
    assert answer.result.path.header.frame_id == "map"
    assert np.allclose(path[0], START) and np.allclose(path[-1], GOAL, atol=0.02)
    assert formicar.check(path, GRID, "warehouse_amr")
    same = formicar.Planner(GRID, "warehouse_amr").plan(START, GOAL)
    assert np.allclose(path[:, :2], same.xy, atol=1e-9)
    again = shared.peer.plan(GOAL, start=START)
    shown = again.result.path.poses
    wait_until(lambda: heard and heard[-1].poses == shown, "the path of the answer on its topic")


@pytest.mark.parametrize(
    ("start", "goal", "code", "word"),
    [
        ((-50.0, 0.5, 0.0), GOAL, 203, "outside the map"),
        (START, (2.0, 300.0, 0.0), 204, "outside the map"),
        ((6.0, 2.0, 0.0), GOAL, 205, "footprint overlaps"),
        (START, (6.0, 2.0, 0.0), 206, "footprint overlaps"),
        (START, (math.nan, 2.0, 0.0), 204, "not finite"),
        ((math.inf, 2.0, 0.0), GOAL, 203, "not finite"),
        (START, pose(1.0, 1.0, 0.0, frame="moon"), 202, "'moon'"),
        (pose(1.0, 1.0, 0.0, frame="moon"), GOAL, 202, "'moon'"),
    ],
)
def test_a_failure_has_its_code_and_a_sentence(
    shared: World, start: object, goal: object, code: int, word: str
) -> None:
    answer = shared.peer.plan(goal, start=start)
    assert (answer.status, answer.result.error_code) == (ABORTED, code), answer.result.error_msg
    assert word in answer.result.error_msg
    assert not answer.result.path.poses
    through = shared.peer.plan_through([goal], start=start)
    assert (through.status, through.result.error_code) == (ABORTED, code + 100)
    assert through.result.error_msg == answer.result.error_msg


def test_an_orientation_that_is_no_rotation_is_refused(shared: World) -> None:
    goal = pose(*GOAL)
    goal.pose.orientation.w = goal.pose.orientation.z = 0.0
    answer = shared.peer.plan(goal, start=START)
    assert answer.result.error_code == 202
    assert "norm 0" in answer.result.error_msg


def test_an_unknown_planner_is_refused_with_the_known_ones(shared: World) -> None:
    answer = shared.peer.plan(GOAL, start=START, planner_id="Smac")
    assert answer.result.error_code == 201
    assert "GridBased" in answer.result.error_msg
    assert shared.peer.plan(GOAL, start=START, planner_id="GridBased").status == SUCCEEDED


def test_poses_on_the_way_are_passed_in_order(shared: World) -> None:
    via = [(4.0, 6.5, 0.0), (8.0, 6.5, 0.0)]
    answer = shared.peer.plan_through([*via, GOAL], start=START)
    assert answer.status == SUCCEEDED, answer.result.error_msg
    path = rows(answer.result.path)
    nearest = [int(np.argmin(np.hypot(*(path[:, :2] - place[:2]).T))) for place in via]
    assert nearest == sorted(nearest)
    for n, place in zip(nearest, via, strict=True):
        assert math.dist(path[n, :2], place[:2]) < 0.15
    assert not (np.diff(path, axis=0) == 0.0).all(axis=1).any(), "a pose twice in a row"
    assert formicar.check(path, GRID, "warehouse_amr")


def test_no_poses_at_all_have_a_code_of_their_own(shared: World) -> None:
    answer = shared.peer.plan_through([], start=START)
    assert (answer.status, answer.result.error_code) == (ABORTED, 309)


def test_a_blocked_pose_on_the_way_is_named(shared: World) -> None:
    answer = shared.peer.plan_through([(6.0, 2.0, 0.0), GOAL], start=START)
    assert answer.result.error_code == 306
    assert "via point 1" in answer.result.error_msg


def test_no_way_through_has_its_reason(world: World) -> None:
    world.start()
    cells = hall()
    cells[:, 60] = 100
    world.peer.send_map(cells)
    answer = world.peer.plan(GOAL, start=START)
    assert (answer.status, answer.result.error_code) == (ABORTED, 208)
    assert "obstacles separate start and goal" in answer.result.error_msg


def test_time_that_is_too_short_is_told(world: World) -> None:
    world.start(GridBased__max_planning_time=0.001)
    rng = np.random.default_rng(1)
    cells = np.zeros((600, 600), dtype=np.int8)
    cells[rng.random(cells.shape) < 0.003] = 100
    cells[:20, :20] = cells[-20:, -20:] = 0
    world.peer.send_map(cells)
    answer = world.peer.plan((59.0, 59.0, 0.0), start=(1.0, 1.0, 0.0))
    assert (answer.status, answer.result.error_code) == (ABORTED, 207)
    assert "deadline" in answer.result.error_msg


def test_without_a_map_a_goal_times_out_and_says_where_one_is_expected(world: World) -> None:
    world.start(costmap_update_timeout=0.2)
    answer = world.peer.plan(GOAL, start=START)
    assert (answer.status, answer.result.error_code) == (ABORTED, 207)
    assert "no map on /map" in answer.result.error_msg
