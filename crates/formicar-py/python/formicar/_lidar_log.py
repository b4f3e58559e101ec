"""Lidar logs, and the arrays of scans."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from . import _formicar
from ._arrays import check_real, frozen, number_of, plain, pose_of
from ._formicar import InvalidLog
from ._hints import suggests
from ._lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Log:
    """The scans of one laser on one robot, in order, with the odometry between them.

    A log is immutable and holds copies of its arrays.

    Parameters
    ----------
    ranges : array_like, shape (n_scans, n_beams)
        Ranges, meters. NaN, infinity, zeros and the sensor's code for "nothing seen" may stand in
        them: they are no hits.
    angle_min : float
        Direction of the first beam, radians counter-clockwise from the laser's x axis.
    angle_increment : float
        Angle from beam to beam, radians, above 0 and at most pi/4.
    odometry : array_like, shape (n_scans, 3), optional
        Pose of the laser by dead reckoning at each scan: x, y in meters, heading in radians, in a
        frame of its own. Without it, the motion comes from the scans alone.
    times : array_like, shape (n_scans,), optional
        Time of each scan, seconds; the numbers of the scans by default.

    Raises
    ------
    InvalidLog
        No scans, arrays of other shapes, angles out of range, odometry that is not finite or jumps
        more than 20 m, times that run back.
    TypeError
        Values that are no real numbers.

    Examples
    --------
    >>> import numpy as np
    >>> log = Log(np.full((5, 180), 2.0), angle_min=-np.pi / 2, angle_increment=np.pi / 180)
    >>> log
    Log(5 scans of 180 beams, no odometry)
    >>> log.times
    array([0., 1., 2., 3., 4.])
    """

    _core: _formicar.LidarLog

    @suggests
    def __init__(
        self,
        ranges: ArrayLike,
        angle_min: float,
        angle_increment: float,
        odometry: ArrayLike | None = None,
        times: ArrayLike | None = None,
    ) -> None:
        scans = ranges_of(ranges, 2)
        if scans.shape[1] == 0:
            raise InvalidLog(f"ranges has shape {scans.shape}; expected at least one beam")
        n_scans = len(scans)
        if times is None:
            times = np.arange(n_scans, dtype=np.float64)
        self._core = _formicar.LidarLog.of_arrays(
            scans,
            angles_of(angle_min, angle_increment),
            numbers_of(times, "times", (n_scans,)),
            None if odometry is None else numbers_of(odometry, "odometry", (n_scans, 3)),
        )

    @classmethod
    def _of(cls, core: _formicar.LidarLog) -> Log:
        log = cls.__new__(cls)
        log._core = core
        return log

    @classmethod
    @suggests
    def read(
        cls,
        path: str | os.PathLike[str],
        *,
        scan_topic: str | None = None,
        odom_topic: str | None = None,
        laser_pose: tuple[float, float, float] | None = None,
        use_odometry: bool = True,
    ) -> Log:
        """Read a log: a bag of ROS 2 in MCAP (``.mcap``, or its folder), or a CARMEN file.

        Parameters
        ----------
        path : path
            The file, or the folder of a bag. CARMEN files may be packed as ``.gz``.
        scan_topic : str, optional
            Topic of the scans, where a bag has several.
        odom_topic : str, optional
            Topic of the odometry, where a bag has several; ``"/tf"`` takes it from the frame
            ``odom``.
        laser_pose : (float, float, float), optional
            Pose of the laser on the robot, meters and radians, in place of the one in the bag's
            transforms.
        use_odometry : bool, optional
            False takes the scans alone: neither odometry nor the pose of the laser is needed then.

        Returns
        -------
        Log
            The log; doubts about the file are in `warnings`.

        Raises
        ------
        InvalidLog
            A file that cannot be read, with the command that converts it where there is one;
            several topics that would do; a laser that is tilted.
        FileNotFoundError
            No such file.
        """
        pose = None if laser_pose is None else pose_of(laser_pose, "laser_pose", InvalidLog)
        return cls._of(
            _formicar.LidarLog.read(
                os.fspath(path), [scan_topic, odom_topic], pose, not use_odometry
            )
        )

    def without_odometry(self) -> Log:
        """Return the log without its odometry."""
        return self._of(self._core.without_odometry())

    def __len__(self) -> int:
        return self._core.shape()[0]

    @property
    def ranges(self) -> NDArray[np.float32]:
        """Ranges in meters, shape (n_scans, n_beams); a copy, read-only."""
        return frozen(self._core.ranges())

    @property
    def angle_min(self) -> float:
        """Direction of the first beam, radians."""
        return self._core.angles()[0]

    @property
    def angle_increment(self) -> float:
        """Angle from beam to beam, radians."""
        return self._core.angles()[1]

    @property
    def times(self) -> NDArray[np.float64]:
        """Time of each scan in seconds, shape (n_scans,); a copy, read-only."""
        return frozen(self._core.times())

    @property
    def odometry(self) -> NDArray[np.float64] | None:
        """Pose of the laser by dead reckoning, shape (n_scans, 3); a copy, read-only."""
        poses = self._core.odometry()
        return None if poses is None else frozen(poses)

    @property
    def reference(self) -> NDArray[np.float64] | None:
        """Pose of the laser as another program gives it, shape (n_scans, 3), where a log has it."""
        poses = self._core.reference()
        return None if poses is None else frozen(poses)

    @property
    def warnings(self) -> list[str]:
        """Doubts about the file, as sentences."""
        return self._core.warnings()

    def __repr__(self) -> str:
        n_scans, n_beams = self._core.shape()
        odometry = "no odometry" if self._core.odometry() is None else "odometry"
        return f"Log({n_scans} scans of {n_beams} beams, {odometry})"


def ranges_of(data: ArrayLike, n_dimensions: int) -> NDArray[np.float32]:
    """Return ranges as float32, whatever they are beyond its limits being infinite."""
    array = plain(data, "ranges")
    check_real(array, "ranges", "iuf")
    if array.ndim != n_dimensions:
        expected = "(n_scans, n_beams)" if n_dimensions == 2 else "(n_beams,)"
        raise InvalidLog(f"ranges has shape {array.shape}; expected {expected}")
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(array, dtype=np.float32)


def numbers_of(data: ArrayLike, name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return finite numbers of a shape as float64."""
    array = plain(data, name)
    check_real(array, name, "iuf")
    if array.shape != shape:
        raise InvalidLog(f"{name} has shape {array.shape}; expected {shape}")
    numbers = np.ascontiguousarray(array, dtype=np.float64)
    bad = np.argwhere(~np.isfinite(numbers))
    if len(bad):
        value = numbers[tuple(bad[0])]
        raise InvalidLog(f"{name} of scan {bad[0][0]} is not finite: {value}")
    return numbers


def odometry_of(value: Any) -> tuple[float, float, float] | None:
    """Return a finite pose where one is given."""
    if value is None:
        return None
    pose = pose_of(value, "odometry", InvalidLog)
    if not np.isfinite(pose).all():
        raise InvalidLog(f"odometry = {value!r}; it must be finite")
    return pose


def angles_of(angle_min: float, angle_increment: float) -> tuple[float, float]:
    """Return the angles of a scan's beams as numbers."""
    return (
        number_of(angle_min, "angle_min", " of radians", InvalidLog),
        number_of(angle_increment, "angle_increment", " of radians", InvalidLog),
    )
