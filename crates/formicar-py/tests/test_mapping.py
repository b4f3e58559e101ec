"""Maps from scans, and a laser found in them."""

from __future__ import annotations

import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import formicar
from formicar import ConfigError, InvalidLog, OccupancyGrid
from formicar.mapping import BuiltMap, Localizer, Log, Mapper, build_map

from .conftest import Room

# Calls that a type checker refuses too.
LOG: Any = Log
MAPPER: Any = Mapper
LOCALIZER: Any = Localizer


@pytest.fixture(scope="module")
def built(room: Room) -> BuiltMap:
    return build_map(room.log())


def relative(a: Any, b: Any) -> tuple[float, float, float]:
    """Return pose b in the frame of pose a."""
    x, y = b[0] - a[0], b[1] - a[1]
    cos, sin = np.cos(a[2]), np.sin(a[2])
    return (cos * x + sin * y, cos * y - sin * x, b[2] - a[2])


def test_a_log_keeps_its_arrays(room: Room) -> None:
    log = room.log()
    assert len(log) == 40
    assert np.array_equal(log.ranges, room.ranges)
    assert log.odometry is not None and np.array_equal(log.odometry, room.poses)
    assert np.array_equal(log.times, room.times)
    assert (log.angle_min, log.angle_increment) == (room.ANGLE_MIN, room.ANGLE_INCREMENT)
    assert log.reference is None and log.warnings == []
    assert log.without_odometry().odometry is None
    assert repr(log) == "Log(40 scans of 180 beams, odometry)"
    with pytest.raises(ValueError, match="read-only"):
        log.ranges[0, 0] = 1.0


def test_a_map_has_the_walls_and_the_way(room: Room, built: BuiltMap) -> None:
    truth = [relative(room.poses[0], pose) for pose in room.poses]
    assert np.abs(built.trajectory - truth).max() < 0.02
    grid = built.map
    assert grid.resolution == 0.05
    # The middle of the drive is free, the edge of the pillar is occupied.
    pillar = relative(room.poses[0], (4.02, 2.02, 0.0))
    cell = grid.cell_at(pillar[0], pillar[1])
    assert cell is not None
    col, row = cell
    near = grid.data[row - 1 : row + 2, col - 1 : col + 2]
    assert (near == 100).any()
    middle = built.trajectory[20]
    free = grid.cell_at(middle[0], middle[1])
    assert free is not None and grid.data[free[1], free[0]] == 0
    assert built.report["schema"].startswith("formicar/map-report/")
    assert "<svg" in built.to_svg("room") and "40 scans" in repr(built)


def test_the_map_can_be_planned_on(built: BuiltMap) -> None:
    # The ground behind the first pose was not seen.
    ground = built.map.with_unknown("free")
    start, goal = built.trajectory[0], built.trajectory[30]
    plan = formicar.Planner(ground, "warehouse_amr").plan(tuple(start), tuple(goal))
    assert plan and plan.certificate


def test_scan_after_scan_gives_the_same_map(room: Room, built: BuiltMap, tmp_path: Path) -> None:
    mapper = Mapper()
    for i, (ranges, pose) in enumerate(zip(room.ranges, room.poses, strict=True)):
        found = mapper.add(ranges, room.ANGLE_MIN, room.ANGLE_INCREMENT, tuple(pose))
        assert found == mapper.pose and mapper.quality == ("first" if i == 0 else "ok")
        if i == 20:
            mapper.save(tmp_path / "half.session")
            assert [path.name for path in tmp_path.iterdir()] == ["half.session"]
    assert (mapper.n_scans, mapper.n_key_scans) == (40, mapper.n_key_scans)
    again = mapper.build()
    assert again.map == built.map
    assert np.array_equal(again.trajectory, built.trajectory)
    assert Mapper.load(tmp_path / "half.session").n_scans == 21


def test_a_session_goes_on_with_another_log(room: Room, tmp_path: Path) -> None:
    first = Mapper()
    first.add_log(room.log())
    first.save(tmp_path / "room.session")
    second = Mapper.load(tmp_path / "room.session")
    start = relative(room.poses[0], room.poses[10])
    later = Log(
        room.ranges[10:], room.ANGLE_MIN, room.ANGLE_INCREMENT, room.poses[10:], room.times[10:]
    )
    second.add_log(later, start=start)
    assert second.n_scans == 70
    ends = second.build().trajectory[[39, 69]]
    assert np.abs(ends[0] - ends[1]).max() < 0.05


