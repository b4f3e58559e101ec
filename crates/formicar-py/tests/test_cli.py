"""The package and the command line are one: the same paths, the same words."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

import formicar
from formicar import OccupancyGrid, Planner, Vehicle


def run(program: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([program, *words], capture_output=True, text=True, check=False)


def without_times(document: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in document.items() if key != "timing"}


@pytest.mark.parametrize(
    ("name", "planner", "seed"),
    [
        ("parking-lot", "formicar", 3),
        ("narrow-aisle", "hybrid-astar", 0),
        ("lei-map1", "lei2020", 2),
    ],
)
def test_the_same_plan_bit_for_bit(program: Path, name: str, planner: str, seed: int) -> None:
    how = ("--planner", planner, "--seed", str(seed), "--budget", "none")
    words = ("plan", "--map", name, *how, "--json")
    answer = json.loads(run(program, *words).stdout)
    grid = OccupancyGrid.builtin(name)
    plan = Planner(grid, planner=planner).plan(*next(iter(grid.requests.values())), seed=seed)
    assert without_times(plan.to_dict()) == without_times(answer)


def test_the_command_line_judges_what_the_package_plans(program: Path, tmp_path: Path) -> None:
    grid = OccupancyGrid.builtin("parking-lot")
    plan = Planner(grid).plan(*grid.requests["back-in"])
    for name in ("plan.json", "plan.csv"):
        plan.save(tmp_path / name)
        words = ("check", str(tmp_path / name), "--map", "parking-lot", "--vehicle", "sedan")
        checked = run(program, *words, "--json")
        assert checked.returncode == 0
        certificate = json.loads(checked.stdout)["certificate"]
        if name == "plan.json":
            assert plan.certificate and certificate["path_hash"] == plan.certificate.path_hash


def test_the_same_words_for_the_same_faults(program: Path) -> None:
    grid = OccupancyGrid.builtin("parking-lot")
    planner = Planner(grid)
    start, goal = grid.requests["back-in"]
    cases: list[tuple[tuple[str, ...], Any]] = [
        (("--goal", "999,2,0"), lambda: planner.plan(start, (999, 2, 0))),
        (("--goal", "0,0,0"), lambda: planner.plan(start, (0, 0, 0))),
        (("--vehicle", "tank"), lambda: Vehicle.preset("tank")),
        (("--set", "hybrid_astar.weight=99"), lambda: Planner(grid, hybrid_astar={"weight": 99})),
    ]
    for flags, call in cases:
        with pytest.raises(ValueError) as raised:  # noqa: PT011
            call()
        told = run(program, "plan", "--map", "parking-lot", "--request", "back-in", *flags)
        assert told.returncode == 2
        assert str(raised.value) in told.stderr


def test_the_same_version(program: Path) -> None:
    assert run(program, "--version").stdout == f"formicar {formicar.__version__}\n"


def test_the_same_list_of_planners(program: Path) -> None:
    listed = run(program, "list", "planners").stdout
    assert all(f"{name} " in listed for name in formicar.planners())
