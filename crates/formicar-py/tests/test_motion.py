"""Drives in time: moving obstacles, speed plans, the judge in time, controllers."""

from __future__ import annotations

import json
import math
import pickle
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

import formicar
from formicar import (
    ConfigError,
    InvalidObstacle,
    InvalidPath,
    InvalidRequest,
    MotionPlan,
    MovingObstacle,
    OccupancyGrid,
    Plan,
    Planner,
    Predictions,
    plan_motion,
    track_in_time,
)

SQUARE = [(-0.4, -0.4), (0.4, -0.4), (0.4, 0.4), (-0.4, 0.4)]
ROOM = OccupancyGrid(np.zeros((80, 120), dtype=bool), resolution=0.1)
STRAIGHT = np.column_stack((np.linspace(1.5, 10.5, 40), np.full(40, 4.0)))
RADIUS_M = 0.3


def walker(y_m: float = 7.5, speed_mps: float = -0.8, growth_mps: float = 0.0) -> MovingObstacle:
    return MovingObstacle(
        radius_m=RADIUS_M,
        pose=(6.0, y_m, 0.0),
        velocity_mps=(0.0, speed_mps),
        growth_mps=growth_mps,
        name="walker",
    )


@pytest.fixture(scope="module")
def crossing() -> Predictions:
    """A walker who crosses the straight path when the vehicle would be there."""
    return Predictions([walker(8.0 - 0.3, -0.65)], horizon_s=20.0)


@pytest.fixture(scope="module")
def motion(crossing: Predictions) -> MotionPlan:
    """A drive that keeps its distance from the walker."""
    return plan_motion(STRAIGHT, crossing, ROOM, "warehouse_amr", max_speed_mps=1.0)


def test_keywords_and_the_document_make_the_same_obstacles(tmp_path: Path) -> None:
    made = Predictions(
        [
            walker(growth_mps=0.02),
            MovingObstacle(corners=SQUARE, pose=(2, 3, 0), speed_mps=0.8, turn_rad_per_s=0.1),
            MovingObstacle(corners=np.array(SQUARE), waypoints=[(5, 4, 2, 0), (7, 4, 2, 1.57)]),
            MovingObstacle(radius_m=1, pose=(9, 9, 1)),
        ],
        horizon_s=30,
    )
    made.save(tmp_path / "moving.json")
    read = Predictions.load(tmp_path / "moving.json")
    document = json.loads((tmp_path / "moving.json").read_text())
    assert document["schema"] == "formicar/moving/1" and len(made) == 4
    assert read == made == Predictions.from_dict(document) == Predictions(made.obstacles, 30.0)
    assert made != Predictions(made.obstacles, 29.0)
    assert pickle.loads(pickle.dumps(made)) == made and hash(read) == hash(made)
    assert repr(made) == "Predictions(walker, 2, 3, 4, 30 s)"
    poses = made.poses([0.0, 6.0, 30.0, 99.0])
    assert poses.shape == (4, 4, 3) and not poses.flags.writeable
    assert poses[0, 1].tolist() == pytest.approx([6.0, 7.5 - 0.8 * 6, 0.0])
    assert poses[1, 1, 2] == pytest.approx(0.6)
    assert poses[2, 1].tolist() == pytest.approx([4, 2, 0.785])
    assert (poses[:, 2] == poses[:, 3]).all(), "from the horizon on they stand"


@pytest.mark.parametrize(
    ("keywords", "told"),
    [
        ({"pose": (1, 1, 0)}, "one shape"),
        ({"radius_m": 1, "corners": SQUARE, "pose": (1, 1, 0)}, "one shape"),
        ({"radius_m": -1, "pose": (1, 1, 0)}, "radius_m = -1; it must be above 0"),
        ({"radius_m": math.nan, "pose": (1, 1, 0)}, "radius_m is not finite"),
        ({"radius_m": 1}, "needs a pose"),
        ({"radius_m": 1, "pose": (1, 1)}, "invalid length 2"),
        ({"radius_m": 1, "pose": (1, 1, 0), "velocity_mps": (1e4, 0)}, "velocity_mps = 10000"),
        ({"radius_m": 1, "pose": (1, 1, 0), "waypoints": [(0, 1, 1, 0)]}, "one motion"),
        (
            {"radius_m": 1, "pose": (1, 1, 0), "velocity_mps": (1, 0), "speed_mps": 1},
            "one motion",
        ),
        ({"radius_m": 1, "waypoints": [(1, 1, 1, 0), (1, 2, 1, 0)]}, "times must rise"),
        ({"radius_m": 1, "waypoints": [(1, 1, 1)]}, r"shape \(1, 3\)"),
        ({"corners": [(0, 0), (1, 0)], "pose": (1, 1, 0)}, "obstacle 1"),
        ({"radius_m": 1, "pose": (1, 1, 0), "growth_mps": -1}, "growth_mps = -1"),
    ],
)
def test_obstacles_that_cannot_be_are_refused(keywords: dict[str, Any], told: str) -> None:
    with pytest.raises(InvalidObstacle, match=told):
        MovingObstacle(**keywords)


