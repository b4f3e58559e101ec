"""What comes from outside: transforms, maps, updates, paths to judge; good and bad."""

from __future__ import annotations

from functools import partial

import formicar
import numpy as np
import pytest
from geometry_msgs.msg import Quaternion
from nav2_msgs.msg import Costmap
from nav2_msgs.srv import IsPathValid
from nav_msgs.msg import Path

from .conftest import World, hall
from .peer import SUCCEEDED, pose, rows, wait_until

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)


def valid(world: World, samples: np.ndarray, **changes: object) -> IsPathValid.Response:
    path = Path()
    path.header.frame_id = "map"
    path.poses = [pose(*row) for row in samples.tolist()]
    request = IsPathValid.Request(path=path)
    for name, value in changes.items():
        if hasattr(request, name):
            setattr(request, name, value)
    return world.peer.call(IsPathValid, "is_path_valid", request)


def test_the_start_is_where_the_robot_is(world: World) -> None:
    world.start(transform_tolerance=5.0)
    peer = world.peer
    peer.send_map(hall())
    peer.send_tf("map", "odom", (1.0, 1.0, 0.0), is_static=True)
    handle = peer.ask(GOAL)  # The robot's pose comes after the goal.
    peer.send_tf("odom", "base_link", (1.0, 1.0, 0.0))
    answer = peer.outcome(handle)
    assert answer.status == SUCCEEDED, answer.result.error_msg
    assert np.allclose(rows(answer.result.path)[0], START)


def test_a_start_without_transforms_or_with_old_ones_is_a_tf_error(world: World) -> None:
    world.start(transform_tolerance=0.2)
    peer = world.peer
    peer.send_map(hall())
    answer = peer.plan(GOAL)
    assert answer.result.error_code == 202
    assert "no chain of transforms from 'map' to 'base_link'" in answer.result.error_msg
    peer.send_tf("map", "base_link", START, age_s=60.0)
    wait_until(lambda: "s old" in peer.plan(GOAL).result.error_msg, "an old transform")
    assert peer.plan(GOAL).result.error_code == 202


def test_a_goal_in_another_frame_is_brought_into_that_of_the_map(world: World) -> None:
    world.start()
    peer = world.peer
    peer.send_map(hall())
    peer.send_tf("map", "dock", (10.0, 2.0, np.pi / 2), is_static=True)
    goal = pose(0.0, 0.0, -np.pi / 2, frame="dock")
    wait_until(lambda: peer.plan(goal, start=START).status == SUCCEEDED, "the static transform")
    end = rows(peer.plan(goal, start=START).result.path)[-1]
    assert np.allclose(end, GOAL, atol=0.02)


def test_updates_change_the_map_under_a_prepared_planner(world: World) -> None:
    world.start()
    peer = world.peer
    peer.send_map(hall())
    first = peer.plan(GOAL, start=START)
    assert first.status == SUCCEEDED
    wall = np.full((30, 1), 100, dtype=np.int8)
    peer.send_update(wall, 60, 50)
    wait_until(lambda: peer.plan(GOAL, start=START).result.error_code == 208, "the wall")
    peer.send_update(np.zeros((10, 1), dtype=np.int8), 60, 70)
    wait_until(lambda: peer.plan(GOAL, start=START).status == SUCCEEDED, "the gap")
    cells = hall()
    cells[50:70, 60] = 100
    path = rows(peer.plan(GOAL, start=START).result.path)
    assert formicar.check(path, formicar.OccupancyGrid(cells, 0.1), "warehouse_amr")


def test_faint_costs_in_an_update_are_no_map_of_booleans(world: World) -> None:
    server = world.start()
    world.peer.send_map(hall())
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
    patch = np.zeros((4, 4), dtype=np.int8)
    patch[1, 1] = 1
    world.peer.send_update(patch, 20, 70)
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
    assert not server.said("map update:")


