"""Whether a path can still be driven, by formicar's judge."""

from __future__ import annotations

import math
from dataclasses import dataclass

import formicar
import numpy as np

from .paths import Rows
from .planning import kinds_of


@dataclass(frozen=True)
class Validity:
    """The judge's word on a path, and the poses to which it objects."""

    is_valid: bool
    indices: list[int]
    sentence: str


def first_ahead(rows: Rows, robot: tuple[float, float] | None) -> int:
    """Return the index of the pose that is nearest to the robot: what is behind does not matter."""
    if robot is None:
        return 0
    return int(np.argmin(np.hypot(rows[:, 0] - robot[0], rows[:, 1] - robot[1])))


def cut(rows: Rows, lookahead_m: float) -> Rows:
    """Return the beginning of a path, as far as the robot looks ahead; below 0 all of it."""
    if lookahead_m < 0.0:
        return rows
    steps = np.hypot(*np.diff(rows[:, :2], axis=0).T)
    return rows[: 1 + int(np.searchsorted(np.cumsum(steps), lookahead_m, side="right"))]


def judged(
    rows: Rows, grid: formicar.OccupancyGrid, vehicle: formicar.Vehicle, *, first: int = 0
) -> Validity:
    """Judge a path.

    Parameters
    ----------
    rows : ndarray, shape (n, 3)
        ``x, y, yaw`` of the rear axle.
    grid, vehicle
        The map and the vehicle.
    first : int, optional
        The index of the first row.

    Returns
    -------
    Validity
        Invalid poses are those whose body overlaps an occupied cell or leaves the map, and those
        nearest to any other violation, which may lie between two poses.
    """
    check = formicar.check(rows, grid, vehicle)
    if check:
        return Validity(True, [], "")
    found = {n for n, row in enumerate(rows) if _is_blocked(row.tolist(), grid, vehicle)}
    for violation in check.certificate.violations:
        x, y, _ = violation.pose
        found.add(int(np.argmin(np.hypot(rows[:, 0] - x, rows[:, 1] - y))))
    message = check.certificate.violations[0].message
    return Validity(False, sorted(first + n for n in found), message)


def _is_blocked(pose: list[float], grid: formicar.OccupancyGrid, vehicle: formicar.Vehicle) -> bool:
    return bool(kinds_of(tuple(pose), _around(pose, grid, vehicle), vehicle) & _BLOCKED)


_BLOCKED = {"collision", "leaves_map"}


def _around(
    pose: list[float], grid: formicar.OccupancyGrid, vehicle: formicar.Vehicle
) -> formicar.OccupancyGrid:
    """Return the part of a map that a body at this pose can touch; judging it is quick."""
    at = grid.cell_at(pose[0], pose[1])
    if at is None:
        return grid
    reach = float(np.max(np.hypot(*vehicle.footprint.T))) if not vehicle.is_point else 0.0
    n = math.ceil(reach / grid.resolution) + 3
    col, row = max(at[0] - n, 0), max(at[1] - n, 0)
    cells = grid.data[row : at[1] + n + 1, col : at[0] + n + 1]
    x, y, yaw = grid.origin
    dx, dy = col * grid.resolution, row * grid.resolution
    corner = (
        x + math.cos(yaw) * dx - math.sin(yaw) * dy,
        y + math.sin(yaw) * dx + math.cos(yaw) * dy,
        yaw,
    )
    return formicar.OccupancyGrid(_plain(cells), grid.resolution, corner)


def _plain(cells: np.ndarray) -> np.ndarray:
    """Return cells as blocked or not, which is all that a body asks."""
    return (cells < 0) | (cells >= 100)