def test_predictions_that_cannot_be_are_refused(tmp_path: Path) -> None:
    for horizon_s in (0.0, -1.0, 1e5):
        with pytest.raises(InvalidObstacle, match="horizon_s"):
            Predictions([], horizon_s)
    with pytest.raises(InvalidObstacle, match="unknown field"):
        Predictions.from_dict({"horizon_s": 1, "obstacles": [], "speed": 1})
    with pytest.raises(FileNotFoundError):
        Predictions.load(tmp_path / "none.json")
    (tmp_path / "bad.json").write_text("[1, 2]")
    with pytest.raises(InvalidObstacle, match="no moving obstacles"):
        Predictions.load(tmp_path / "bad.json")
    with pytest.raises(TypeError, match="hint: 'radius_m'"):
        MovingObstacle(radius=1)  # type: ignore[call-arg]
    with pytest.raises(ValueError, match="not finite"):
        Predictions([], 1.0).poses([math.nan])


def test_a_drive_waits_for_a_walker(motion: MotionPlan) -> None:
    assert motion and motion.status == "arrives" and motion.reason is None
    found = motion.certificate
    assert found and found.valid and found.arrives and found.nearest
    assert found.min_distance_m is not None and found.min_distance_m >= 0.1
    assert found.nearest.obstacle == "walker"
    alone = plan_motion(STRAIGHT, None, ROOM, "warehouse_amr", max_speed_mps=1.0)
    assert alone.duration_s and motion.duration_s
    assert (
        motion.lost_s == pytest.approx(motion.duration_s - alone.duration_s) and motion.lost_s > 0
    )
    assert alone.lost_s == 0 and alone.certificate and alone.certificate.min_distance_m is None
    poses = motion.poses
    assert (np.diff(poses["t"]) >= 0).all() and (np.diff(poses["s"]) >= 0).all()
    assert poses["speed"].max() <= 1.0 + 1e-9 and poses["s"][-1] == pytest.approx(9.0)
    regions = motion.regions
    assert len(regions) and (regions["from_s"] < regions["to_s"]).all()
    assert (regions["obstacle"] == 0).all() and (regions["from_t"] < regions["to_t"]).all()
    assert len(alone.regions) == 0 and repr(alone).startswith("MotionPlan(arrives")
    phases = motion.profile
    assert phases["t"] + phases["duration"] == pytest.approx([*phases["t"][1:], motion.duration_s])


def test_places_at_times_are_those_of_the_profile(motion: MotionPlan) -> None:
    assert motion.duration_s
    at = motion.at([-1.0, 0.0, motion.duration_s, 1e3])
    assert at["s"].tolist() == pytest.approx([0, 0, 9, 9])
    assert at["speed"][-1] == 0 and at["x"][-1] == pytest.approx(10.5)
    t = np.arange(0.0, motion.duration_s, 1e-3)
    dense = motion.at(t)
    assert np.gradient(dense["s"], t) == pytest.approx(dense["speed"], abs=5e-3)
    with pytest.raises(ValueError, match="shape"):
        motion.at([[0.0]])


def test_a_drive_ends_before_what_stays() -> None:
    pallet = MovingObstacle(corners=SQUARE, pose=(7, 4, 0), name="pallet")
    waits = plan_motion(STRAIGHT, Predictions([pallet], 10), ROOM, "warehouse_amr")
    assert waits and waits.status == "waits" and math.isinf(waits.lost_s)
    assert waits.certificate and not waits.certificate.arrives
    assert waits.poses["x"].max() < 6.6 and np.isfinite(waits.poses["t"]).all()


