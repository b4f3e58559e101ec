"""Drives in time: the speed along a certified path, with and without moving obstacles."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from . import _formicar
from ._arrays import frozen, plain, table_of
from ._formicar import InvalidPath
from ._hints import suggests
from ._lazy import np
from ._map import OccupancyGrid
from ._moving import Predictions, predictions_of, times_of
from ._paths import track_of
from ._plan import Plan
from ._records import TimedCertificate, timed_certificate_of
from ._track import IN_TIME, Tracking, settings_of
from ._vehicle import Vehicle

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_LIMITS = (
    "max_speed_mps",
    "max_acceleration_mps2",
    "max_braking_mps2",
    "max_lateral_mps2",
    "max_steer_rate_rad_per_s",
    "max_jerk_mps3",
)
_PROFILE = {
    "t": "t_s",
    "s": "s_m",
    "speed": "speed_mps",
    "acceleration": "acceleration_mps2",
    "jerk": "jerk_mps3",
    "duration": "duration_s",
}


class MotionPlan:
    """A path with the time at which each of its places is reached: true where it is driven.

    Made by `plan_motion`. Plans of motion can be pickled.
    """

    _core: _formicar.Motion

    def __init__(self) -> None:
        raise TypeError("plans of motion are made by plan_motion")

    @classmethod
    def _of(cls, core: _formicar.Motion) -> MotionPlan:
        motion = cls.__new__(cls)
        motion._core = core
        return motion

    def __bool__(self) -> bool:
        return self._core.status is not None

    @property
    def status(self) -> str:
        """``arrives``, ``waits`` before an obstacle that stays in the way, or ``not_driven``."""
        return self._core.status or "not_driven"

    @property
    def reason(self) -> str | None:
        """Why the path is not driven, as a sentence; ``None`` where it is."""
        return self._core.reason

    @cached_property
    def certificate(self) -> TimedCertificate | None:
        """The judge's proof of limits and distance; ``None`` where the path is not driven."""
        document = self._core.member("certificate")
        return timed_certificate_of(document) if document else None

    @cached_property
    def _profile(self) -> dict[str, Any]:
        return dict(self._core.member("profile") or {})

    @property
    def duration_s(self) -> float | None:
        """Time of the drive, seconds; ``None`` where there is none."""
        return self._profile.get("duration_s")

    @property
    def lost_s(self) -> float:
        """Time that obstacles cost, seconds; infinite where the drive does not arrive."""
        if self.status != "arrives":
            return float("inf")
        lost: float = self._profile["duration_s"] - self._profile["unhindered_s"]
        return lost

    @property
    def config(self) -> dict[str, Any]:
        """Limits, present speed, distance and time step, with what the vehicle added."""
        return dict(self._core.member("config"))

    @property
    def predictions(self) -> Predictions:
        """The moving obstacles that it was planned with."""
        return Predictions._of(self._core.moving())

    @cached_property
    def map(self) -> OccupancyGrid:
        """The map on which the path is certified."""
        return OccupancyGrid._of(self._core.grid())

    @cached_property
    def vehicle(self) -> Vehicle:
        """The vehicle."""
        return Vehicle._of(self._core.car())

    @cached_property
    def poses(self) -> NDArray[np.void]:
        """Poses at most 0.1 m apart in order of time; empty where the path is not driven.

        A read-only structured array with the fields ``t`` (s), ``s`` (arc length, m), ``x``, ``y``
        (m), ``heading`` (rad), ``direction`` (1 or -1), ``speed`` (m/s, at least 0 in both gears),
        ``acceleration`` (m/s² along the path), ``curvature`` (1/m), ``steer`` (rad) and
        ``steer_rate`` (rad/s; both NaN where the wheelbase is not known), ``clearance`` (m, from
        the map). Where the vehicle stands on the way, a pose is listed as it is reached and again
        as it is left.
        """
        return frozen(table_of(self._core.columns(), {"direction": "i1"}))

    @cached_property
    def profile(self) -> NDArray[np.void]:
        """The speed exactly: phases of constant jerk, which mostly is 0; read-only.

        A structured array with the fields ``t`` (s), ``s`` (m), ``speed`` (m/s), ``acceleration``
        (m/s²) at each phase's beginning, its ``jerk`` (m/s³) and ``duration`` (s).
        """
        return _table(self._profile.get("phases", ()), _PROFILE)

    @cached_property
    def stops(self) -> NDArray[np.void]:
        """Places where the vehicle stands: ``s`` (m), ``t`` and ``duration`` (s); read-only."""
        keys = {"s": "s_m", "t": "t_s", "duration": "duration_s"}
        return _table(self._profile.get("stops", ()), keys)

    @cached_property
    def regions(self) -> NDArray[np.void]:
        """Stretches of the path that obstacles close for a while; read-only.

        A structured array with the fields ``obstacle`` (its place in the predictions),
        ``from_t``, ``to_t`` (s; the last slab of time has no end), ``from_s`` and ``to_s`` (m).
        Empty where the path is not driven.
        """
        kinds = [("obstacle", "i4"), *((name, "f8") for name in _REGION)]
        return frozen(np.array(self._core.regions(), dtype=kinds))

    def at(self, t_s: ArrayLike) -> NDArray[np.void]:
        """Return the motion at given times.

        Parameters
        ----------
        t_s : array_like, shape (n,)
            Times, seconds. Before 0 the vehicle is where it begins; after the end it stands.

        Returns
        -------
        ndarray of void, shape (n,)
            Fields ``t``, ``s``, ``x``, ``y``, ``heading``, ``speed``, ``acceleration``; read-only.

        Raises
        ------
        InvalidPath
            A path that is not driven.
        """
        return frozen(table_of(self._core.at(times_of(t_s)), {}))

    @suggests
    def judge(
        self,
        predictions: Predictions | None = None,
        profile: ArrayLike | None = None,
        *,
        max_speed_mps: float | None = None,
        max_acceleration_mps2: float | None = None,
        max_braking_mps2: float | None = None,
        max_lateral_mps2: float | None = None,
        max_steer_rate_rad_per_s: float | None = None,
        max_jerk_mps3: float | None = None,
        present_speed_mps: float | None = None,
        distance_m: float | None = None,
    ) -> TimedCertificate:
        """Judge the drive again, against other obstacles, other limits or with another profile.

        Parameters
        ----------
        predictions : Predictions, optional
            Moving obstacles; by default those of the plan.
        profile : array_like, optional
            A profile from anywhere along the same path: a structured array with the fields of
            `profile`, or rows ``t, s, speed, acceleration, jerk, duration``, shape (n, 6).
        max_speed_mps, max_acceleration_mps2, max_braking_mps2, max_lateral_mps2 : float, optional
            As in `plan_motion`; by default those of the plan.
        max_steer_rate_rad_per_s, max_jerk_mps3, present_speed_mps, distance_m : float, optional
            Likewise.

        Returns
        -------
        TimedCertificate
            True where limits and distance are kept; otherwise its ``violations`` have place and
            time.

        Raises
        ------
        InvalidPath
            A path that is not driven, without a profile to judge; or a profile of another shape.
        """
        given = {
            "max_speed_mps": max_speed_mps,
            "max_acceleration_mps2": max_acceleration_mps2,
            "max_braking_mps2": max_braking_mps2,
            "max_lateral_mps2": max_lateral_mps2,
            "max_steer_rate_rad_per_s": max_steer_rate_rad_per_s,
            "max_jerk_mps3": max_jerk_mps3,
            "present_speed_mps": present_speed_mps,
            "distance_m": distance_m,
        }
        own = self.config
        limits, settings = _split({**own.pop("limits"), **own, **_known(given)})
        core = predictions_of(self.predictions if predictions is None else predictions)
        rows = None if profile is None else _rows_of(profile)
        return timed_certificate_of(self._core.judged(core, limits, settings, rows))

    def to_dict(self) -> dict[str, Any]:
        """Return the part ``motion`` of an answer, as the command line writes it."""
        import json

        return dict(json.loads(self._core.to_json()))

    def __repr__(self) -> str:
        if not self:
            return f"MotionPlan(not driven: {self.reason})"
        found = self.certificate
        assert found is not None
        nearest = "" if found.min_distance_m is None else f", distance {found.min_distance_m:.2f} m"
        return f"MotionPlan({self.status}, {found.duration_s:.1f} s{nearest})"

    def __reduce__(self) -> tuple[Any, ...]:
        path, record, regions, grid, car = self._core.state()
        state = (path, record, regions, OccupancyGrid._of(grid), Vehicle._of(car))
        return (_motion_of_state, state)