def test_maps_that_are_none_are_reported_and_the_former_one_stays(world: World) -> None:
    server = world.start()
    peer = world.peer
    peer.send_map(hall())
    assert peer.plan(GOAL, start=START).status == SUCCEEDED
    bad = [
        ("origin (NaN", {"origin": (float("nan"), 0.0, 0.0)}),
        ("norm 0", {"orientation": Quaternion(x=0.0, y=0.0, z=0.0, w=0.0)}),
        ("frame 'moon'", {"frame": "moon"}),
    ]
    for words, changes in bad:
        peer.send_map(hall(), **changes)
        wait_until(partial(server.said, words), words)
    peer.send_update(np.full((2, 2), 100, dtype=np.int8), 119, 79)
    wait_until(partial(server.said, "reaches off the map"), "a report")
    peer.send_update(np.full((2, 2), 101, dtype=np.int8), 1, 1)
    wait_until(partial(server.said, "values from 101 to 101"), "a report")
    assert peer.plan(GOAL, start=START).status == SUCCEEDED
    assert server.is_alive


def test_unknown_cells_block_unless_they_may_be_driven_on(world: World) -> None:
    world.start()
    cells = hall()
    cells[cells == 0] = -1
    cells[:40, :40] = 0
    world.peer.send_map(cells)
    assert world.peer.plan(GOAL, start=START).result.error_code == 206
    assert world.peer.set("GridBased.allow_unknown", True).successful
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED


def test_a_raw_costmap_is_a_map(world: World) -> None:
    world.start(map_topic="global_costmap/costmap_raw", map_type="costmap")
    costs = np.where(hall() == 100, 254, 0).astype(np.uint8)
    costs[0, :] = 253
    message = Costmap()
    message.header.frame_id = "map"
    message.metadata.resolution = 0.1
    message.metadata.size_y, message.metadata.size_x = costs.shape
    message.metadata.origin = pose(0.0, 0.0, 0.0).pose
    message.data = costs.ravel().tolist()
    world.peer.publisher(Costmap, "global_costmap/costmap_raw").publish(message)
    answer = world.peer.plan(GOAL, start=START)
    assert answer.status == SUCCEEDED, answer.result.error_msg


def test_a_footprint_as_nav2_writes_it_is_the_vehicle(world: World) -> None:
    world.start(
        vehicle__preset=None,
        footprint="'[[0.9, 0.35], [0.9, -0.35], [-0.2, -0.35], [-0.2, 0.35]]'",
        footprint_padding=0.02,
        minimum_turning_radius=1.2,
    )
    world.peer.send_map(hall())
    path = rows(world.peer.plan(GOAL, start=START).result.path)
    corners = [[0.9, 0.35], [0.9, -0.35], [-0.2, -0.35], [-0.2, 0.35]]
    body = formicar.Vehicle(footprint=corners, min_turning_radius_m=1.2).with_margin(0.02)
    assert formicar.check(path, formicar.OccupancyGrid(hall(), 0.1), body)


def test_a_path_is_judged_with_the_poses_that_collide(shared: World) -> None:
    wait_until(lambda: shared.peer.plan(GOAL, start=START).status == SUCCEEDED, "the map")
    answer = valid(shared, rows(shared.peer.plan(GOAL, start=START).result.path))
    assert answer.is_valid and list(answer.invalid_pose_indices) == []
    straight = np.array([(x, 2.0, 0.0) for x in np.linspace(2.0, 10.0, 81)])
    answer = valid(shared, straight, stop_at_first_collision=False)
    assert not answer.is_valid
    grid = formicar.OccupancyGrid(hall(), 0.1)
    alone = {
        n
        for n, row in enumerate(straight)
        if not formicar.check(row[None, :], grid, "warehouse_amr")
    }
    found = set(answer.invalid_pose_indices)
    assert alone and alone <= found
    assert len(found - alone) <= 1, "besides, at most the pose nearest to the worst place"


@pytest.mark.parametrize("samples", [[], [(float("nan"), 0.0, 0.0), (1.0, 1.0, 0.0)]])
def test_what_is_no_path_is_not_valid(shared: World, samples: list[object]) -> None:
    answer = valid(shared, np.array(samples).reshape(-1, 3))
    assert not answer.is_valid


def test_a_path_that_bends_too_sharply_is_not_valid(shared: World) -> None:
    turn = np.linspace(0.0, np.pi / 2, 30)
    tight = np.column_stack((2 + 0.3 * np.sin(turn), 2.3 - 0.3 * np.cos(turn), turn))
    answer = valid(shared, tight)
    assert not answer.is_valid and answer.invalid_pose_indices
