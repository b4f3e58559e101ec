"""A laser found in a map."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _formicar
from ._arrays import frozen, pose_of
from ._formicar import ConfigError, InvalidLog
from ._hints import suggests
from ._lazy import np
from ._lidar_log import Log, angles_of, odometry_of, ranges_of
from ._map import OccupancyGrid
from ._mapper import BuiltMap, Mapper, changes_of
from ._records import Pose

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)
class Located:
    """The pose of a scan in a map: true unless the robot is lost or the scan tells nothing."""

    pose: Pose
    """Pose of the laser; the expected one where the robot is lost."""
    covariance: NDArray[np.float64]
    """Over x, y (square meters) and heading (square radians), shape (3, 3)."""
    quality: str
    """``first`` (by a search in the whole map), ``ok``, ``widened``, ``lost`` or ``degenerate``."""
    score: float
    """How well hits and surfaces agree, 0 to 1."""
    mapped_share: float
    """Share of hits near a mapped surface, 0 to 1."""

    def __bool__(self) -> bool:
        return self.quality not in ("lost", "degenerate")


class Localizer:
    """Finds the laser in a map, scan after scan.

    Parameters
    ----------
    map : BuiltMap or OccupancyGrid or path
        A map made of scans is more exact than its cells, which know surfaces to half a cell. A path
        is that of a map file, or of a session (``.session``).
    start : (float, float, float), optional
        Pose of the laser at the first scan; without it the first four scans are searched in the
        whole map, and are ``lost`` until then.
    min_range, max_range, no_return : float, optional
        As in `Mapper`, for maps of cells; a map made of scans has its own.
    config : mapping, optional
        As in `Mapper`, for maps of cells.

    Raises
    ------
    InvalidLog
        A map without an occupied cell.
    ConfigError
        A parameter that does not exist, is out of its range, or goes with a map made of scans.
    """

    _core: _formicar.MapLocalizer

    @suggests
    def __init__(
        self,
        map: BuiltMap | OccupancyGrid | str | os.PathLike[str],
        start: tuple[float, float, float] | None = None,
        *,
        min_range: float | None = None,
        max_range: float | None = None,
        no_return: float | None = None,
        config: Mapping[str, Any] | None = None,
    ) -> None:
        pose = None if start is None else pose_of(start, "start", InvalidLog)
        changes = changes_of(config, None, min_range, max_range, no_return)
        if isinstance(map, (str, os.PathLike)):
            is_session = Path(map).suffix == ".session"
            map = Mapper.load(map).build() if is_session else OccupancyGrid.load(map)
        if isinstance(map, BuiltMap):
            if changes:
                raise ConfigError(
                    f"{next(iter(changes))}: a map made of scans has its own parameters; hint: "
                    "leave it out, or take the cells (.map)"
                )
            self._core = _formicar.MapLocalizer.in_map(map._core, pose)
        elif isinstance(map, OccupancyGrid):
            self._core = _formicar.MapLocalizer.in_grid(map._core, pose, changes)
        else:
            raise TypeError(
                f"map is of type {type(map).__name__}; expected BuiltMap, OccupancyGrid or a path"
            )

    @suggests
    def add(
        self,
        ranges: ArrayLike,
        angle_min: float,
        angle_increment: float,
        odometry: tuple[float, float, float] | ArrayLike | None = None,
    ) -> Located:
        """Find the pose of the next scan.

        Parameters
        ----------
        ranges : array_like, shape (n_beams,)
            Ranges, meters.
        angle_min, angle_increment : float
            Direction of the first beam, and angle from beam to beam, radians.
        odometry : (float, float, float), optional
            Pose of the laser by dead reckoning, meters and radians.

        Returns
        -------
        Located
            The pose, its covariance, and whether the robot is lost.

        Raises
        ------
        InvalidLog
            Values that make no scan.
        """
        return _located(
            self._core.add(
                ranges_of(ranges, 1),
                angles_of(angle_min, angle_increment),
                odometry_of(odometry),
            )
        )

    def add_log(self, log: Log) -> list[Located]:
        """Find the pose of every scan of a log, as ``formicar locate`` does."""
        return [_located(row) for row in self._core.add_log(log._core)]


def _located(row: _formicar._LocatedRow) -> Located:
    pose, covariance, quality, score, mapped_share = row
    matrix = frozen(np.array(covariance, dtype=np.float64).reshape(3, 3))
    return Located(pose, matrix, quality, score, mapped_share)