_REGION = ("from_t", "to_t", "from_s", "to_s")


def _motion_of_state(
    path: str,
    record: str,
    regions: list[tuple[int, float, float, float, float]],
    map: OccupancyGrid,
    vehicle: Vehicle,
) -> MotionPlan:
    core = _formicar.Motion.of_state(path, record, regions, map._core, vehicle._core)
    return MotionPlan._of(core)


def _table(records: Any, keys: dict[str, str]) -> NDArray[np.void]:
    columns = {
        name: np.array([record.get(key, 0.0) for record in records], dtype=np.float64)
        for name, key in keys.items()
    }
    return frozen(table_of(columns, {}))


def _rows_of(profile: ArrayLike) -> list[list[float]]:
    array = plain(profile, "profile")
    names = array.dtype.names
    if names:
        missing = [name for name in _PROFILE if name not in names]
        if missing:
            raise InvalidPath(f"profile has no field {missing[0]!r}; there are {', '.join(names)}")
        array = np.column_stack([array[name] for name in _PROFILE])
    if array.ndim != 2 or array.shape[1] != len(_PROFILE) or array.dtype.kind not in "iuf":
        raise InvalidPath(
            f"profile has shape {array.shape} of {array.dtype}; expected (n, 6) numbers: "
            + ", ".join(_PROFILE)
        )
    rows: list[list[float]] = array.astype(np.float64).tolist()
    return rows


