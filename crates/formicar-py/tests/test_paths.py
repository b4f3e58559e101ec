"""Paths of any origin: judged, measured, driven; curves."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import formicar
from formicar import (
    ConfigError,
    Dubins,
    InvalidPath,
    OccupancyGrid,
    Plan,
    ReedsShepp,
    check,
    metrics,
    track,
)


def test_a_plan_is_judged_with_its_request(plan: Plan) -> None:
    judged = check(plan)
    assert judged and judged.valid and judged.source == "segments"
    assert judged.certificate == plan.certificate
    assert judged.n_segments == len(plan.segments) and judged.first_gear == 1
    assert repr(judged).startswith("Check(valid, ")


def test_samples_of_a_plan_are_valid_too(plan: Plan) -> None:
    poses = np.column_stack([plan.poses[name] for name in ("x", "y", "heading")])
    for samples, source in ((poses, "poses"), (plan.xy, "points"), (poses.tolist(), "poses")):
        judged = check(samples, plan.map, plan.vehicle)
        assert judged and judged.source == source and judged.curvature_slack == 0.05
        assert judged.length_m == pytest.approx(plan.metrics.length_m, abs=0.01)  # type: ignore[union-attr]
    reverse = check(poses[::-1], plan.map, plan.vehicle)
    assert reverse and reverse.first_gear == -1
    single = check(np.float32(poses[:1]), plan.map, plan.vehicle)
    assert single and single.length_m == 0.0


def test_what_collides_turns_too_sharply_or_jumps_is_named(hall: OccupancyGrid) -> None:
    x = np.linspace(2.0, 10.0, 81)
    through = check(np.column_stack((x, np.full(81, 2.0))), hall, "warehouse_amr")
    assert not through and through.certificate.violations[0].kind == "collision"
    assert "Check(invalid" in repr(through)
    turn = np.linspace(0.0, np.pi, 60)
    tight = np.column_stack((3 + 0.3 * np.sin(turn), 3 - 0.3 * np.cos(turn), turn))
    assert {v.kind for v in check(tight, hall, "warehouse_amr").certificate.violations} == {
        "curvature"
    }
    outside = check([[1.0, 1.0, 0.0], [1.0, -3.0, 0.0]], hall, "warehouse_amr")
    assert "leaves_map" in {v.kind for v in outside.certificate.violations}
    assert check([[1.0, 7.0], [11.0, 6.0], [1.5, 6.0]], hall, "point")


@pytest.mark.parametrize(
    ("path", "kind", "told"),
    [
        ([[1.0, 2.0, 3.0, 4.0]], InvalidPath, r"shape \(1, 4\)"),
        ([1.0, 2.0], InvalidPath, r"shape \(2,\)"),
        (np.zeros((0, 2)), InvalidPath, r"shape \(0, 2\)"),
        ([[1.0, float("nan")]], InvalidPath, r"path\[0, 1\] = NaN"),
        ([[1.0, 1e12]], InvalidPath, "1e9"),
        ([[0.0, 0.0], [2e4, 0.0]], InvalidPath, "20000 m long; it may be at most 10000 m"),
        ([["a", "b"]], TypeError, "real numbers"),
        ([[1.0, 2.0], [3.0]], TypeError, "no array"),
        (np.zeros((2, 2), dtype=complex), TypeError, "complex"),
        (
            np.zeros((2, 2), dtype=object),
            TypeError,
            r"path is of dtype object; expected real numbers; hint: \.astype\(float\)",
        ),
    ],
)
def test_what_is_no_path_is_refused(
    hall: OccupancyGrid, path: Any, kind: type[Exception], told: str
) -> None:
    with pytest.raises(kind, match=told):
        check(path, hall, "warehouse_amr")


def test_samples_need_a_map(plan: Plan) -> None:
    with pytest.raises(TypeError, match="map is missing"):
        check(plan.xy)
    with pytest.raises(TypeError, match="hint: 'vehicle'"):
        check(plan.xy, plan.map, vehicel="sedan")  # type: ignore[call-arg]


def test_metrics_of_a_path_known_by_hand(plan: Plan) -> None:
    quarter = np.linspace(0.0, np.pi / 2, 40)
    arc = np.column_stack((5 * np.sin(quarter), 5 - 5 * np.cos(quarter), quarter))
    measured = metrics(arc)
    assert measured.length_m == pytest.approx(2.5 * np.pi)
    assert measured.total_turning_rad == pytest.approx(np.pi / 2)
    assert measured.n_cusps == 0 and measured.min_clearance_m is None
    assert measured.compatible is None and measured.max_steer_rad
    there_and_back = metrics([[0, 0, 0], [4, 0, 0], [1, 0, 0]], vehicle="sedan")
    assert (there_and_back.length_m, there_and_back.reverse_length_m) == (7.0, 3.0)
    assert there_and_back.n_cusps == 1
    own = metrics(plan)
    assert own.compatible and own.compatible["ompl_smoothness"] > 0
    assert own.length_m == plan.metrics.length_m  # type: ignore[union-attr]
    assert own.min_clearance_m == plan.metrics.min_clearance_m  # type: ignore[union-attr]


def test_a_vehicle_drives_a_plan(plan: Plan) -> None:
    drive = track(plan, speed_mps=0.5)
    assert drive and drive.status == "arrived"
    trace = drive.trace
    assert trace["t"][0] == 0 and (np.diff(trace["t"]) >= 0).all()
    assert np.abs(trace["cross_track_error"]).max() <= drive.summary["max_cross_track_error_m"]
    assert drive.config["speed_mps"] == 0.5 and drive.clearance["min_clearance_m"] > 0
    assert drive.to_csv().startswith("t_s,") and drive.to_svg().startswith("<svg")
    assert repr(drive).startswith("Tracking(arrived")
    aside = track(plan, start_offset={"lateral_m": 0.2}, controller="pure-pursuit", lookahead_m=0.5)
    assert aside.trace["cross_track_error"][0] == pytest.approx(0.2, abs=1e-6)
    blind = track(plan, controller="open-loop", start_offset={"heading_rad": 0.3})
    assert blind.summary["max_cross_track_error_m"] > 1.0
    arc = np.column_stack((np.linspace(2, 5, 30), np.full(30, 6.5)))
    assert track(arc, plan.map, plan.vehicle)


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"gain": 2.0}, "hint: 'gain_per_s'"),
        ({"lookahead_m": 2.0}, "hint: controller='pure-pursuit'"),
        ({"controller": "lqr"}, "stanley"),
        ({"speed_mps": -1.0}, "speed_mps = -1"),
        ({"speed_mps": "fast"}, "speed_mps"),
        ({"time_step_s": float("nan")}, "not finite"),
        ({"time_step_s": 1.0, "speed_mps": 2.0}, "time_step_s = 1"),
    ],
)
def test_settings_of_a_drive_that_cannot_be_are_refused(
    plan: Plan, settings: dict[str, Any], told: str
) -> None:
    with pytest.raises(ConfigError, match=told):
        track(plan, **settings)
    with pytest.raises(formicar.InvalidVehicle, match="point"):
        track(plan.xy, plan.map, "point")
    with pytest.raises(TypeError, match="made by track"):
        formicar.Tracking()


def test_curves_reach_their_goal_and_reverse_is_never_longer() -> None:
    rng = np.random.default_rng(5)
    starts, goals = rng.uniform(-5, 5, (2, 50, 3))
    forward = Dubins.distance(starts, goals, 1.5)
    both = ReedsShepp.distance(starts, goals, 1.5)
    assert isinstance(forward, np.ndarray) and isinstance(both, np.ndarray)
    assert (both <= forward + 1e-9).all()
    assert (forward >= np.hypot(*(goals - starts)[:, :2].T) - 1e-9).all()
    for kind, lengths in ((Dubins, forward), (ReedsShepp, both)):
        curve = kind(starts[0], goals[0], 1.5)
        assert curve.length == pytest.approx(lengths[0])
        assert curve.end[:2] == pytest.approx(goals[0][:2])
        assert np.cos(curve.end[2] - goals[0][2]) == pytest.approx(1.0)
        assert np.abs(curve.arcs[:, 1]).sum() == pytest.approx(curve.length)
        poses = curve.sample(0.05)
        assert np.hypot(*np.diff(poses[:, :2], axis=0).T).max() <= 0.05 + 1e-9
        assert poses[0] == pytest.approx(starts[0]) and poses[-1][:2] == pytest.approx(goals[0][:2])
        others = kind.candidates(starts[0], goals[0], 1.5)
        assert others[0].length == pytest.approx(curve.length)
        assert [c.length for c in others] == sorted(c.length for c in others)
        assert kind.__name__ in repr(curve)
    assert Dubins.distance((0, 0, 0), (3, 0, 0), 1.0) == 3.0


def test_curves_refuse_what_they_cannot_join() -> None:
    for bad in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(InvalidPath, match="radius"):
            Dubins((0, 0, 0), (1, 1, 1), bad)
    with pytest.raises(InvalidPath, match="goal is not finite"):
        ReedsShepp((0, 0, 0), (1, float("nan"), 1), 1.0)
    with pytest.raises(InvalidPath, match="three numbers"):
        Dubins((0, 0), (1, 1, 1), 1.0)
    with pytest.raises(InvalidPath, match="spacing"):
        Dubins((0, 0, 0), (1, 1, 1), 1.0).sample(0.0)
    with pytest.raises(TypeError, match="Dubins"):
        formicar.Curve((0, 0, 0), (1, 1, 1), 1.0)
    assert np.isnan(Dubins.distance((0, 0, 0), (float("nan"), 0, 0), 1.0))


def test_curves_survive_pickling_and_copies() -> None:
    for kind in (Dubins, ReedsShepp):
        ends = ((0.0, 0.0, 0.0), (3.0, 3.0, 1.0))
        for curve in (kind(*ends, 1.0), *kind.candidates(*ends, 1.0)):
            for other in (pickle.loads(pickle.dumps(curve)), copy.deepcopy(curve)):
                assert type(other) is kind and other.end == curve.end
                np.testing.assert_array_equal(other.arcs, curve.arcs)