def test_a_path_that_cannot_be_driven_says_why() -> None:
    chaser = MovingObstacle(corners=[(-1, -4), (1, -4), (1, 4), (-1, 4)], pose=(10.5, 4, 0),
                            velocity_mps=(-2, 0), name="truck")  # fmt: skip
    refused = plan_motion(STRAIGHT, Predictions([chaser], 10), ROOM, "warehouse_amr")
    assert not refused and refused.status == "not_driven"
    assert refused.reason and "truck" in refused.reason
    assert refused.certificate is None and len(refused.poses) == 0 and len(refused.profile) == 0
    assert refused.duration_s is None and "truck" in repr(refused)
    with pytest.raises(InvalidPath, match="not driven"):
        refused.judge()
    with pytest.raises(InvalidPath, match="not driven"):
        refused.at([0.0])
    with pytest.raises(InvalidPath, match="not driven"):
        track_in_time(refused)
    assert pickle.loads(pickle.dumps(refused)).reason == refused.reason


@pytest.mark.parametrize(
    ("keywords", "told"),
    [
        ({"max_speed_mps": -1.0}, "max_speed_mps = -1"),
        ({"max_jerk_mps3": math.inf}, "max_jerk_mps3 is not finite"),
        ({"distance_m": -0.1}, "distance_m = -0.1"),
        ({"max_speed_mps": "fast"}, "max_speed_mps"),
        ({"present_speed_mps": 3.0}, "present_speed_mps = 3"),
        ({"present_speed_mps": 0.001, "max_jerk_mps3": 1.0}, "present_speed_mps"),
    ],
)
def test_limits_that_cannot_be_are_refused(keywords: dict[str, Any], told: str) -> None:
    with pytest.raises(ConfigError, match=told):
        plan_motion(STRAIGHT, None, ROOM, "warehouse_amr", **keywords)


def test_requests_that_cannot_be_are_refused(motion: MotionPlan, planner: Planner) -> None:
    def plan_among(pose: tuple[float, float, float]) -> MotionPlan:
        moving = Predictions([MovingObstacle(radius_m=0.3, pose=pose)], 5)
        return plan_motion(STRAIGHT, moving, ROOM, "warehouse_amr")

    with pytest.raises(InvalidRequest, match="off the map"):
        plan_among((99, 4, 0))
    with pytest.raises(InvalidRequest, match="inside the vehicle"):
        plan_among((1.6, 4, 0))
    with pytest.raises(InvalidPath, match="not certified"):
        plan_motion(STRAIGHT + [0.0, 3.9], None, ROOM, "warehouse_amr")
    with pytest.raises(InvalidPath, match="no path"):
        plan_motion(planner.plan((2, 2, 0), (10, 2, 0), budget=3))
    with pytest.raises(TypeError, match="hint: 'max_speed_mps'"):
        plan_motion(STRAIGHT, None, ROOM, max_speed=1.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="expected Predictions; hint"):
        plan_motion(STRAIGHT, [walker()], ROOM)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="made by plan_motion"):
        MotionPlan()


def test_the_judge_names_place_and_time_of_what_is_violated(motion: MotionPlan) -> None:
    assert motion.judge() == motion.certificate
    sooner = Predictions([walker(5.5, -0.3)], 20)
    hit = motion.judge(sooner)
    assert not hit.valid and hit.nearest and hit.min_distance_m is not None
    worst = next(one for one in hit.violations if one.kind == "distance")
    assert worst.limit == 0.1 and worst.amount < 0.1
    at = motion.at([worst.t_s])
    assert at["s"][0] == pytest.approx(worst.s_m, abs=1e-6)
    assert (at["x"][0], at["y"][0]) == pytest.approx(worst.pose[:2], abs=1e-6)
    slow = motion.judge(max_speed_mps=0.5)
    assert {one.kind for one in slow.violations} == {"speed"}
    far = motion.judge(distance_m=5.0)
    assert {one.kind for one in far.violations} == {"distance"}
    with pytest.raises(ConfigError, match="distance_m = -1"):
        motion.judge(distance_m=-1.0)


