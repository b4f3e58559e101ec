"""Planning: requests, answers, and the reason where there is none."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import formicar
from formicar import ConfigError, InvalidRequest, OccupancyGrid, Plan, Planner

START, GOAL = (2.0, 2.0, 0.0), (10.0, 2.0, 0.0)


def test_a_path_is_certified_and_ends_where_it_was_asked_to(plan: Plan) -> None:
    assert plan.status == "found" and plan.reason is None and plan.explanation is None
    certificate, metrics = plan.certificate, plan.metrics
    assert certificate is not None and metrics is not None
    assert certificate.valid and certificate.violations == ()
    assert certificate.min_clearance_m > 0
    first, last = plan.poses[0], plan.poses[-1]
    assert (first["x"], first["y"], first["heading"]) == START
    assert (last["x"], last["y"], last["heading"]) == pytest.approx(GOAL, abs=0.01)
    assert last["s"] == pytest.approx(metrics.length_m)
    assert plan.poses["clearance"].min() >= certificate.min_clearance_m - 1e-9
    assert np.diff(plan.poses["s"]).max() <= 0.1 + 1e-9
    assert np.abs(plan.poses["curvature"]).max() <= plan.vehicle.max_curvature * (1 + 1e-9)
    assert plan.xy.shape == (len(plan), 2)
    assert plan.segments["length"].sum() == pytest.approx(metrics.length_m)
    assert set(plan.segments["direction"]) <= {-1, 1}
    assert (plan.start, plan.goal, plan.seed, plan.planner) == (START, GOAL, 7, "formicar")
    assert not plan.poses.flags.writeable and not plan.xy.flags.writeable


def test_the_same_seed_gives_the_same_path(planner: Planner, plan: Plan) -> None:
    again = planner.plan(np.array(START), list(GOAL), np.int64(7))
    assert again == plan and hash(again) == hash(plan)
    assert (again.poses == plan.poses).all()
    on_threads = Planner(planner.map, planner.vehicle, n_threads=3).plan(START, GOAL, seed=7)
    assert on_threads == plan


def test_without_a_path_a_plan_is_false_and_explains_itself() -> None:
    walls = np.zeros((60, 100), dtype=bool)
    walls[:, 50] = True
    planner = Planner(OccupancyGrid(walls, 0.1), "warehouse_amr")
    plan = planner.plan((2.0, 3.0, 0.0), (8.0, 3.0, 0.0))
    assert not plan and plan.status == "no_path"
    assert plan.reason and "separate start and goal" in plan.reason
    assert plan.explanation and plan.explanation.disconnected
    assert plan.explanation.disconnected.n_cells_at_start > 0
    assert plan.certificate is None and plan.metrics is None
    assert len(plan.poses) == 0 and plan.xy.shape == (0, 2) and len(plan.segments) == 0
    assert repr(plan).startswith("Plan(no_path: ")
    with pytest.raises(formicar.NoPath, match="no_path") as raised:
        planner.plan_or_raise((2.0, 3.0, 0.0), (8.0, 3.0, 0.0))
    assert raised.value.plan == plan
    with pytest.raises(formicar.InvalidPath):
        plan.to_csv()


def test_a_gap_is_named(planner: Planner) -> None:
    walls = planner.map.data == 100
    walls[50:76, 60] = True
    tight = Planner(OccupancyGrid(walls, 0.1), "warehouse_amr").plan(START, GOAL, budget=20_000)
    assert not tight and tight.explanation
    assert tight.explanation.gap or tight.explanation.disconnected


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"start": (2.0, 2.0)}, r"start = \[2\.0,2\.0\]"),
        ({"start": (2.0, 2.0, 90.0)}, "radians"),
        ({"start": (2.0, 2.0, float("nan"))}, "start is not finite"),
        ({"goal": "there"}, "goal"),
        ({"goal": (99.0, 2.0, 0.0)}, "outside the map"),
        ({"goal": (6.0, 2.0, 0.0)}, "overlaps"),
        ({"goal": []}, "goal"),
        ({"seed": -1}, "seed = -1"),
        ({"seed": 1.5}, "seed"),
        ({"seed": True}, "seed"),
        ({"budget": -1}, "budget = -1"),
        ({"budget": True}, "budget"),
        ({"deadline_s": 0.0}, "deadline_s = 0"),
        ({"deadline_s": float("nan")}, "deadline_s = nan"),
        ({"motion": "sideways"}, "motion"),
        ({"goal_heading": "up"}, "bidirectional"),
        ({"start_heading": "up"}, "exact"),
        ({"goal_tolerance": 0.1}, "two numbers"),
        ({"goal_tolerance": (0.1, -1.0)}, "yaw = -1"),
        ({"via": 3}, "via = 3; expected a sequence of points"),
        ({"via": np.array(3.0)}, "expected a sequence of points"),
        ({"via": [(1.0,)]}, "via point"),
        ({"via": [{"where": (1.0, 1.0)}]}, "via"),
        ({"keep_out": [(1.0, 2.0)]}, "keep_out"),
        ({"keep_out": [[(0.0, 0.0), (1.0, 1.0)]]}, "at least 3"),
        ({"keep_out": [[(0.0, 0.0), (1.0, 1.0), (0.0, float("nan"))]]}, "not finite"),
        ({"soft_costs": np.zeros((2, 2))}, "shape"),
        ({"soft_costs": np.zeros(4)}, "shape"),
        ({"soft_costs": np.zeros((80, 120)), "soft_weight": "a"}, "soft_weight = 'a'"),
        ({"continuous_curvature": -1.0}, "max_rate_per_m2"),
    ],
)
def test_what_cannot_be_asked_is_refused(
    planner: Planner, changes: dict[str, Any], told: str
) -> None:
    with pytest.raises(InvalidRequest, match=told):
        planner.plan(**{"start": START, "goal": GOAL, **changes})


def test_unknown_ground_is_called_by_its_name() -> None:
    ground = np.zeros((40, 60), dtype=np.int8)
    ground[:, :20] = -1
    grid = OccupancyGrid(ground, 0.1)
    ends = ((1.0, 2.0, 0.0), (5.0, 2.0, 0.0))
    with pytest.raises(InvalidRequest, match=r"with_unknown\(\"free\"\)"):
        Planner(grid).plan(*ends)
    assert Planner(grid.with_unknown("free")).plan(*ends)


def test_soft_costs_must_be_shares(planner: Planner) -> None:
    for bad in (2.0, -0.1, float("nan")):
        with pytest.raises(InvalidRequest, match="soft cost"):
            planner.plan(START, GOAL, soft_costs=np.full(planner.map.shape, bad))
    with pytest.raises(InvalidRequest, match="weight"):
        planner.plan(START, GOAL, soft_costs=np.zeros(planner.map.shape), soft_weight=-1.0)
    cells = Planner(planner.map, planner.vehicle, planner="astar")
    with pytest.raises(InvalidRequest, match="does not use soft costs"):
        cells.plan(START, GOAL, soft_costs=np.zeros(planner.map.shape))


def test_unknown_keywords_name_the_nearest(planner: Planner) -> None:
    with pytest.raises(TypeError, match="hint: 'deadline_s'"):
        planner.plan(START, GOAL, deadline=3)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="hint: 'goal_tolerance'"):
        planner.plan(START, GOAL, tolerance=(0.1, 0.1))  # type: ignore[call-arg]


def test_a_budget_and_a_deadline_end_a_query(planner: Planner) -> None:
    cut = planner.plan(START, GOAL, budget=5)
    assert not cut and cut.status == "budget_exhausted"
    late = planner.plan(START, GOAL, deadline_s=1e-9)
    assert not late and late.status == "timed_out"
    first = planner.plan(START, GOAL, budget=400)
    assert first and first.cut_by in (None, "budget_exhausted")


def test_gears_headings_and_several_goals(planner: Planner) -> None:
    forward = planner.plan(START, GOAL, motion="forward")
    assert forward and (forward.poses["direction"] == 1).all()
    goals = np.array([GOAL, (4.0, 6.0, 0.0)])
    nearest = planner.plan(START, goals)
    assert nearest.certificate and nearest.certificate.goal_index == 1
    free = planner.plan(START, (4.0, 6.0, 3.0), goal_heading="any", start_heading="any")
    exact = planner.plan(START, (4.0, 6.0, 3.0))
    assert free.metrics and exact.metrics and free.metrics.length_m < exact.metrics.length_m
    wide = planner.plan(START, GOAL, goal_tolerance=(0.3, 0.2))
    assert wide.certificate and wide.certificate.goal_error_m <= 0.3


def test_via_points_are_passed(planner: Planner) -> None:
    plan = planner.plan(
        START, GOAL, via=[(6.0, 6.5), {"at": [8.0, 6.0], "tolerance": {"xy": 0.3, "yaw": 0.3}}]
    )
    assert plan and plan.certificate and len(plan.certificate.via_s_m) == 2
    assert np.hypot(*(plan.xy - (6.0, 6.5)).T).min() < 0.2


def test_continuous_curvature_without_a_number_needs_a_steering_rate(hall: OccupancyGrid) -> None:
    measures = formicar.Vehicle.preset("warehouse_amr").measures
    unknown = {name: value for name, value in measures.items() if "rate" not in name}
    with pytest.raises(InvalidRequest, match="max_steer_rate"):
        Planner(hall, formicar.Vehicle(**unknown)).plan(START, GOAL, continuous_curvature=True)
    assert Planner(hall, "warehouse_amr").plan(START, GOAL, continuous_curvature=True)


def test_continuous_curvature_is_certified(planner: Planner) -> None:
    plan = planner.plan(START, GOAL, continuous_curvature=2.0)
    assert plan.certificate and plan.certificate.is_curvature_continuous
    assert 0 < plan.certificate.max_curvature_rate_per_m2 <= 2.0 * (1 + 1e-9)


def test_continuous_curvature_needs_a_steering_rate(hall: OccupancyGrid) -> None:
    preset = formicar.Vehicle.preset("warehouse_amr").measures
    slow = {name: preset[name] for name in preset if name != "max_steer_rate_rad_per_s"}
    with pytest.raises(InvalidRequest, match="max_steer_rate"):
        Planner(hall, formicar.Vehicle(**slow)).plan(START, GOAL, continuous_curvature=True)


def test_closed_areas_are_kept_out_of_for_this_query_alone(planner: Planner, plan: Plan) -> None:
    area = [(5.0, 5.0), (7.0, 5.0), (7.0, 6.2), (5.0, 6.2)]
    around = planner.plan(START, GOAL, seed=7, keep_out=[area])
    assert around and around != plan and around.map.data[55, 60] == 100
    inside = (around.xy > (5.0, 5.0)).all(axis=1) & (around.xy < (7.0, 6.2)).all(axis=1)
    assert not inside.any()
    assert planner.plan(START, GOAL, seed=7) == plan


def test_soft_costs_push_a_path_away(planner: Planner, plan: Plan) -> None:
    costs = np.zeros(planner.map.shape)
    costs[50:63, 50:71] = 1.0
    pushed = planner.plan(START, GOAL, seed=7, soft_costs=costs, soft_weight=20.0)
    assert pushed and pushed.xy[:, 1].max() > plan.xy[:, 1].max()
    assert planner.plan(START, GOAL, seed=7) == plan


def test_a_vehicle_with_a_speed_has_times() -> None:
    measures = {**formicar.Vehicle.preset("warehouse_amr").measures, "speed_mps": 1.0}
    plan = Planner("narrow-aisle", formicar.Vehicle(**measures)).plan(
        *next(iter(OccupancyGrid.builtin("narrow-aisle").requests.values()))
    )
    assert plan and plan.metrics and plan.metrics.travel_time_s
    assert plan.poses["time"][-1] == pytest.approx(plan.metrics.travel_time_s, rel=0.05)
    assert plan.poses["speed"].max() <= 1.0 + 1e-9


def test_the_map_of_a_planner_changes_and_the_plan_with_it(hall: OccupancyGrid) -> None:
    planner = Planner(hall, "warehouse_amr")
    before = planner.plan(START, GOAL, seed=7)
    planner.update_map(np.ones((8, 2), dtype=bool), col=60, row=50)
    changed = planner.map.data.copy()
    assert (changed[50:58, 60:62] == 100).all() and not hall.data[50:58, 61].any()
    assert before.map == hall
    after = planner.plan(START, GOAL, seed=7)
    fresh = Planner(planner.map, "warehouse_amr").plan(START, GOAL, seed=7)
    assert after == fresh and after != before
    mended = planner.replan(tuple(before.poses[3])[:3], GOAL, before, seed=7)
    assert mended and formicar.check(mended)
    with pytest.raises(formicar.InvalidMap, match="leave out what lies off"):
        planner.update_map([[True]], col=1000)
    with pytest.raises(InvalidRequest, match="col"):
        planner.update_map([[True]], col=-1)


def test_not_every_planner_replans(planner: Planner, plan: Plan) -> None:
    other = Planner(planner.map, planner.vehicle, planner="hybrid-astar")
    with pytest.raises(InvalidRequest, match="does not replan"):
        other.replan(START, GOAL, plan)
    nothing = planner.plan(START, GOAL, budget=1)
    with pytest.raises(formicar.InvalidPath, match="no path"):
        planner.replan(START, GOAL, nothing)


def test_parameters_by_dict_file_and_keyword(tmp_path: Path, hall: OccupancyGrid) -> None:
    file = tmp_path / "weights.toml"
    file.write_text('planner = "hybrid-astar"\n[hybrid_astar]\nweight = 2.0\n')
    by_file = Planner(hall, config=file)
    assert by_file.config["hybrid_astar"]["weight"] == 2.0
    dotted: dict[str, Any] = {"hybrid_astar.weight": 2.0}
    for other in (
        Planner(hall, config={"planner": "hybrid-astar", "hybrid_astar": {"weight": 2}}),
        Planner(hall, config={"planner": "hybrid-astar", "hybrid_astar.weight": np.float64(2)}),
        Planner(hall, planner="hybrid-astar", hybrid_astar={"weight": 2.0}),
        Planner(hall, config={"planner": "astar"}, planner="hybrid-astar", **dotted),
        Planner(hall, config=by_file.config),
    ):
        assert other.config == by_file.config
    over = Planner(hall, config=file, hybrid_astar={"weight": 3.0})
    assert over.config["hybrid_astar"]["weight"] == 3.0
    assert Planner(hall, "point").name == "astar"


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"wieght": 2}, "hint: 'hybrid_astar.weight'"),
        ({"hybrid_astar": {"wieght": 2}}, "hint: 'hybrid_astar.weight'"),
        ({"hybrid_astar": {"weight": 99}}, "hybrid_astar.weight = 99; it must be in 1 to 10"),
        ({"hybrid_astar": {"weight": "heavy"}}, "hybrid_astar"),
        ({"hybrid_astar": {"weight": float("nan")}}, "not finite"),
        ({"hybrid_astar": 3}, "hybrid_astar"),
        ({"planner": "ants"}, "lei2020"),
        ({"n_threads": 0}, "n_threads"),
        ({"n_threads": "a"}, "n_threads = 'a'; it must be a whole number"),
        ({"n_threads": 1.5}, "n_threads = 1.5"),
    ],
)
def test_parameters_that_cannot_be_are_refused(
    hall: OccupancyGrid, settings: dict[str, Any], told: str
) -> None:
    with pytest.raises(ConfigError, match=told):
        Planner(hall, **settings)


def test_what_is_no_map_or_vehicle_is_named(hall: OccupancyGrid) -> None:
    with pytest.raises(TypeError, match="OccupancyGrid"):
        Planner(np.zeros((3, 3), dtype=bool))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="config="):
        Planner(hall, {"planner": "astar"})  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError):
        Planner(hall, config="none.toml")
    with pytest.raises(TypeError, match="made by"):
        Plan()


def test_every_planner_by_name_answers() -> None:
    grid = OccupancyGrid.builtin("lei-map1")
    ends = next(iter(grid.requests.values()))
    for name in formicar.planners():
        config = {"colony.n_iterations": 3} if name == "lei2020" else {}
        plan = Planner(grid, planner=name, config=config).plan(*ends, goal_heading="any")
        assert plan.planner == name
        assert bool(plan) == (plan.status == "found") and (plan or plan.reason)


def test_a_colony_shows_trails_and_pheromone(colony: Plan) -> None:
    n_rows, n_cols = colony.map.shape
    assert len(colony.cells) > 2 and len(colony.nodes) >= 2
    assert colony.pheromone is not None and colony.pheromone.shape == (n_rows, n_cols)
    assert np.nanmax(colony.pheromone) > 0
    history = colony.history.iterations
    assert len(history) == 12 and history["iteration"].tolist() == list(range(12))
    assert (np.diff(history["best_so_far_cost"]) <= 0).all()
    frame = colony.ants[0]
    assert frame.record["iteration"] == 0 and frame.pheromone.shape == (n_rows, n_cols)
    assert frame.arrived.shape[1] == 5 and frame.best.shape[1] == 2
    first, last = colony.cells[0], colony.cells[-1]
    assert tuple(first) == colony.map.cell_at(*colony.start[:2])
    assert tuple(last) == colony.map.cell_at(*colony.goal[:2])


def test_other_planners_have_none(plan: Plan) -> None:
    assert plan.pheromone is None and plan.ants == [] and len(plan.cells) == 0
    assert len(plan.history.iterations) == 0
    improvements = plan.history.improvements
    assert len(improvements) >= 1
    assert improvements["length_m"][-1] == pytest.approx(plan.metrics.length_m)  # type: ignore[union-attr]


def test_progress_is_told_and_may_end_a_query(planner: Planner) -> None:
    events: list[dict[str, Any]] = []
    plan = planner.plan(START, GOAL, on_progress=events.append)
    improved = [event for event in events if event["event"] == "improved"]
    assert plan and improved and improved[-1]["length_m"] > 0
    assert all(event["elapsed_s"] >= 0 for event in events)

    def refuse(event: dict[str, Any]) -> None:
        raise ZeroDivisionError("enough")

    with pytest.raises(ZeroDivisionError, match="enough"):
        planner.plan(START, GOAL, on_progress=refuse)
    assert planner.plan(START, GOAL)
    ants = Planner("lei-map1", planner="lei2020", config={"colony.n_iterations": 3})
    events.clear()
    ants.plan(*next(iter(ants.map.requests.values())), on_progress=events.append)
    assert sum(event["event"] == "iteration" for event in events) == 3


def test_a_bar_shows_the_progress(planner: Planner, capsys: pytest.CaptureFixture[str]) -> None:
    assert planner.plan(START, GOAL, on_progress=True)
    assert "steps" in capsys.readouterr().err


def test_documents_are_those_of_the_library(plan: Plan, tmp_path: Path) -> None:
    document = plan.to_dict()
    assert document["schema"] == "formicar/answer/1" and document["status"] == "found"
    assert json.loads(plan.to_json()) == document
    for record, known in ((plan.certificate, "certificate"), (plan.metrics, "metrics")):
        names = set(record._fields) - {"compatible"}  # type: ignore[union-attr]
        optional = {"travel_time_s", "assumptions"}
        assert names - optional == set(document[known]) - optional
    assert set(plan.timing._fields) == set(document["timing"])
    columns = plan.poses.dtype.names
    assert columns and plan.to_csv().splitlines()[0] == ",".join(columns)
    for name in ("plan.json", "plan.csv", "plan.svg"):
        plan.save(tmp_path / name)
    assert json.loads((tmp_path / "plan.json").read_text()) == document
    assert (tmp_path / "plan.svg").read_text().startswith("<svg")
    with pytest.raises(formicar.InvalidPath, match=r"\.csv"):
        plan.save(tmp_path / "plan.png")
    assert plan.provenance["version"] == formicar.__version__


def test_lists_of_planners_and_parameters() -> None:
    assert list(formicar.planners())[0] == "formicar"
    keys = [parameter["key"] for parameter in formicar.parameters()]
    assert "hybrid_astar.weight" in keys and "colony.n_ants" in keys


def test_wrong_kinds_of_arguments_are_named(planner: Planner) -> None:
    ends: Any = ((2.0, 2.0, 0.0), (10.0, 2.0, 0.0))
    with pytest.raises(formicar.InvalidRequest, match="deadline_s = '1'"):
        planner.plan(*ends, deadline_s="1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="previous is of type int; expected a Plan"):
        planner.replan(START, GOAL, 3)  # type: ignore[arg-type]
    for soft_costs, dtype in (
        ("a", "<U1"),
        (np.full((80, 120), None), "object"),
        ([[1j]], "complex"),
    ):
        with pytest.raises(TypeError, match=f"soft_costs is of dtype {dtype}"):
            planner.plan(*ends, soft_costs=soft_costs)
    with pytest.raises(TypeError, match="on_progress = 3; expected a callable"):
        planner.plan(*ends, on_progress=3)  # type: ignore[arg-type]
    with pytest.raises(formicar.ConfigError, match="seed = 'a'"):
        formicar.tune(lambda values: 1.0, {"a": (0.0, 1.0)}, seed="a")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="hint: 'seed'"):
        formicar.tune(lambda values: 1.0, {"a": (0.0, 1.0)}, sed=1)  # type: ignore[call-arg]