def _known(given: dict[str, Any]) -> dict[str, Any]:
    return {word: value for word, value in given.items() if value is not None}


def _split(given: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    limits = {word: value for word, value in given.items() if word in _LIMITS}
    return limits, {word: value for word, value in given.items() if word not in _LIMITS}


@suggests
def plan_motion(
    path: Plan | ArrayLike,
    predictions: Predictions | None = None,
    map: OccupancyGrid | str | None = None,
    vehicle: Vehicle | str | None = None,
    *,
    max_speed_mps: float | None = None,
    max_acceleration_mps2: float | None = None,
    max_braking_mps2: float | None = None,
    max_lateral_mps2: float | None = None,
    max_steer_rate_rad_per_s: float | None = None,
    max_jerk_mps3: float | None = None,
    present_speed_mps: float | None = None,
    distance_m: float | None = None,
    time_step_s: float | None = None,
) -> MotionPlan:
    """Plan the speed along a certified path, and when to wait for what moves.

    Parameters
    ----------
    path : Plan or array_like, shape (n, 2) or (n, 3)
        As in `check`; the judge must find nothing wrong with it.
    predictions : Predictions, optional
        Moving obstacles; without any, the result is the fastest drive.
    map, vehicle : optional
        As in `check`.
    max_speed_mps : float, optional
        Top speed in both gears, m/s; by default that of the vehicle, or 1.
    max_acceleration_mps2 : float, optional
        Largest acceleration, m/s²; by default that of the vehicle, or 1.
    max_braking_mps2 : float, optional
        Largest deceleration, m/s²; by default the acceleration.
    max_lateral_mps2 : float, optional
        Largest lateral acceleration, m/s²; by default 2.
    max_steer_rate_rad_per_s : float, optional
        Fastest change of the steering angle, rad/s; by default that of the vehicle.
    max_jerk_mps3 : float, optional
        Fastest change of the acceleration, m/s³; by default unbounded.
    present_speed_mps : float, optional
        Speed at the beginning of the path, m/s; by default 0.
    distance_m : float, optional
        Least distance from every moving obstacle, meters; by default 0.1.
    time_step_s : float, optional
        Time for which the acceleration is held where something is in the way, seconds; by default
        0.2.

    Returns
    -------
    MotionPlan
        True with a drive that the judge has certified, also one that ``waits`` before an obstacle
        that stays in the way; false with the reason where the distance cannot be kept.

    Raises
    ------
    InvalidPath
        A plan without a path, or a path that the judge refuses.
    InvalidRequest
        An obstacle that begins off the map or inside the vehicle.
    ConfigError
        A parameter out of its range, or a present speed that is too fast for the path.

    Examples
    --------
    >>> import numpy as np
    >>> from formicar import MovingObstacle, OccupancyGrid, Predictions, plan_motion
    >>> hall = OccupancyGrid(np.zeros((80, 120), dtype=bool), resolution=0.1)
    >>> xy = np.column_stack((np.linspace(1.5, 10.5, 50), np.full(50, 4.0)))
    >>> walker = MovingObstacle(radius_m=0.3, pose=(6, 7.5, 0), velocity_mps=(0, -0.8))
    >>> motion = plan_motion(xy, Predictions([walker], 30), hall, "warehouse_amr")
    >>> motion.status, motion.certificate.min_distance_m > 0.1, motion.lost_s >= 0
    ('arrives', True, True)
    >>> motion.poses.dtype.names[:7]
    ('t', 's', 'x', 'y', 'heading', 'direction', 'speed')
    """
    given = {
        "max_speed_mps": max_speed_mps,
        "max_acceleration_mps2": max_acceleration_mps2,
        "max_braking_mps2": max_braking_mps2,
        "max_lateral_mps2": max_lateral_mps2,
        "max_steer_rate_rad_per_s": max_steer_rate_rad_per_s,
        "max_jerk_mps3": max_jerk_mps3,
        "present_speed_mps": present_speed_mps,
        "distance_m": distance_m,
        "time_step_s": time_step_s,
    }
    # Where nothing moves, any horizon serves.
    moving = predictions_of(Predictions([], 1.0) if predictions is None else predictions)
    track, grid, car, _ = track_of(path, map, vehicle)
    limits, settings = _split(_known(given))
    scene = (grid._core, car._core)
    return MotionPlan._of(_formicar.Motion(track, scene, moving, limits, settings))


def track_in_time(
    motion: MotionPlan,
    *,
    controller: Literal[
        "regulated-pure-pursuit", "mpc", "stanley", "pure-pursuit", "open-loop"
    ] = "regulated-pure-pursuit",
    **settings: Any,
) -> Tracking:
    """Drive a vehicle along a path in time, in simulation.

    Commands take effect late, and wheels and speed change no faster than the actuators can.

    Parameters
    ----------
    motion : MotionPlan
        The path with its times.
    controller : str, optional
        What steers and drives: ``regulated-pure-pursuit``, ``mpc`` (model-predictive), or
        ``stanley``, ``pure-pursuit`` and ``open-loop`` at the planned speed.
    **settings
        Actuators: ``delay_s``, ``max_acceleration_mps2``, ``max_braking_mps2``,
        ``control_period_s``, ``max_steer_rate_rad_per_s``. The drive: ``record_interval_s``,
        ``give_up_error_m`` and ``start_offset``, as in `track`. Parameters of the controller by
        their names, such as ``lookahead_time_s`` or ``n_steps``.

    Returns
    -------
    Tracking
        True where the vehicle arrived and touched nothing on the map. Its trace has a field
        ``speed`` (m/s, negative in reverse).

    Raises
    ------
    InvalidPath
        A path that is not driven.
    ConfigError
        A setting that does not exist or lies outside its range.

    Examples
    --------
    >>> import formicar
    >>> planner = formicar.Planner("parking-lot")
    >>> motion = formicar.plan_motion(planner.plan(*planner.map.requests["back-in"]))
    >>> drive = formicar.track_in_time(motion, delay_s=0.05)
    >>> bool(drive), "speed" in drive.trace.dtype.names
    (True, True)
    """
    table = settings_of("track_in_time", (controller, settings), IN_TIME)
    return Tracking._of(_formicar.Drive.in_time(motion._core, table))
