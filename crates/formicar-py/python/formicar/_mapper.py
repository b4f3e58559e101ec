"""Maps from scans."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from . import _formicar
from ._arrays import frozen, number_of, pose_of
from ._formicar import ConfigError, InvalidLog
from ._hints import suggests
from ._lidar_log import Log, angles_of, odometry_of, ranges_of
from ._map import OccupancyGrid
from ._records import Pose

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


class BuiltMap:
    """A map made of scans, with all that is known about it. Made by `build_map` and `Mapper`."""

    _core: _formicar.LidarMap

    def __init__(self) -> None:
        raise TypeError("maps are made by build_map and Mapper.build")

    @classmethod
    def _of(cls, core: _formicar.LidarMap) -> BuiltMap:
        built = cls.__new__(cls)
        built._core = core
        return built

    @property
    def map(self) -> OccupancyGrid:
        """Free, occupied and unknown cells, to plan on; ``map.save("depot.yaml")`` writes them."""
        return OccupancyGrid._of(self._core.grid())

    @property
    def trajectory(self) -> NDArray[np.float64]:
        """Pose of the laser at every scan, shape (n_scans, 3), meters and radians; read-only."""
        return frozen(self._core.trajectory())

    @property
    def report(self) -> dict[str, Any]:
        """Counts of scans by quality, loops accepted and refused, ranges, memory."""
        return dict(self._core.report())

    def to_svg(self, title: str = "") -> str:
        """Return the picture of the map with the trajectory and the loops."""
        return self._core.svg(title)

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def __repr__(self) -> str:
        n_rows, n_cols = self.map.shape
        return f"BuiltMap({n_rows} rows x {n_cols} columns, {len(self.trajectory)} scans)"


class Mapper:
    """Builds a map scan after scan.

    Parameters
    ----------
    resolution : float, optional
        Side of a cell, meters, 0.01 to 1; 0.05 by default.
    min_range, max_range : float, optional
        Ranges out of these limits are no hits, meters; 0.1 and 40 by default.
    no_return : float, optional
        Ranges from this one on mean "nothing seen", meters. By default `add_log` finds the code in
        the log; scans that are added one by one are taken to have none.
    preset : {"formicar", "fossel2015"}, optional
        The map's update.
    config : mapping, optional
        Any other parameter, nested as in `config`, for instance ``{"n_refinements": 1}``.

    Raises
    ------
    ConfigError
        A parameter that does not exist or is out of its range.

    Examples
    --------
    >>> import numpy as np
    >>> from formicar.mapping import Mapper
    >>> mapper = Mapper(resolution=0.1)
    >>> angles = np.deg2rad(np.arange(-180, 180))
    >>> room = np.minimum(2 / np.maximum(abs(np.cos(angles)), 1e-9),
    ...                   3 / np.maximum(abs(np.sin(angles)), 1e-9))
    >>> pose = mapper.add(room, angles[0], np.deg2rad(1.0), odometry=(0.0, 0.0, 0.0))
    >>> pose[0], mapper.quality, mapper.n_scans
    (0.0, 'first', 1)
    """

    _core: _formicar.LidarMapper

    @suggests
    def __init__(
        self,
        *,
        resolution: float | None = None,
        min_range: float | None = None,
        max_range: float | None = None,
        no_return: float | None = None,
        preset: Literal["formicar", "fossel2015"] = "formicar",
        config: Mapping[str, Any] | None = None,
    ) -> None:
        changes = changes_of(config, resolution, min_range, max_range, no_return)
        self._core = _formicar.LidarMapper(preset, changes)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Mapper:
        """Read a session that `save`, or ``map build --session``, has written.

        Raises
        ------
        InvalidLog
            No session, another version, or a damaged one.
        """
        mapper = cls.__new__(cls)
        mapper._core = _formicar.LidarMapper.of_session(Path(path).read_bytes())
        return mapper

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all that is needed to go on, as ``map build --session`` does.

        `Localizer` and ``formicar locate`` take such a file as a map.
        """
        target = Path(path)
        beside = target.with_name(f".{target.name}.{os.getpid()}")
        try:
            beside.write_bytes(self._core.session())
            beside.replace(target)
        finally:
            beside.unlink(missing_ok=True)

    @suggests
    def add(
        self,
        ranges: ArrayLike,
        angle_min: float,
        angle_increment: float,
        odometry: tuple[float, float, float] | ArrayLike | None = None,
    ) -> Pose:
        """Add a scan.

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
        Pose
            Pose of the laser in the map so far; loops are closed by `build` alone. `quality` says
            how it was found.

        Raises
        ------
        InvalidLog
            Another number of beams than before, or values that make no scan.
        """
        pose, _ = self._core.add(
            ranges_of(ranges, 1),
            angles_of(angle_min, angle_increment),
            odometry_of(odometry),
        )
        return pose

    @suggests
    def add_log(self, log: Log, *, start: tuple[float, float, float] | None = None) -> None:
        """Add the scans of a log, as ``map build`` does.

        A log that was added in part is continued. Another log continues the map: at `start`, a pose
        of the laser in the map, or where its first scans are found.

        Raises
        ------
        InvalidLog
            Scans that are found nowhere in the map, or of another number of beams.
        """
        self._core.add_log(
            log._core, None if start is None else pose_of(start, "start", InvalidLog)
        )

    def start_drive(self, start: tuple[float, float, float]) -> None:
        """End the drive: the next scan is taken at `start`, a pose of the laser in the map."""
        self._core.start_drive(pose_of(start, "start", InvalidLog))

    @property
    def pose(self) -> Pose:
        """Pose of the laser at the last scan, before loops are closed."""
        return self._core.state()[0]

    @property
    def quality(self) -> str:
        """How the last scan was matched.

        ``first``, ``ok``, ``widened`` (in a wider window), ``lost`` (its pose is the expected one)
        or ``degenerate`` (it tells nothing); empty before the first scan.
        """
        return self._core.state()[1]

    @property
    def n_scans(self) -> int:
        """Number of scans."""
        return self._core.state()[2]

    @property
    def n_key_scans(self) -> int:
        """Number of scans of which the map is made."""
        return self._core.state()[3]

    @property
    def config(self) -> dict[str, Any]:
        """Every parameter."""
        return dict(self._core.config())

    def build(self) -> BuiltMap:
        """Close loops, refine and draw the map. Further scans may follow.

        Raises
        ------
        InvalidLog
            No scans, or a map with too many cells.
        """
        return BuiltMap._of(self._core.finish())

    def __repr__(self) -> str:
        return f"Mapper({self.n_scans} scans, {self.n_key_scans} of them key scans)"


