"""The life of the node, with and without a manager; parameters set, refused, listed."""

from __future__ import annotations

import signal

import pytest

from .conftest import World, hall
from .peer import ABORTED, SUCCEEDED, wait_until

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)


def test_a_manager_leads_the_node_through_its_life(world: World) -> None:
    world.start(autostart="false")
    peer = world.peer
    assert peer.state() == "unconfigured"
    peer.send_map(hall())
    for _ in range(2):
        assert peer.change("configure")
        assert peer.state() == "inactive"
        assert not peer.ask(GOAL, start=START).accepted
        assert peer.change("activate")
        assert peer.plan(GOAL, start=START).status == SUCCEEDED
        assert peer.change("deactivate")
        assert not peer.ask(GOAL, start=START).accepted
        assert peer.change("cleanup")
        assert peer.state() == "unconfigured"
    assert peer.change("unconfigured_shutdown")


def test_a_transition_that_the_state_does_not_allow_is_refused(world: World) -> None:
    world.start()
    wait_until(lambda: world.peer.state() == "active", "the active state")
    for transition in ("configure", "activate", "cleanup"):
        assert not world.peer.change(transition)
    assert world.peer.state() == "active"
    assert world.peer.change("deactivate")


def test_deactivation_ends_a_goal(world: World) -> None:
    world.start(costmap_update_timeout=60.0)
    handle = world.peer.ask(GOAL, start=START)
    assert world.peer.change("deactivate")
    answer = world.peer.outcome(handle)
    assert (answer.status, answer.result.error_msg) == (ABORTED, "the node is deactivated")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"vehicle__preset": None}, "nothing says which it is"),
        ({"vehicle__preset": "tank"}, "tank"),
        (
            {
                "vehicle__preset": None,
                "footprint": "'[[0.0, 0.0], [1.0, 1.0]]'",
                "minimum_turning_radius": 1.0,
            },
            "at least 3 points, got 2",
        ),
        ({"vehicle__preset": None, "footprint": "'[[0.0, 0.0], oh]'"}, "expected corners"),
        (
            {"vehicle__preset": None, "footprint": "'[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]'"},
            "without a turning radius",
        ),
        ({"footprint": "'[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]'"}, "both"),
        ({"GridBased__hybrid_astar__weight": 0.1}, "it must be in 1 to 10"),
        ({"GridBased__planner": "smac"}, "smac"),
        ({"map_type": "octomap"}, "octomap"),
    ],
)
def test_what_cannot_be_configured_is_said_and_can_be_mended(
    world: World, given: dict[str, object], words: str
) -> None:
    server = world.start(autostart="false", **given)
    assert not world.peer.change("configure")
    assert world.peer.state() == "unconfigured"
    assert server.said(words), server.log.read_text()
    assert server.is_alive


def test_parameters_are_listed_with_help_and_range(shared: World) -> None:
    wait_until(lambda: "GridBased.hybrid_astar.weight" in shared.peer.parameters(), "parameters")
    names = shared.peer.parameters()
    for name in ("planner_plugins", "footprint", "GridBased.tolerance", "vehicle.wheelbase_m"):
        assert name in names
    weight = shared.peer.describe("GridBased.hybrid_astar.weight")
    assert weight.description and weight.additional_constraints == "1 to 10"
    limits = weight.floating_point_range[0]
    assert (limits.from_value, limits.to_value) == (1.0, 10.0)
    n_ants = shared.peer.describe("GridBased.drive.n_ants").integer_range[0]
    assert (n_ants.from_value, n_ants.to_value) == (0, 10000)


def test_parameters_change_plans_and_are_refused_in_our_words(world: World) -> None:
    world.start()
    peer = world.peer
    peer.send_map(hall())
    assert peer.plan(GOAL, start=START).status == SUCCEEDED
    before = peer.plan(GOAL, start=START).result.path
    for name, value, words in (
        ("GridBased.hybrid_astar.weight", 0.1, "hybrid_astar.weight = 0.1; it must be in 1 to 10"),
        ("GridBased.hybrid_astar.weight", "much", "expected f64"),
        ("GridBased.tolerance", -1.0, "it must be in 0 to 100"),
        ("GridBased.motion", "sideways", "expected one of reverse, forward"),
        ("GridBased.allow_unknown", 3, "true or false"),
        ("map_topic", "other", "hint: clean up, set it, configure"),
        ("GridBased.planner", "astar", "hint: clean up, set it, configure"),
        ("vehicle.preset", "tank", "tank"),
        ("vehicle.width_m", 0.5, "both vehicle.preset and vehicle's measures are given"),
    ):
        refused = peer.set(name, value)
        assert not refused.successful and words in refused.reason, (name, refused.reason)
    assert peer.plan(GOAL, start=START).result.path.poses[-1] is not None
    assert peer.set("GridBased.hybrid_astar.weight", 2).successful
    assert peer.set("vehicle.preset", "sedan").successful
    after = peer.plan(GOAL, start=START)
    assert after.status == ABORTED or after.result.path.poses != before.poses
    assert peer.set("vehicle.preset", "warehouse_amr").successful
    assert peer.plan(GOAL, start=START).status == SUCCEEDED


def test_a_parameter_that_nobody_knows_is_named_with_the_nearest_one(world: World) -> None:
    server = world.start(GridBased__hybrid_astar__wieght=2.0)
    words = "GridBased.hybrid_astar.wieght; it is ignored; hint: GridBased.hybrid_astar.weight"
    wait_until(lambda: server.said(words), words)


def test_two_planners_have_names_and_parameters_of_their_own(world: World) -> None:
    world.start(planner_plugins="[Fine, Quick]", Quick__planner="hybrid-astar")
    world.peer.send_map(hall())
    assert world.peer.plan(GOAL, start=START, planner_id="Fine").status == SUCCEEDED
    assert world.peer.plan(GOAL, start=START, planner_id="Quick").status == SUCCEEDED
    assert world.peer.plan(GOAL, start=START).result.error_code == 201
    names = world.peer.parameters()
    assert "Fine.drive.n_ants" in names and "Quick.drive.n_ants" not in names


def test_a_killed_server_is_replaced_by_a_new_one(world: World) -> None:
    world.peer.send_map(hall())
    first = world.start()
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
    first.process.send_signal(signal.SIGKILL)
    first.process.wait()
    wait_until(lambda: not world.peer.to_pose.server_is_ready(), "the end of the first server")
    world.start()
    assert world.peer.plan(GOAL, start=START).status == SUCCEEDED
