"""Parameters of SmacPlannerHybrid become ours, and the server takes them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from formicar_ros.migrate import main

from .conftest import World, hall
from .peer import SUCCEEDED

NAV2 = """
planner_server:
  ros__parameters:
    expected_planner_frequency: 20.0
    planner_plugins: ["GridBased", "Straight"]
    costmap_update_timeout: 2.0
    Straight: {plugin: "nav2_navfn_planner::NavfnPlanner"}
    GridBased:
      plugin: "nav2_smac_planner::SmacPlannerHybrid"
      tolerance: 0.25
      downsample_costmap: false
      allow_unknown: true
      max_iterations: -1
      max_planning_time: 3.5
      motion_model_for_search: "REEDS_SHEPP"
      angle_quantization_bins: 72
      minimum_turning_radius: 0.80
      reverse_penalty: 2.0
      change_penalty: 0.1
      non_straight_penalty: 1.2
      cost_penalty: 2.0
      smoother: {max_iterations: 1000}
      flux_capacitor: 1.21
global_costmap:
  global_costmap:
    ros__parameters:
      global_frame: map
      robot_base_frame: base_link
      footprint: "[[0.6, 0.3], [0.6, -0.3], [-0.2, -0.3], [-0.2, 0.3]]"
"""


def test_a_file_is_migrated_with_a_word_on_every_key(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "nav2.yaml").write_text(NAV2)
    assert main([str(tmp_path / "nav2.yaml"), "--out", str(tmp_path / "ours.yaml")]) == 0
    found = yaml.safe_load((tmp_path / "ours.yaml").read_text())
    assert found["planner_server"]["ros__parameters"] == {
        "expected_planner_frequency": 20.0,
        "costmap_update_timeout": 2.0,
        "planner_plugins": ["GridBased"],
        "global_frame": "map",
        "robot_base_frame": "base_link",
        "footprint": "[[0.6, 0.3], [0.6, -0.3], [-0.2, -0.3], [-0.2, 0.3]]",
        "minimum_turning_radius": 0.8,
        "GridBased": {
            "planner": "formicar",
            "tolerance": 0.25,
            "allow_unknown": True,
            "max_planning_time": 3.5,
            "motion": "reverse",
            "hybrid_astar": {
                "max_iterations": 1000000000,
                "angle_quantization_bins": 72,
                "change_penalty": 0.1,
                "non_straight_penalty": 1.2,
            },
            "cost": {"reverse_factor": 2.0},
        },
    }
    notes = capsys.readouterr().err
    for words in (
        "GridBased.flux_capacitor: unknown",
        "GridBased.cost_penalty: left out",
        "GridBased.smoother: left out",
        "planner_server.Straight: its plugin nav2_navfn_planner::NavfnPlanner stays with Nav2",
    ):
        assert words in notes


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("planner_server: {ros__parameters: {planner_plugins: []}}", "no SmacPlannerHybrid"),
        ("- a list", "no SmacPlannerHybrid"),
        ("a: [", "nav2.yaml"),
        (None, "No such file"),
    ],
)
def test_a_file_that_cannot_be_migrated_is_said_to_be(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str | None, words: str
) -> None:
    if text is not None:
        (tmp_path / "nav2.yaml").write_text(text)
    assert main([str(tmp_path / "nav2.yaml")]) == 2
    assert words in capsys.readouterr().err


def test_the_server_takes_what_was_migrated(world: World, tmp_path: Path) -> None:
    (tmp_path / "nav2.yaml").write_text(NAV2)
    ours = tmp_path / "ours.yaml"
    assert main([str(tmp_path / "nav2.yaml"), "--out", str(ours)]) == 0
    command = [sys.executable, "-m", "formicar_ros.planner_server", "--ros-args"]
    server = subprocess.Popen(
        [*command, "--params-file", str(ours), "-p", "autostart:=true"],
        env={**os.environ, "ROS_DOMAIN_ID": str(world.domain)},
    )
    try:
        world.peer.send_map(hall())
        answer = world.peer.plan((10.0, 2.0, 0.0), start=(2.0, 2.0, 0.0))
        assert answer.status == SUCCEEDED, answer.result.error_msg
        assert world.peer.describe("GridBased.cost.reverse_factor").description
    finally:
        server.terminate()
        assert server.wait(20) == 0
