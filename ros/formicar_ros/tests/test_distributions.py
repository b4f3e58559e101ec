"""What every distribution asks, whatever fields its interfaces have."""

from __future__ import annotations

from typing import Any

import formicar
import numpy as np
from nav2_msgs.action import ComputePathToPose
from nav2_msgs.srv import ClearEntireCostmap, IsPathValid
from nav_msgs.msg import Path

from .conftest import World, hall
from .peer import ABORTED, SUCCEEDED, pose, request, rows, wait_until

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)
GRID = formicar.OccupancyGrid(hall(), 0.1)


def test_both_actions_answer_with_paths_that_the_judge_accepts(shared: World) -> None:
    for answer in (
        shared.peer.plan(GOAL, start=START),
        shared.peer.plan_through([(4.0, 6.5, 0.0), GOAL], start=START),
    ):
        assert answer.status == SUCCEEDED
        assert formicar.check(rows(answer.result.path), GRID, "warehouse_amr")


def test_a_failure_has_what_the_result_has_room_for(shared: World) -> None:
    for base, answer in (
        (200, shared.peer.plan((6.0, 2.0, 0.0), start=START)),
        (300, shared.peer.plan_through([(6.0, 2.0, 0.0)], start=START)),
    ):
        assert answer.status == ABORTED
        assert getattr(answer.result, "error_code", base + 6) == base + 6
        assert "overlaps" in getattr(answer.result, "error_msg", "overlaps")


def test_the_last_goal_reached_is_told_where_there_is_a_field(shared: World) -> None:
    result = shared.peer.plan_through([(4.0, 6.5, 0.0), GOAL], start=START).result
    assert getattr(result, "last_reached_index", 1) == 1
    failed = shared.peer.plan_through([(6.0, 2.0, 0.0)], start=START).result
    assert getattr(failed, "last_reached_index", -1) == -1


def test_points_to_pass_are_passed(shared: World) -> None:
    goal = request(ComputePathToPose.Goal(goal=pose(*GOAL)), start=START)
    if not hasattr(goal, "viapoints"):
        return
    goal.viapoints = [pose(3.0, 7.0, 0.0)]
    answer = shared.peer.outcome(shared.peer.send(shared.peer.to_pose, goal))
    path = rows(answer.result.path)
    assert np.hypot(path[:, 0] - 3.0, path[:, 1] - 7.0).min() < 0.15


def judged(shared: World, samples: np.ndarray, **changes: Any) -> Any:
    path = Path()
    path.header.frame_id = "map"
    path.poses = [pose(*row) for row in samples.tolist()]
    asked = IsPathValid.Request(path=path)
    for name, value in changes.items():
        if not hasattr(asked, name):
            return None
        setattr(asked, name, value)
    return shared.peer.call(IsPathValid, "is_path_valid", asked)


def test_paths_are_judged(shared: World) -> None:
    wait_until(lambda: shared.peer.plan(GOAL, start=START).status == SUCCEEDED, "the map")
    straight = np.array([(x, 2.0, 0.0) for x in np.linspace(2.0, 10.0, 81)])
    answer = judged(shared, straight)
    assert not answer.is_valid and answer.invalid_pose_indices
    assert getattr(answer, "success", True)
    assert judged(shared, straight[:30]).is_valid


def test_fields_of_later_distributions_are_heeded(shared: World) -> None:
    straight = np.array([(x, 2.0, 0.0) for x in np.linspace(2.0, 10.0, 81)])
    every = judged(shared, straight, stop_at_first_collision=False)
    if every is None:
        return
    assert len(every.invalid_pose_indices) > 1
    first = judged(shared, straight, stop_at_first_collision=True)
    assert list(first.invalid_pose_indices) == [every.invalid_pose_indices[0]]
    assert judged(shared, straight, max_lookahead_distance=2.0).is_valid
    assert not judged(shared, straight, layer_name="voxels").success
    long = "[[5.0, 0.3], [5.0, -0.3], [-0.2, -0.3], [-0.2, 0.3]]"
    assert not judged(shared, straight[:30], footprint=long).is_valid


def test_the_costmap_can_be_cleared(shared: World) -> None:
    name = "global_costmap/clear_entirely_global_costmap"
    answer = shared.peer.call(ClearEntireCostmap, name, ClearEntireCostmap.Request())
    assert getattr(answer, "success", True)
