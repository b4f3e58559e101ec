"""Occupancy grids: values, order, files, and what is refused."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import formicar
from formicar import InvalidMap, OccupancyGrid

# Calls that a type checker refuses too.
MAP: Any = OccupancyGrid


def test_booleans_are_occupied_where_true() -> None:
    grid = OccupancyGrid([[True, False], [False, False]], 0.5, (1.0, 2.0, 0.1))
    assert grid.data.tolist() == [[100, 0], [0, 0]]
    assert (grid.shape, grid.resolution, grid.origin) == ((2, 2), 0.5, (1.0, 2.0, 0.1))
    assert grid.extent == (1.0, 1.0)


@pytest.mark.parametrize("kind", ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">i4", ">u2"])
def test_integers_of_any_width_are_as_in_nav_msgs(kind: str) -> None:
    values = np.array([[0, 50], [100, 99]], dtype=kind)
    assert OccupancyGrid(values, 1.0).data.tolist() == values.tolist()
    if values.dtype.kind == "i":
        unknown = np.array([[-1, 0]], dtype=kind)
        assert OccupancyGrid(unknown, 1.0).data.tolist() == [[-1, 0]]


def test_any_order_and_stride_is_read_as_it_looks() -> None:
    values = np.arange(60, dtype=np.int16).reshape(6, 10) % 100
    packed = np.zeros(6, dtype=[("head", "u1"), ("row", "i2", 10)])
    packed["row"] = values
    for view in (
        np.asfortranarray(values),
        values[::-1, ::-1][::-1, ::-1],
        np.repeat(values, 2, axis=1)[:, ::2],
        packed["row"],
        values.tolist(),
    ):
        assert OccupancyGrid(view, 1.0).data.tolist() == values.tolist()
    assert OccupancyGrid(values.T, 1.0).data.tolist() == values.T.tolist()
    assert OccupancyGrid(values[::-1], 1.0, row0="top").data.tolist() == values.tolist()


def test_the_map_is_a_copy_that_cannot_be_written_to() -> None:
    walls = np.zeros((4, 4), dtype=bool)
    grid = OccupancyGrid(walls, 1.0)
    walls[:] = True
    assert not grid.data.any()
    with pytest.raises(ValueError, match="read-only"):
        grid.data[0, 0] = 3


def test_zeros_and_ones_alone_are_refused_with_a_hint() -> None:
    with pytest.raises(InvalidMap, match=r"\.astype\(bool\)"):
        OccupancyGrid(np.eye(3, dtype=int), 1.0)
    assert not OccupancyGrid(np.zeros((3, 3), dtype=int), 1.0).data.any()


def test_grays_and_costs_are_read_as_ros_does() -> None:
    grays = np.array([[0, 205, 254]], dtype=np.uint8)
    assert OccupancyGrid(grays, 0.05, values="grey").data.tolist() == [[100, -1, 0]]
    wide = grays.astype(np.uint16) * 257
    assert OccupancyGrid(wide, 0.05, values="grey").data.tolist() == [[100, -1, 0]]
    image = np.array([[0], [254]], dtype=np.uint8)
    assert OccupancyGrid(image, 0.05, values="grey", row0="top").data.tolist() == [[0], [100]]
    costs = np.array([[0, 253, 254, 255]], dtype=np.uint8)
    assert OccupancyGrid(costs, 0.05, values="costmap").data.tolist() == [[0, 99, 100, -1]]


@pytest.mark.parametrize(
    ("make", "kind", "told"),
    [
        (lambda: OccupancyGrid(np.zeros((2, 3)), 1.0), TypeError, "float64"),
        (lambda: OccupancyGrid(np.array([["a"]]), 1.0), TypeError, "dtype"),
        (lambda: OccupancyGrid([[1, 2], [3]], 1.0), TypeError, "no array"),
        (lambda: OccupancyGrid(np.ma.zeros((2, 2), dtype=int), 1.0), TypeError, "filled"),
        (lambda: OccupancyGrid(np.zeros(3, dtype=bool), 1.0), InvalidMap, "1 dimension"),
        (lambda: OccupancyGrid(np.zeros((0, 3), dtype=bool), 1.0), InvalidMap, "at least 1 x 1"),
        (lambda: OccupancyGrid([[101, 0]], 1.0), InvalidMap, r"cell \(0, 0\) has value 101"),
        (lambda: OccupancyGrid([[0, 2**40]], 1.0), InvalidMap, r"cell \(1, 0\) has value 1099"),
        (lambda: OccupancyGrid([[-2, 5]], 1.0), InvalidMap, "value -2"),
        (lambda: OccupancyGrid([[True]], 0.0), InvalidMap, "resolution 0"),
        (lambda: OccupancyGrid([[True]], float("nan")), InvalidMap, "resolution NaN"),
        (lambda: MAP([[True]], 1.0, (0.0, 0.0)), InvalidMap, "three numbers"),
        (lambda: OccupancyGrid([[True]], 1.0, (0, 0, float("inf"))), InvalidMap, "origin"),
        (lambda: OccupancyGrid([[True]], 1.0, (0, 0, 180)), InvalidMap,
         r"the origin's yaw is 180; .* radians, .*hint: 180 degrees are 3\.1416"),
        (lambda: OccupancyGrid([[True]], 1.0, (0, 0, -90.0)), InvalidMap, "are -1.57"),
        (lambda: MAP([[True]], "a"), InvalidMap, "resolution = 'a'; expected a number of meters"),
        (lambda: MAP([[True]], "0.1"), InvalidMap, "resolution = '0.1'"),
        (lambda: MAP([[True]], None), InvalidMap, "resolution = None"),
        (lambda: MAP([[True]], 1.0).distance_field(max_distance="a"), InvalidMap, "max_distance"),
        (lambda: MAP.load("none.yaml", resolution="a"), InvalidMap, "resolution = 'a'"),
        (lambda: MAP.load("none.yaml", unknown_grey="a"), InvalidMap, "unknown_grey = 'a'"),
        (lambda: MAP(np.array([[None]]), 1.0), TypeError, "object"),
        (lambda: MAP([[True]], 1.0, values="image"), InvalidMap, "grey"),
        (lambda: MAP([[True]], 1.0, row0="left"), InvalidMap, "row0"),
        (lambda: MAP([[True]], 1.0, resolutoin=2), TypeError, "hint: 'resolution'"),
        (lambda: OccupancyGrid.builtin("depot"), InvalidMap, "parking-lot"),
        (lambda: OccupancyGrid.load("none.yaml"), FileNotFoundError, "none.yaml"),
    ],
)  # fmt: skip
def test_what_is_no_map_is_refused(make: Any, kind: type[Exception], told: str) -> None:
    with pytest.raises(kind, match=told):
        make()


def test_a_claim_beyond_the_limit_is_refused_before_it_is_read() -> None:
    huge = np.broadcast_to(np.int8(0), (10**6, 10**6))
    with pytest.raises(InvalidMap, match="the limit is"):
        OccupancyGrid(huge, 1.0)


@pytest.mark.parametrize("name", ["map.yaml", "map.map", "map.txt", "map.csv"])
def test_a_saved_map_is_loaded_again(tmp_path: Path, name: str) -> None:
    walls = np.zeros((5, 7), dtype=bool)
    walls[1, 2] = walls[4, 6] = True
    grid = OccupancyGrid(walls, 0.25)
    grid.save(tmp_path / name)
    resolution = None if name.endswith("yaml") else 0.25
    again = OccupancyGrid.load(tmp_path / name, resolution=resolution)
    assert again == grid
    assert again.name.endswith(name)


def test_a_file_that_is_no_map_says_why(tmp_path: Path) -> None:
    (tmp_path / "bad.txt").write_text("0 1 2\n")
    with pytest.raises(InvalidMap, match=r"bad\.txt"):
        OccupancyGrid.load(tmp_path / "bad.txt")
    with pytest.raises(FileNotFoundError):
        OccupancyGrid([[True]], 1.0).save(tmp_path / "none" / "map.yaml")


def test_doubts_about_a_file_are_told(tmp_path: Path) -> None:
    (tmp_path / "m.pgm").write_bytes(b"P5 2 1 255\n" + bytes([254, 205]))
    (tmp_path / "m.yaml").write_text(
        "image: m.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.25\n"
    )
    grid = OccupancyGrid.load(tmp_path / "m.yaml")
    assert "205" in grid.warnings[0]
    settled = OccupancyGrid.load(tmp_path / "m.yaml", unknown_grey=205)
    assert (settled.warnings, settled.data.tolist()) == ([], [[0, -1]])


def test_distances_are_those_of_brute_force() -> None:
    rng = np.random.default_rng(3)
    walls = rng.random((20, 30)) < 0.02
    field = OccupancyGrid(walls, 0.2).distance_field()
    rows, cols = np.nonzero(walls)
    y, x = np.mgrid[:20, :30]
    nearest = np.hypot(y[..., None] - rows, x[..., None] - cols).min(axis=-1) * 0.2
    np.testing.assert_allclose(field, nearest, atol=1e-12)
    cut = OccupancyGrid(walls, 0.2).distance_field(max_distance=0.6)
    np.testing.assert_allclose(cut, np.minimum(nearest, 0.6), atol=1e-12)
    with pytest.raises(InvalidMap, match="at most"):
        OccupancyGrid(walls, 0.2).distance_field(max_distance=1e3)


def test_unknown_ground_and_keep_out_areas_are_decided_on_a_new_map() -> None:
    grid = OccupancyGrid(np.full((4, 4), -1), 1.0)
    assert grid.with_unknown("free").data.max() == 0
    assert grid.with_unknown("occupied").data.min() == 100
    closed = grid.with_unknown("free").with_keep_out([[(0.1, 0.1), (1.9, 0.1), (0.1, 0.9)]])
    assert closed.data[0].tolist() == [100, 100, 0, 0]
    assert grid.data.max() == -1
    with pytest.raises(InvalidMap, match="policy|unknown"):
        grid.with_unknown("maybe")  # type: ignore[arg-type]


def test_cells_and_points() -> None:
    grid = OccupancyGrid(np.zeros((4, 6), dtype=bool), 0.5, (10.0, 20.0, 0.0))
    assert grid.cell_at(10.6, 21.9) == (1, 3)
    assert grid.cell_at(0.0, 0.0) is None
    assert grid.center(1, 3) == (10.75, 21.75)
    with pytest.raises(InvalidMap, match="6 x 4"):
        grid.center(6, 0)


def test_builtin_maps_bring_vehicles_and_requests() -> None:
    for name, about in formicar.builtin_maps().items():
        grid = OccupancyGrid.builtin(name)
        assert about and grid.requests and grid.vehicle_name in formicar.Vehicle.presets()
        for request in grid.requests.values():
            assert grid.cell_at(*request.start[:2]) and grid.cell_at(*request.goal[:2])
    assert OccupancyGrid([[True]], 1.0).requests == {}


def test_equal_maps_are_equal_also_from_elsewhere() -> None:
    grid = OccupancyGrid([[True, False]], 0.5)
    other = pickle.loads(pickle.dumps(grid))
    assert other == grid and hash(other) == hash(grid) and copy.deepcopy(grid) == grid
    assert grid != OccupancyGrid([[True, False]], 0.25)
    assert grid != OccupancyGrid([[False, False]], 0.5)
    assert (grid == 3) is False
    assert repr(other) == "OccupancyGrid(1 rows x 2 columns, 0.5 m per cell, 1 x 0.5 m, 1 occupied)"


SCENARIOS = """{"version": 1, "scenarios": [
  {"id": "a", "map": "m.txt", "resolution": 1.0, "start": [3.0, 5.0, 0.0], "goal": [15.0, 5.0, 0.0],
   "vehicle": {"wheelbase": 1.0, "max_steer_deg": 40.0, "length": 1.6, "width": 0.8,
               "rear_overhang": 0.3, "front_overhang": 0.3}},
  {"id": "b", "map": "m.txt", "resolution": 1.0, "start": [3.0, 5.0, 0.0], "goal": [3.0, 7.0, 3.0],
   "vehicle": {"wheelbase": 1.0, "max_steer_deg": 40.0, "length": 1.6, "width": 0.8,
               "rear_overhang": 0.3, "front_overhang": 0.3}}
]}"""


def test_scenario_files_bring_map_vehicle_and_ends(tmp_path: Path) -> None:
    OccupancyGrid(np.zeros((10, 20), dtype=bool), 1.0).save(tmp_path / "m.txt")
    (tmp_path / "cars.json").write_text(SCENARIOS)
    scenarios = formicar.load_scenarios(tmp_path / "cars.json")
    assert list(scenarios) == ["a", "b"] and scenarios["a"].map == scenarios["b"].map
    for scenario in scenarios.values():
        grid, vehicle, start, goal = scenario
        assert formicar.Planner(grid, vehicle).plan(start, goal)
    with pytest.raises(FileNotFoundError):
        formicar.load_scenarios(tmp_path / "none.json")
    with pytest.raises(InvalidMap, match="TPCAP"):
        formicar.load_scenarios(tmp_path / "m.txt")
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(InvalidMap, match=r"bad\.json"):
        formicar.load_scenarios(tmp_path / "bad.json")
