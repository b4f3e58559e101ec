"""Scenario files."""

from __future__ import annotations

import os
from typing import NamedTuple

from . import _formicar
from ._hints import suggests
from ._map import OccupancyGrid
from ._records import Pose
from ._vehicle import Vehicle


class Scenario(NamedTuple):
    """A map, a vehicle, a start and a goal.

    Attributes
    ----------
    map : OccupancyGrid
        The map; scenarios on one map share it.
    vehicle : Vehicle
        The vehicle.
    start, goal : tuple of float
        Poses ``(x, y, heading)``, meters and radians.
    """

    map: OccupancyGrid
    vehicle: Vehicle
    start: Pose
    goal: Pose


@suggests
def load_scenarios(
    path: str | os.PathLike[str], *, resolution: float | None = None
) -> dict[str, Scenario]:
    """Read the scenarios of a file.

    Parameters
    ----------
    path : path
        Car scenarios (``.json``, with their maps beside them) or a TPCAP case (``.csv``).
    resolution : float, optional
        Side of a cell in meters, where the file leaves that open.

    Returns
    -------
    dict of str to Scenario
        The scenarios by name, in the order of the file.

    Raises
    ------
    FileNotFoundError
        No such file.
    InvalidMap
        A file, or a map that it names, with a mistake.
    """
    loaded = _formicar.load_scenarios(os.fspath(path), resolution)
    return {
        name: Scenario(
            OccupancyGrid._of(grid),
            Vehicle._of(car),
            (start[0], start[1], start[2]),
            (goal[0], goal[1], goal[2]),
        )
        for name, grid, car, start, goal in loaded
    }
