"""Driving a path in simulation."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _formicar
from ._arrays import frozen, table_of
from ._formicar import ConfigError
from ._hints import nearest
from ._map import OccupancyGrid
from ._paths import track_of
from ._plan import Plan
from ._vehicle import Vehicle

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

_SETTINGS = (
    "give_up_error_m",
    "give_up_length_ratio",
    "max_steer_rate_rad_per_s",
    "record_interval_s",
    "speed_mps",
    "start_offset",
    "time_step_s",
)
_OF_LAW: dict[str, tuple[str, ...]] = {
    "open-loop": (),
    "pure-pursuit": ("lookahead_m",),
    "stanley": ("gain_per_s", "softening_mps"),
}
_ACTUATORS = ("control_period_s", "delay_s", "max_acceleration_mps2", "max_braking_mps2")


class Laws(NamedTuple):
    """The settings of a simulation, and the parameters of each of its controllers."""

    settings: tuple[str, ...]
    of_law: dict[str, tuple[str, ...]]


_AT_ONE_SPEED = Laws(_SETTINGS, _OF_LAW)
IN_TIME = Laws(
    (
        *_ACTUATORS,
        "give_up_error_m",
        "max_steer_rate_rad_per_s",
        "record_interval_s",
        "start_offset",
    ),
    {
        **_OF_LAW,
        "regulated-pure-pursuit": (
            "approach_m",
            "lookahead_time_s",
            "max_lookahead_m",
            "min_lookahead_m",
            "min_speed_mps",
            "slow_clearance_m",
            "slow_radius_m",
        ),
        "mpc": (
            "acceleration_weight",
            "across_weight",
            "along_weight",
            "heading_weight",
            "n_steps",
            "speed_weight",
            "steer_rate_weight",
            "steer_weight",
            "step_s",
        ),
    },
)


class Tracking:
    """A simulated drive: true where the vehicle arrived and touched nothing.

    Made by `track` and `track_in_time`.
    """

    _core: _formicar.Drive

    def __init__(self) -> None:
        raise TypeError("drives are made by track")

    @classmethod
    def _of(cls, core: _formicar.Drive) -> Tracking:
        drive = cls.__new__(cls)
        drive._core = core
        return drive

    @cached_property
    def _document(self) -> dict[str, Any]:
        return dict(self._core.document())

    def __bool__(self) -> bool:
        return bool(self._document["tracked"])

    @property
    def status(self) -> str:
        """How the drive ended: ``arrived``, or why the vehicle did not."""
        return str(self._document["status"])

    @property
    def summary(self) -> dict[str, float]:
        """The drive in numbers.

        ``duration_s``, ``driven_m``, ``max_cross_track_error_m``, ``rms_cross_track_error_m``,
        ``goal_error_m``, ``max_steer_rad``, ``swept_area_m2`` and others; the unit ends each name.
        """
        return dict(self._document["summary"])

    @property
    def clearance(self) -> dict[str, Any]:
        """Exact clearance of the driven path: ``min_clearance_m``, its place, and any contact."""
        return dict(self._document["clearance"])

    @property
    def config(self) -> dict[str, Any]:
        """Every parameter, with what the vehicle added."""
        return dict(self._document["config"])

    @cached_property
    def trace(self) -> NDArray[np.void]:
        """The vehicle over time, a structured array; read-only.

        Fields: ``t`` (s), ``x``, ``y`` (m), ``heading`` (rad), ``driven`` and ``s`` (m, along the
        drive and the path), ``direction`` (1 or -1), ``steer``, ``left_wheel``, ``right_wheel``
        (rad), ``cross_track_error`` (m, positive left), ``heading_error`` (rad); of a drive in
        time also ``speed`` (m/s, negative in reverse).
        """
        return frozen(table_of(self._core.columns(), {"direction": "i1"}))

    def to_csv(self) -> str:
        """Return the trace as CSV, as the command line writes it."""
        return self._core.to_csv()

    def to_svg(self) -> str:
        """Return a picture of the drive."""
        return self._core.svg(self.status, self._caption())

    def _caption(self) -> str:
        summary = self.summary
        return (
            f"{summary['driven_m']:.2f} m in {summary['duration_s']:.1f} s, "
            f"{summary['max_cross_track_error_m']:.3f} m beside the path at most"
        )

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def __repr__(self) -> str:
        return f"Tracking({self.status}, {self._caption()})"


def track(
    path: Plan | ArrayLike,
    map: OccupancyGrid | str | None = None,
    vehicle: Vehicle | str | None = None,
    *,
    controller: Literal["stanley", "pure-pursuit", "open-loop"] = "stanley",
    **settings: Any,
) -> Tracking:
    """Drive a vehicle along a path in simulation.

    Parameters
    ----------
    path : Plan or array_like, shape (n, 2) or (n, 3)
        As in `check`.
    map, vehicle : optional
        As in `check`.
    controller : {"stanley", "pure-pursuit", "open-loop"}, optional
        What turns the wheels.
    **settings
        ``gain_per_s`` and ``softening_mps`` of ``stanley``, ``lookahead_m`` of ``pure-pursuit``;
        ``speed_mps``, ``max_steer_rate_rad_per_s``, ``time_step_s``, ``record_interval_s``,
        ``give_up_error_m``, ``give_up_length_ratio``, and ``start_offset`` as
        ``{"lateral_m": ..., "heading_rad": ..., "along_m": ...}``.

    Returns
    -------
    Tracking
        True where the vehicle arrived and touched nothing.

    Raises
    ------
    ConfigError
        A setting that does not exist or lies outside its range.
    InvalidVehicle
        A point, or a vehicle whose wheelbase is not known.

    Examples
    --------
    >>> import formicar
    >>> planner = formicar.Planner("lei-map1")
    >>> plan = planner.plan(*next(iter(planner.map.requests.values())))
    >>> drive = formicar.track(plan, speed_mps=0.25)
    >>> bool(drive), drive.trace.dtype.names[:4]
    (True, ('t', 'x', 'y', 'heading'))
    """
    table = settings_of("track", (controller, settings), _AT_ONE_SPEED)
    driven, grid, car, _ = track_of(path, map, vehicle)
    return Tracking._of(_formicar.Drive(driven, grid._core, car._core, table))


def settings_of(function: str, given: tuple[str, dict[str, Any]], laws: Laws) -> dict[str, Any]:
    """Return controller and settings as the compiled part takes them.

    Raises
    ------
    ConfigError
        A controller or a setting that does not exist.
    """
    controller, settings = given
    if controller not in laws.of_law:
        raise ConfigError(f"controller = {controller!r}; there are {', '.join(laws.of_law)}")
    own = laws.of_law[controller]
    known = (*laws.settings, *own)
    for word in settings:
        if word not in known:
            raise ConfigError(_unknown(function, (controller, word), laws))
    table: dict[str, Any] = {"controller": {"law": controller}}
    for word, value in settings.items():
        if word in own:
            table["controller"][word] = value
        elif word in _ACTUATORS:
            table.setdefault("actuators", {})[word] = value
        else:
            table[word] = value
    return table


def _unknown(function: str, given: tuple[str, str], laws: Laws) -> str:
    controller, word = given
    law = next((law for law, words in laws.of_law.items() if word in words), None)
    if law:
        return f"{word}: {controller} has no such parameter; hint: controller={law!r}"
    known = (*laws.settings, *laws.of_law[controller])
    return (
        f"{function}() has no setting {word!r}; there are {', '.join(known)}{nearest(word, known)}"
    )