def test_the_same_map_as_the_command_line(program: Path, room: Room, tmp_path: Path) -> None:
    room.write_carmen(tmp_path / "room.log")
    words = ("map", "build", "room.log", "--out", "theirs.yaml", "--session", "theirs.session")
    ran = subprocess.run(
        [program, *words, "--trajectory", "t.csv"], cwd=tmp_path, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    ours = build_map(Log.read(tmp_path / "room.log"))
    ours.map.save(tmp_path / "ours.yaml")
    for kind in (".pgm", ".yaml"):
        theirs = (tmp_path / f"theirs{kind}").read_bytes()
        assert (tmp_path / f"ours{kind}").read_bytes() == theirs.replace(b"theirs", b"ours")
    rows = np.loadtxt(tmp_path / "t.csv", delimiter=",", skiprows=1)
    assert np.abs(rows[:, 2:5] - ours.trajectory).max() < 1e-6
    mapper = Mapper()
    mapper.add_log(Log.read(tmp_path / "room.log"))
    mapper.save(tmp_path / "ours.session")
    assert (tmp_path / "ours.session").read_bytes() == (tmp_path / "theirs.session").read_bytes()
    locate = ("locate", "room.log", "--map", "theirs.session", "--start", "0,0,0")
    ran = subprocess.run(
        [program, *locate, "--trajectory", "l.csv"], cwd=tmp_path, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    localizer = Localizer(tmp_path / "theirs.session", (0.0, 0.0, 0.0))
    found = localizer.add_log(Log.read(tmp_path / "room.log"))
    rows = np.loadtxt(tmp_path / "l.csv", delimiter=",", skiprows=1, usecols=(2, 3, 4))
    assert np.abs(rows - [located.pose for located in found]).max() < 1e-6


def test_the_same_words_for_the_same_faults(program: Path, tmp_path: Path) -> None:
    (tmp_path / "empty.log").write_text("# nothing\n")
    (tmp_path / "drive.bag").write_bytes(b"#ROSBAG V2.0\n")
    for name in ("empty.log", "drive.bag"):
        path = tmp_path / name
        with pytest.raises(InvalidLog) as raised:
            Log.read(path)
        words = ("map", "build", str(path), "--out", str(tmp_path / "a.yaml"))
        ran = subprocess.run([program, *words], capture_output=True, text=True, check=False)
        assert (ran.returncode, str(raised.value) in ran.stderr) == (2, True), ran.stderr
    with pytest.raises(InvalidLog, match="--scan-topic"):
        Log.read(tmp_path / "empty.log", scan_topic="/scan")
    with pytest.raises(FileNotFoundError, match="missing.log"):
        Log.read(tmp_path / "missing.log")


@pytest.mark.parametrize("cells", [False, True])
def test_the_laser_is_found(room: Room, built: BuiltMap, cells: bool) -> None:
    localizer = Localizer(built.map if cells else built, (0.0, 0.0, 0.0))
    for ranges, pose in zip(room.ranges, room.poses, strict=True):
        located = localizer.add(ranges, room.ANGLE_MIN, room.ANGLE_INCREMENT, tuple(pose))
        truth = relative(room.poses[0], pose)
        assert located and np.abs(np.subtract(located.pose, truth)).max() < 0.05
        assert located.covariance.shape == (3, 3)
        assert (np.linalg.eigvalsh(located.covariance) > 0).all()
        assert 0.5 < located.score <= 1 and located.mapped_share > 0.8


def test_the_laser_is_found_without_a_start(room: Room, built: BuiltMap) -> None:
    found = Localizer(built).add_log(room.log())
    assert not found[0] and found[0].quality == "lost"
    truth = relative(room.poses[0], room.poses[-1])
    assert found[-1] and np.abs(np.subtract(found[-1].pose, truth)).max() < 0.05


def test_a_scan_that_tells_nothing_is_said_to(room: Room, built: BuiltMap) -> None:
    localizer = Localizer(built, (0.0, 0.0, 0.0))
    nothing = np.full(180, np.nan)
    located = localizer.add(nothing, room.ANGLE_MIN, room.ANGLE_INCREMENT, (0.0, 0.0, 0.0))
    assert not located and located.quality == "degenerate"
    elsewhere = np.random.default_rng(7).uniform(0.5, 8.0, 180)
    located = localizer.add(elsewhere, room.ANGLE_MIN, room.ANGLE_INCREMENT, (0.1, 0.0, 0.0))
    assert located.quality == "lost" and located.pose[0] == pytest.approx(0.1, abs=1e-9)


def test_settings_are_checked(room: Room, built: BuiltMap) -> None:
    assert build_map(room.log(), resolution=0.1).map.resolution == 0.1
    assert Mapper(max_range=8.0, min_range=0.2).config["ranges"]["max_m"] == 8.0
    assert Mapper(config={"n_refinements": 1}).config["n_refinements"] == 1
    assert Mapper(preset="fossel2015").config["truncation_cells"] == 5.0
    cases: list[tuple[dict[str, Any], str]] = [
        ({"resolution": 9.0}, "resolution_m = 9"),
        ({"resolution": "fine"}, "expected a number of meters"),
        ({"min_range": 5.0, "max_range": 1.0}, "least < greatest"),
        ({"config": {"resolutoin_m": 1}}, "resolutoin_m"),
        ({"config": {"loops": {"nothing": 1}}}, "nothing"),
        ({"preset": "slam"}, "fossel2015"),
        ({"resolution": float("nan")}, "not finite"),
    ]
    for wrong, words in cases:
        with pytest.raises(ConfigError, match=words):
            MAPPER(**wrong)
    with pytest.raises(ConfigError, match="has its own parameters"):
        Localizer(built, max_range=5.0)
    with pytest.raises(TypeError, match="hint: 'max_range'"):
        MAPPER(max_rang=5.0)


def test_wrong_arrays_are_refused(room: Room) -> None:
    ranges, angles = room.ranges, (room.ANGLE_MIN, room.ANGLE_INCREMENT)
    odometry = room.poses.copy()
    odometry[3, 1] = np.nan
    jump = room.poses.copy()
    jump[5:, 0] += 50.0
    back = room.times.copy()
    back[5] -= 60.0
    for arguments, words in [
        ((ranges[0], *angles), r"shape \(180,\); expected \(n_scans, n_beams\)"),
        ((ranges[:0], *angles), "no laser scan"),
        ((ranges[:, :0], *angles), "at least one beam"),
        ((ranges, 0.0, 0.0), "the step must be above 0"),
        ((ranges, 0.0, 0.1), "at most a turn"),
        ((ranges, np.nan, 0.01), "all finite"),
        ((ranges, "left", 0.01), "angle_min = 'left'"),
        ((ranges, *angles, room.poses[:5]), r"odometry has shape \(5, 3\); expected \(40, 3\)"),
        ((ranges, *angles, room.poses[:, :2]), r"expected \(40, 3\)"),
        ((ranges, *angles, odometry), "odometry of scan 3 is not finite: nan"),
        ((ranges, *angles, jump), "jumps 50.* m before scan 5"),
        ((ranges, *angles, None, room.times[:3]), r"times has shape \(3,\)"),
        ((ranges, *angles, None, back), "earlier than the scan before it"),
    ]:
        with pytest.raises(InvalidLog, match=words):
            LOG(*arguments)
    for values in (ranges.astype(str), ranges.astype(complex), ranges > 1.0, [[1.0], [1.0, 2.0]]):
        with pytest.raises(TypeError, match="ranges"):
            LOG(values, *angles)


def test_wrong_scans_are_refused(room: Room, built: BuiltMap) -> None:
    mapper = Mapper()
    angles = (room.ANGLE_MIN, room.ANGLE_INCREMENT)
    with pytest.raises(InvalidLog, match="no laser scan"):
        mapper.build()
    mapper.add(room.ranges[0], *angles)
    cases: list[tuple[tuple[Any, ...], str]] = [
        ((room.ranges[0][:90], *angles), "90 beams, the scans before it have 180"),
        ((room.ranges, *angles), r"expected \(n_beams,\)"),
        ((room.ranges[0], *angles, (0.0, 0.0)), "three numbers"),
        ((room.ranges[0], *angles, (0.0, 0.0, np.inf)), "must be finite"),
        (([], *angles), "0 beams"),
    ]
    for arguments, words in cases:
        with pytest.raises(InvalidLog, match=words):
            mapper.add(*arguments)
    assert mapper.n_scans == 1
    empty = OccupancyGrid(np.zeros((9, 9), dtype=bool), 0.1)
    with pytest.raises(InvalidLog, match="no occupied cell"):
        Localizer(empty)
    with pytest.raises(TypeError, match="expected BuiltMap"):
        LOCALIZER(3)
    with pytest.raises(InvalidLog, match="found nowhere in the map"):
        noise = np.random.default_rng(1).uniform(0.5, 30.0, (5, 180))
        other = Mapper()
        other.add_log(room.log())
        other.add_log(Log(noise, *angles))


def test_damaged_sessions_are_refused(room: Room, tmp_path: Path) -> None:
    mapper = Mapper()
    mapper.add_log(room.log())
    path = tmp_path / "a.session"
    mapper.save(path)
    path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(InvalidLog, match="checksum"):
        Mapper.load(path)
    with pytest.raises(FileNotFoundError):
        Mapper.load(tmp_path / "b.session")


def test_other_threads_run_meanwhile(room: Room) -> None:
    beats: list[float] = []
    over = threading.Event()

    def beat() -> None:
        while not over.is_set():
            beats.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=beat)
    thread.start()
    begun = time.perf_counter()
    build_map(room.log())
    ended = time.perf_counter()
    over.set()
    thread.join()
    assert len([at for at in beats if begun < at < ended]) >= 3


@given(
    ranges=arrays.arrays(
        np.float64,
        st.tuples(st.integers(1, 4), st.integers(1, 40)),
        elements=st.floats(allow_nan=True, allow_infinity=True, width=64),
    ),
    step=st.floats(0.01, 0.15),
)
def test_no_ranges_make_it_fail_but_by_its_own_errors(ranges: Any, step: float) -> None:
    mapper = Mapper()
    mapper.add_log(Log(ranges, -1.0, step))
    assert mapper.n_scans == len(ranges)
    try:
        built = mapper.build()
    except InvalidLog:
        return
    assert built.trajectory.shape == (len(ranges), 3)
    assert np.isfinite(built.trajectory).all()