def test_profiles_from_anywhere_are_judged(motion: MotionPlan) -> None:
    assert motion.judge(profile=motion.profile) == motion.certificate
    rows = np.column_stack([motion.profile[name] for name in motion.profile.dtype.names or ()])
    assert motion.judge(profile=rows) == motion.certificate
    jump = rows.copy()
    jump[2:, 1] += 0.1
    assert {one.kind for one in motion.judge(profile=jump).violations} >= {"discontinuity"}
    endless = motion.judge(profile=[[0, 0, 0, 0, 0, 1e300]])
    assert [one.kind for one in endless.violations] == ["distance"], "nothing is proven of it"
    rows[0, 2] = np.nan
    assert [one.kind for one in motion.judge(profile=rows).violations] == ["malformed"]
    with pytest.raises(InvalidPath, match=r"expected \(n, 6\)"):
        motion.judge(profile=[[0.0, 1.0]])
    with pytest.raises(InvalidPath, match="no field 't'"):
        motion.judge(profile=np.zeros(3, dtype=[("x", "f8")]))


def test_a_plan_of_motion_survives_pickling_bit_for_bit(plan: Plan) -> None:
    moving = Predictions([MovingObstacle(radius_m=0.3, pose=(9, 6.5, 0), speed_mps=-0.4)], 15)
    one = plan_motion(plan, moving, max_jerk_mps3=2.0)
    other = pickle.loads(pickle.dumps(one))
    assert other.to_dict() == one.to_dict() and other.certificate == one.certificate
    assert other.judge() == one.certificate and other.predictions == moving
    for name in ("poses", "profile", "stops", "regions"):
        np.testing.assert_array_equal(getattr(other, name), getattr(one, name))


@pytest.mark.parametrize("flags", [(), ("--jerk", "1"), ("--keep-distance", "0.3")])
def test_the_same_drive_as_the_command_line_bit_for_bit(
    program: Path, tmp_path: Path, flags: tuple[str, ...]
) -> None:
    slow = MovingObstacle(radius_m=0.3, pose=(45, 24, 0), speed_mps=0.25, growth_mps=0.001)
    Predictions([slow], 60).save(tmp_path / "moving.json")
    out = tmp_path / "plan.json"
    words = ("plan", "--map", "parking-lot", "--request", "back-in", "--budget", "none")
    among = ("--moving", str(tmp_path / "moving.json"), *flags, "--out", str(out))
    ran = subprocess.run([program, *words, *among], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    answer = json.loads(out.read_text())
    grid = OccupancyGrid.builtin("parking-lot")
    given = {"--jerk": "max_jerk_mps3", "--keep-distance": "distance_m"}
    keywords: dict[str, Any] = {given[flags[0]]: float(flags[1])} if flags else {}
    motion = plan_motion(
        Planner(grid).plan(*grid.requests["back-in"]),
        Predictions.load(tmp_path / "moving.json"),
        **keywords,
    )
    assert motion.to_dict() == answer["motion"] and motion.lost_s > 1
    assert answer["motion"]["profile"]["source"] == "lattice"
    poses = [pose for pose in answer["path"]["poses"] if pose["time"] is not None]
    for name, key in (("t", "time"), ("speed", "speed"), ("steer_rate", "steer_rate")):
        assert motion.poses[name].tolist() == [pose[key] for pose in poses]


def test_the_same_words_as_the_command_line(program: Path, tmp_path: Path) -> None:
    path = tmp_path / "bad.json"
    path.write_text('{"horizon_s": 0, "obstacles": []}')
    words = ("plan", "--map", "parking-lot", "--request", "back-in", "--moving", str(path))
    told = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    with pytest.raises(InvalidObstacle) as raised:
        Predictions.load(path)
    assert told.returncode == 2 and str(raised.value) in told.stderr


@pytest.mark.parametrize("controller", ["regulated-pure-pursuit", "mpc", "stanley"])
def test_controllers_drive_in_time(motion: MotionPlan, controller: Any) -> None:
    drive = track_in_time(motion, controller=controller, start_offset={"lateral_m": 0.05})
    assert drive and drive.status == "arrived" and motion.duration_s
    trace = drive.trace
    assert np.abs(trace["speed"]).max() <= 1.2 and trace["speed"][0] == 0
    assert trace["t"][-1] == pytest.approx(motion.duration_s, rel=0.5)
    assert drive.summary["goal_error_m"] < 0.1
    assert drive.config["controller"]["law"] == controller


def test_actuators_delay_a_drive() -> None:
    motion = plan_motion(STRAIGHT, None, ROOM, "warehouse_amr")
    quick = track_in_time(motion, record_interval_s=0.02)
    late = track_in_time(motion, delay_s=0.3, record_interval_s=0.02)
    begins = [drive.trace["t"][np.argmax(drive.trace["speed"] > 0)] for drive in (quick, late)]
    assert begins[1] - begins[0] == pytest.approx(0.3, abs=0.021)
    weak = track_in_time(motion, max_acceleration_mps2=0.2, record_interval_s=0.02)
    gains = np.diff(weak.trace["speed"]) / np.diff(weak.trace["t"])
    assert np.nanmax(gains) <= 0.2 + 1e-6
    assert "speed" not in (formicar.track(STRAIGHT, ROOM, "warehouse_amr").trace.dtype.names or ())


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({"controller": "lqr"}, "mpc"),
        ({"n_steps": 5}, "hint: controller='mpc'"),
        ({"controller": "mpc", "n_steps": 1}, "n_steps = 1"),
        ({"delay": 0.1}, "hint: 'delay_s'"),
        ({"delay_s": 2.0}, "delay_s = 2"),
        ({"speed_mps": 1.0}, "track_in_time"),
    ],
)
def test_settings_in_time_that_cannot_be_are_refused(
    motion: MotionPlan, settings: dict[str, Any], told: str
) -> None:
    with pytest.raises(ConfigError, match=told):
        track_in_time(motion, **settings)


