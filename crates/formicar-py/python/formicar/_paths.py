"""Paths of any origin: judged and measured."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _formicar
from ._arrays import rows_of
from ._hints import suggests
from ._map import OccupancyGrid
from ._plan import Plan
from ._planner import scene_of
from ._records import Certificate, Metrics, certificate_of, record_of
from ._vehicle import Vehicle

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Check(NamedTuple):
    """The judge's word on a path: true where the vehicle can drive it.

    Attributes
    ----------
    certificate : Certificate
        The findings.
    length_m : float
        Length of the path that was judged, meters.
    n_segments : int
        Number of its segments.
    source : {"segments", "poses", "points"}
        The segments of a plan, or samples with or without headings, whose arcs and gears were
        reconstructed.
    curvature_slack : float
        Share by which the curvature may exceed the vehicle's limit: 0.05 for samples, which do not
        tell the curvature between them exactly.
    first_gear : int
        The gear in which the path begins: 1 forward, -1 in reverse.
    """

    certificate: Certificate
    length_m: float
    n_segments: int
    source: Literal["segments", "poses", "points"]
    curvature_slack: float
    first_gear: int

    def __bool__(self) -> bool:
        return self.certificate.valid

    @property
    def valid(self) -> bool:
        """True where the vehicle can drive the path."""
        return self.certificate.valid

    def __repr__(self) -> str:
        found = self.certificate
        if found.valid:
            return (
                f"Check(valid, {self.length_m:.2f} m, clearance {found.min_clearance_m:.2f} m at "
                f"{found.tightest_s_m:.2f} m)"
            )
        first, n = found.violations[0].message, len(found.violations)
        more = f" and {n - 1} more" if n > 1 else ""
        return f"Check(invalid: {first}{more})"


@suggests
def check(
    path: Plan | ArrayLike,
    map: OccupancyGrid | str | None = None,
    vehicle: Vehicle | str | None = None,
) -> Check:
    """Judge a path: the exact swept area of the body, the curvature, the joints.

    Parameters
    ----------
    path : Plan or array_like, shape (n, 2) or (n, 3)
        A plan, whose segments and request are judged, or samples of a path from anywhere: rows
        ``x, y`` or ``x, y, heading`` of the rear axle, meters and radians. The curve between
        samples is read as arcs, the gears from the headings; points without headings begin forward,
        or in reverse where that alone is valid.
    map : OccupancyGrid or str, optional
        The map, or the name of a built-in one; by default that of the plan.
    vehicle : Vehicle or str, optional
        The vehicle, or the name of a preset; by default that of the plan.

    Returns
    -------
    Check
        True where the vehicle can drive the path.

    Raises
    ------
    InvalidPath
        Another shape, no rows, or numbers that are not finite.

    Examples
    --------
    >>> import numpy as np
    >>> walls = np.zeros((40, 100), dtype=bool)
    >>> walls[18:22, 60] = True
    >>> hall = OccupancyGrid(walls, resolution=0.1)
    >>> xy = np.column_stack((np.linspace(1.0, 8.0, 50), np.full(50, 2.0)))
    >>> judged = check(xy, hall, "warehouse_amr")
    >>> bool(judged), judged.certificate.violations[0].kind
    (False, 'collision')
    >>> bool(check(xy + [0.0, 1.0], hall, "warehouse_amr"))
    True
    """
    track, grid, car, source = track_of(path, map, vehicle)
    document, slack, gear, _ = track.judged(grid._core, car._core)
    return Check(
        certificate=certificate_of(document),
        length_m=track.length_m,
        n_segments=len(track.segments()),
        source=source,
        curvature_slack=slack,
        first_gear=gear,
    )


@suggests
def metrics(
    path: Plan | ArrayLike,
    map: OccupancyGrid | str | None = None,
    vehicle: Vehicle | str | None = None,
) -> Metrics:
    """Measure a path, exactly and as other tools do.

    Parameters
    ----------
    path : Plan or array_like, shape (n, 2) or (n, 3)
        As in `check`.
    map : OccupancyGrid or str, optional
        The map; without one, of samples, clearances and the metrics of other tools are ``None``.
    vehicle : Vehicle or str, optional
        The vehicle; without one, ``"warehouse_amr"``. Without a map it decides on the steering
        angle and the travel time alone.

    Returns
    -------
    Metrics
        The metrics.

    Examples
    --------
    >>> import numpy as np
    >>> turn = np.linspace(0.0, np.pi / 2, 30)
    >>> quarter = np.column_stack((5 * np.sin(turn), 5 - 5 * np.cos(turn), turn))
    >>> measured = metrics(quarter)
    >>> round(measured.length_m, 6), round(measured.max_curvature_per_m, 6)
    (7.853982, 0.2)
    """
    if map is None and not isinstance(path, Plan):
        car = (
            vehicle if isinstance(vehicle, Vehicle) else Vehicle.preset(vehicle or "warehouse_amr")
        )
        track, _ = _track_of_samples(path, car)
        exact, compatible = track.metrics(car._core, None)
    else:
        track, grid, car, _ = track_of(path, map, vehicle)
        exact, compatible = track.metrics(car._core, grid._core)
    return record_of(Metrics, {**exact, "compatible": compatible})


Source = Literal["segments", "poses", "points"]


def track_of(
    path: Plan | ArrayLike, map: OccupancyGrid | str | None, vehicle: Vehicle | str | None
) -> tuple[_formicar.Track, OccupancyGrid, Vehicle, Source]:
    """Return a path as the compiled part takes it, with its map and vehicle."""
    if isinstance(path, Plan):
        grid, car = scene_of(path.map if map is None else map, vehicle or path.vehicle)
        return _formicar.Track.of_plan(path._core), grid, car, "segments"
    if map is None:
        raise TypeError("map is missing; hint: only a plan brings its own")
    grid, car = scene_of(map, vehicle)
    track, source = _track_of_samples(path, car)
    return track, grid, car, source


def _track_of_samples(path: Any, car: Vehicle) -> tuple[_formicar.Track, Source]:
    rows = rows_of(path, "path", (2, 3))
    track = _formicar.Track.of_array(rows, car.is_point)
    return track, "poses" if rows.shape[1] == 3 else "points"