@suggests
def build_map(
    log: Log,
    *,
    resolution: float | None = None,
    min_range: float | None = None,
    max_range: float | None = None,
    no_return: float | None = None,
    preset: Literal["formicar", "fossel2015"] = "formicar",
    config: Mapping[str, Any] | None = None,
) -> BuiltMap:
    """Build a map of a log, the same as ``formicar map build`` bit for bit.

    The lock of the interpreter is released meanwhile; Ctrl-C ends it.

    Parameters
    ----------
    log : Log
        Scans and odometry.
    resolution, min_range, max_range, no_return, preset, config
        As in `Mapper`.

    Returns
    -------
    BuiltMap
        Map, trajectory and report.

    Raises
    ------
    InvalidLog
        A map with too many cells.
    ConfigError
        A parameter that does not exist or is out of its range.
    """
    mapper = Mapper(
        resolution=resolution,
        min_range=min_range,
        max_range=max_range,
        no_return=no_return,
        preset=preset,
        config=config,
    )
    mapper.add_log(log)
    return mapper.build()


def changes_of(
    config: Mapping[str, Any] | None,
    resolution: float | None,
    min_range: float | None,
    max_range: float | None,
    no_return: float | None,
) -> dict[str, Any]:
    """Return the parameters that differ from the preset, nested."""
    changes: dict[str, Any] = dict(config or {})
    if resolution is not None:
        changes["resolution_m"] = number_of(resolution, "resolution", " of meters", ConfigError)
    limits = {"min_m": min_range, "max_m": max_range, "no_return_m": no_return}
    given = {
        key: number_of(value, key, " of meters", ConfigError)
        for key, value in limits.items()
        if value is not None
    }
    if given:
        changes["ranges"] = {**changes.get("ranges", {}), **given}
    return changes
