"""What the tests share."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings
from numpy.typing import NDArray

import formicar
from formicar.mapping import Log

# The same cases every time, so that a green tree stays green.
N_EXAMPLES = int(os.environ.get("FORMICAR_EXAMPLES", "60"))
settings.register_profile("formicar", derandomize=True, deadline=None, max_examples=N_EXAMPLES)
settings.load_profile("formicar")


@pytest.fixture(scope="session")
def hall() -> formicar.OccupancyGrid:
    """A hall of 12 x 8 m with a wall in its middle that leaves 3 m."""
    walls = np.zeros((80, 120), dtype=bool)
    walls[:50, 60] = True
    return formicar.OccupancyGrid(walls, resolution=0.1)


@pytest.fixture(scope="session")
def planner(hall: formicar.OccupancyGrid) -> formicar.Planner:
    """The default planner in the hall."""
    return formicar.Planner(hall, "warehouse_amr")


@pytest.fixture(scope="session")
def plan(planner: formicar.Planner) -> formicar.Plan:
    """A path around the wall."""
    found = planner.plan((2.0, 2.0, 0.0), (10.0, 2.0, 0.0), seed=7)
    assert found
    return found


@pytest.fixture(scope="session")
def colony() -> formicar.Plan:
    """A path of a colony, with its ants."""
    ants = formicar.Planner("lei-map1", planner="lei2020", config={"colony.n_iterations": 12})
    found = ants.plan(*next(iter(ants.map.requests.values())), keep_ants=True)
    assert found
    return found


@pytest.fixture(scope="session")
def program() -> Path:
    """The command line of the same sources: $FORMICAR, or the one on the path."""
    found = os.environ.get("FORMICAR") or shutil.which("formicar")
    if not found:
        pytest.skip("no command line: set FORMICAR to target/debug/formicar")
    return Path(found)


class Room:
    """A room of 8 x 5 m with a pillar, and a robot with a laser of 180 beams that drives in it."""

    WALLS = (
        ((0, 0), (8, 0)), ((8, 0), (8, 5)), ((8, 5), (5, 5)), ((5, 5), (5, 4)), ((5, 4), (3.5, 4)),
        ((3.5, 4), (3.5, 5)), ((3.5, 5), (0, 5)), ((0, 5), (0, 0)),
        ((4, 2), (4.4, 2)), ((4.4, 2), (4.4, 2.4)), ((4.4, 2.4), (4, 2.4)), ((4, 2.4), (4, 2)),
    )  # fmt: skip
    ANGLE_MIN = -np.pi / 2
    ANGLE_INCREMENT = np.pi / 180

    def __init__(self, n_scans: int = 40) -> None:
        t = np.linspace(0.0, 1.0, n_scans)
        x, y = 1.0 + 2.2 * t, 1.2 + 0.4 * np.sin(3.0 * t)
        heading = np.arctan2(1.2 * np.cos(3.0 * t), 2.2)
        self.poses = np.column_stack([x, y, heading])
        self.times = 1_700_000_000.0 + 0.25 * np.arange(n_scans)
        self.ranges = np.array([self.scan(pose) for pose in self.poses], dtype=np.float32)

    def scan(self, pose: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return exact ranges from a pose."""
        angles = pose[2] + self.ANGLE_MIN + self.ANGLE_INCREMENT * np.arange(180)
        beams = np.column_stack([np.cos(angles), np.sin(angles)])
        found = np.full(180, np.inf)
        for a, b in np.array(self.WALLS, dtype=float):
            along, to = b - a, a - pose[:2]
            cross = beams[:, 0] * along[1] - beams[:, 1] * along[0]
            with np.errstate(divide="ignore", invalid="ignore"):
                far = (to[0] * along[1] - to[1] * along[0]) / cross
                share = (to[0] * beams[:, 1] - to[1] * beams[:, 0]) / cross
            hit = (far > 0) & (share >= 0) & (share <= 1)
            found = np.where(hit, np.minimum(found, far), found)
        return found

    def log(self, odometry: bool = True) -> Log:
        """Return its scans as a log."""
        poses = self.poses if odometry else None
        return Log(self.ranges, self.ANGLE_MIN, self.ANGLE_INCREMENT, poses, self.times)

    def write_carmen(self, path: Path) -> None:
        """Write its scans as a CARMEN log."""
        lines = []
        for row, (x, y, heading), time in zip(self.ranges, self.poses, self.times, strict=True):
            ranges = " ".join(repr(float(value)) for value in row)
            pose = f"{x!r} {y!r} {heading!r}".replace("np.float64(", "").replace(")", "")
            lines.append(f"FLASER 180 {ranges} {pose} {pose} {time} host {time}\n")
        path.write_text("".join(lines))


@pytest.fixture(scope="session")
def room() -> Room:
    """A room with the scans of a drive in it."""
    return Room()