def distances(motion: MotionPlan, moving: Predictions) -> NDArray[np.float64]:
    """Distances of the body from discs that may grow, over drive and horizon, by NumPy alone."""
    t = np.arange(0.0, max(moving.horizon_s, motion.duration_s or 0.0) + 0.5, 0.01)
    at, centers = motion.at(t), moving.poses(t)
    body = np.asarray(motion.vehicle.footprint)
    cos, sin = np.cos(at["heading"]), np.sin(at["heading"])
    found = []
    for center, obstacle in zip(centers, moving.obstacles, strict=True):
        x, y = center[:, 0] - at["x"], center[:, 1] - at["y"]
        seen = np.column_stack((cos * x + sin * y, cos * y - sin * x))
        low, high = body.min(axis=0), body.max(axis=0)
        gap = np.hypot(*np.maximum(0.0, np.maximum(low - seen, seen - high)).T)
        document = obstacle.to_dict()
        grown = document["growth_mps"] * np.minimum(t, moving.horizon_s)
        found.append(gap - document["shape"]["disc"]["radius_m"] - grown)
    return np.min(found, axis=0)  # type: ignore[no-any-return]


@given(
    places=st.lists(
        st.tuples(st.floats(3.0, 11.0), st.floats(0.5, 7.5), st.floats(-1, 1), st.floats(-1, 1)),
        min_size=1,
        max_size=3,
    ),
    growth_mps=st.floats(0.0, 0.05),
    distance_m=st.floats(0.05, 0.5),
    jerk=st.sampled_from([None, 1.0]),
)
def test_a_certified_drive_keeps_its_distance_in_a_dense_check(
    places: list[tuple[float, ...]], growth_mps: float, distance_m: float, jerk: float | None
) -> None:
    walkers = [
        MovingObstacle(radius_m=0.3, pose=(x, y, 0), velocity_mps=(u, v), growth_mps=growth_mps)
        for x, y, u, v in places
    ]
    moving = Predictions(walkers, 12.0)
    try:
        motion = plan_motion(
            STRAIGHT, moving, ROOM, "warehouse_amr", distance_m=distance_m, max_jerk_mps3=jerk
        )
    except InvalidRequest:
        assume(False)
    assume(motion)
    assert motion.certificate and motion.judge() == motion.certificate
    least_m = distances(motion, moving).min()
    proven_m = motion.certificate.min_distance_m
    assert proven_m is not None and proven_m >= distance_m
    assert least_m >= proven_m - 1e-6
    assert least_m <= proven_m + 0.05, "the proven distance is that of the nearest moment"
