"""Shortest curves of bounded curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from . import _formicar
from ._arrays import frozen, pose_of, rows_of
from ._formicar import InvalidPath
from ._lazy import np
from ._records import Pose

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Self


class Curve:
    """A curve of arcs and lines between two poses; see `Dubins` and `ReedsShepp`.

    Parameters
    ----------
    start, goal : array_like, shape (3,)
        Poses ``(x, y, heading)``, meters and radians.
    radius : float
        Turning radius, meters, above 0.

    Raises
    ------
    InvalidPath
        Numbers that are not finite, or a radius that is not above 0.
    """

    _reverses: ClassVar[bool]
    _core: _formicar.BoundedCurve
    # The arguments, and the place among the candidates; none for the shortest.
    _made_of: tuple[Pose, Pose, float, int | None]

    def __init__(self, start: ArrayLike, goal: ArrayLike, radius: float) -> None:
        if type(self) is Curve:
            raise TypeError("a curve is a Dubins or a ReedsShepp curve")
        ends = (pose_of(start, "start", InvalidPath), pose_of(goal, "goal", InvalidPath))
        core = _formicar.BoundedCurve.shortest(self._reverses, *ends, float(radius))
        if core is None:
            raise InvalidPath("no curve between these poses; hint: coordinates below 1e9 m")
        self._core = core
        self._made_of = (*ends, float(radius), None)

    @classmethod
    def candidates(cls, start: ArrayLike, goal: ArrayLike, radius: float) -> list[Self]:
        """Return the curves of all words that reach the goal, shortest first."""
        ends = (pose_of(start, "start", InvalidPath), pose_of(goal, "goal", InvalidPath))
        found = []
        cores = _formicar.BoundedCurve.candidates(cls._reverses, *ends, float(radius))
        for place, core in enumerate(cores):
            curve = cls.__new__(cls)
            curve._core = core
            curve._made_of = (*ends, float(radius), place)
            found.append(curve)
        return found

    @classmethod
    def distance(
        cls, start: ArrayLike, goal: ArrayLike, radius: float
    ) -> NDArray[np.float64] | float:
        """Return the length of the shortest curve, for many pairs of poses at once.

        Parameters
        ----------
        start, goal : array_like, shape (3,) or (n, 3)
            Poses; one is broadcast against many.
        radius : float
            Turning radius, meters.

        Returns
        -------
        float or ndarray of float64, shape (n,)
            Meters; NaN where a number is not finite.
        """
        pair = np.broadcast_arrays(np.atleast_2d(start), np.atleast_2d(goal))
        rows = [rows_of(poses, "poses", (3,)) for poses in pair]
        lengths = _formicar.curve_lengths(cls._reverses, rows[0], rows[1], float(radius))
        is_single = np.ndim(start) == 1 and np.ndim(goal) == 1
        return float(lengths[0]) if is_single else lengths

    @property
    def length(self) -> float:
        """Driven length, meters."""
        return self._core.length_m

    @property
    def arcs(self) -> NDArray[np.float64]:
        """Curvature (1/m, positive left) and signed length (m) of each arc, shape (n, 2)."""
        return frozen(np.array(self._core.arcs, dtype=np.float64).reshape(-1, 2))

    @property
    def end(self) -> Pose:
        """The pose at its end, which is the goal up to rounding."""
        x, y, heading = self._core.end
        return (x, y, heading)

    def sample(self, spacing: float = 0.1) -> NDArray[np.float64]:
        """Return poses along the curve.

        Parameters
        ----------
        spacing : float, optional
            Most that two poses lie apart, meters.

        Returns
        -------
        ndarray of float64, shape (n, 3)
            ``x, y, heading`` of each, both ends included.
        """
        return np.array(self._core.sample(float(spacing)), dtype=np.float64)[:, :3]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.length:.3f} m, {len(self.arcs)} arcs)"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_curve_of, (type(self), *self._made_of))


class Dubins(Curve):
    """The shortest curve of bounded curvature, forward only.

    Parameters
    ----------
    start, goal : array_like, shape (3,)
        Poses ``(x, y, heading)``, meters and radians.
    radius : float
        Turning radius, meters.

    Examples
    --------
    >>> Dubins((0, 0, 0), (10, 0, 0), radius=2.0).length
    10.0
    >>> Dubins.distance((0, 0, 0), [(10, 0, 0), (12, 0, 0)], radius=2.0)
    array([10., 12.])
    """

    _reverses = False


class ReedsShepp(Curve):
    """The shortest curve of bounded curvature, forward and in reverse.

    Parameters
    ----------
    start, goal : array_like, shape (3,)
        Poses ``(x, y, heading)``, meters and radians.
    radius : float
        Turning radius, meters.

    Examples
    --------
    >>> ReedsShepp((10, 0, 0), (0, 0, 0), radius=2.0).length
    10.0
    """

    _reverses = True


def _curve_of(
    kind: type[Curve], start: Pose, goal: Pose, radius: float, place: int | None
) -> Curve:
    if place is None:
        return kind(start, goal, radius)
    return kind.candidates(start, goal, radius)[place]
