"""Vehicles."""

from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _formicar
from ._arrays import frozen
from ._formicar import InvalidVehicle
from ._hints import nearest
from ._lazy import np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class Vehicle:
    """A car: its body around the rear axle, and how far it steers.

    Parameters
    ----------
    **measures : float or array_like
        Five lengths give a rectangle: ``wheelbase_m``, ``width_m``, ``front_overhang_m``,
        ``rear_overhang_m`` in meters (overhangs may be negative), and one of ``max_steer_rad``,
        ``max_steer_deg`` and ``min_turning_radius_m``. ``footprint``, shape (n, 2) in meters around
        the rear axle, gives any convex polygon instead. Optional: ``track_width_m``,
        ``safety_margin_m``, ``max_steer_rate_rad_per_s``, ``speed_mps``, ``max_acceleration_mps2``.

    Raises
    ------
    InvalidVehicle
        Measures that are missing, unknown, out of range, or contradict each other.

    Examples
    --------
    >>> van = Vehicle(wheelbase_m=3.0, width_m=2.0, front_overhang_m=0.9, rear_overhang_m=1.1,
    ...               min_turning_radius_m=6.0)
    >>> van
    Vehicle(5 x 2 m, wheelbase 3 m, turning radius 6 m)
    >>> van.footprint.shape
    (4, 2)
    """

    _core: _formicar.Car

    def __init__(self, **measures: Any) -> None:
        known = _formicar.vehicle_keys()
        for word in measures:
            if word not in known:
                raise InvalidVehicle(
                    f"vehicle has no measure {word!r}; there are {', '.join(known)}"
                    + nearest(word, known)
                )
        self._core = _formicar.Car.of_measures(measures)

    @classmethod
    def _of(cls, core: _formicar.Car) -> Vehicle:
        vehicle = cls.__new__(cls)
        vehicle._core = core
        return vehicle

    @classmethod
    def preset(cls, name: str) -> Vehicle:
        """Return a built-in vehicle.

        Parameters
        ----------
        name : str
            One of `presets`: ``"warehouse_amr"``, ``"sedan"``, ...

        Examples
        --------
        >>> Vehicle.preset("warehouse_amr").min_turning_radius  # doctest: +ELLIPSIS
        0.774...
        """
        return cls._of(_formicar.Car.preset(name))

    @staticmethod
    def presets() -> list[str]:
        """Return the names of the built-in vehicles."""
        return _formicar.Car.presets()

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Vehicle:
        """Read a vehicle file, TOML or JSON, with the measures as keys.

        Raises
        ------
        FileNotFoundError
            No such file.
        InvalidVehicle
            A file that is no vehicle.
        """
        return cls._of(_formicar.Car.load(os.fspath(path)))

    def with_margin(self, safety_margin_m: float) -> Vehicle:
        """Return the vehicle with another safety margin around its body, meters."""
        return self._of(self._core.with_margin(safety_margin_m))

    @cached_property
    def footprint(self) -> NDArray[np.float64]:
        """The body with its safety margin, shape (n, 2), meters around the rear axle; read-only."""
        return frozen(np.array(self._core.footprint, dtype=np.float64).reshape(-1, 2))

    @property
    def name(self) -> str:
        """Preset or file."""
        return self._core.name

    @property
    def is_point(self) -> bool:
        """True for a holonomic point, which has no measures."""
        return self._core.is_point

    @property
    def length(self) -> float:
        """Length of the body with its margin, meters."""
        return self._core.length_m

    @property
    def width(self) -> float:
        """Width of the body with its margin, meters."""
        return self._core.width_m

    @property
    def wheelbase(self) -> float | None:
        """Distance between the axles, meters; ``None`` where it is not known."""
        return self._core.wheelbase_m

    @property
    def min_turning_radius(self) -> float:
        """Smallest turning radius of the rear axle's center, meters; 0 for a point."""
        return self._core.min_turning_radius_m

    @property
    def max_curvature(self) -> float:
        """Largest curvature of the rear axle's path, 1/m; infinite for a point."""
        return self._core.max_curvature_per_m

    @property
    def max_steer(self) -> float | None:
        """Largest angle of the virtual middle wheel, radians; ``None`` without a wheelbase."""
        return self._core.max_steer_rad

    @property
    def measures(self) -> dict[str, Any]:
        """The measures that were given, as in a vehicle file."""
        return dict(self._core.measures())

    def plot(
        self, pose: tuple[float, float, float] = (0.0, 0.0, 0.0), ax: Axes | None = None
    ) -> Axes:
        """Draw the body at a pose with matplotlib, and return the axes."""
        from ._draw import draw_vehicle

        return draw_vehicle(self, pose, ax)

    def __repr__(self) -> str:
        if self.is_point:
            return "Vehicle(point)"
        parts = [f"{self.length:.3g} x {self.width:.3g} m"]
        if self.wheelbase is not None:
            parts.append(f"wheelbase {self.wheelbase:.3g} m")
        parts.append(f"turning radius {self.min_turning_radius:.3g} m")
        margin = self.measures.get("safety_margin_m")
        if margin:
            parts.append(f"margin {margin:.3g} m")
        return f"Vehicle({', '.join(parts)})"

    def _repr_svg_(self) -> str:
        return _formicar.vehicle_svg(self._core, repr(self))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Vehicle):
            return NotImplemented
        return self._core.same_as(other._core)

    def __hash__(self) -> int:
        return hash(self._core.hash)

    def __copy__(self) -> Vehicle:
        return self

    def __deepcopy__(self, memo: object) -> Vehicle:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return (_vehicle_of_state, (self._core.state(),))


def _vehicle_of_state(state: str) -> Vehicle:
    return Vehicle._of(_formicar.Car.of_state(state))
