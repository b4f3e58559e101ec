"""Moving obstacles and their predictions."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from . import _formicar
from ._arrays import frozen, rows_of
from ._formicar import InvalidObstacle, InvalidPath
from ._hints import suggests
from ._lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class MovingObstacle:
    """A body that moves, and how fast its prediction gets uncertain.

    Parameters
    ----------
    radius_m : float, optional
        The radius of a disc about the pose, meters; instead of ``corners``.
    corners : array_like, shape (n, 2), optional
        The corners of a convex polygon in the frame of the pose, meters, in either order.
    pose : tuple of float, optional
        ``(x, y, heading)`` at time 0, meters and radians; instead of ``waypoints``.
    velocity_mps : tuple of float, optional
        A constant velocity along the axes of the map, m/s. With neither velocity nor speed the
        obstacle stands.
    speed_mps : float, optional
        A constant speed along the heading, m/s, negative backwards.
    turn_rad_per_s : float, optional
        The rate at which the heading turns meanwhile, rad/s, positive to the left.
    waypoints : array_like, shape (n, 4), optional
        Rows ``t, x, y, heading``, seconds, meters and radians, in order of time. Between two of
        them the obstacle moves along a line and turns the shorter way; before the first and after
        the last it stands.
    growth_mps : float, optional
        How fast the body grows on every side, since predictions err, m/s.
    name : str, optional
        Its name in messages; its number where left out.

    Raises
    ------
    InvalidObstacle
        Two shapes or motions, none, or numbers that are not finite or out of range.

    Examples
    --------
    >>> MovingObstacle(radius_m=0.3, pose=(6, 7, 0), velocity_mps=(0, -1.2), name="walker")
    MovingObstacle('walker', disc, velocity)
    >>> door = MovingObstacle(corners=[(0, 0), (1, 0), (1, 0.1), (0, 0.1)],
    ...                       waypoints=[(5, 4, 2, 0), (7, 4, 2, 1.57)])
    >>> door
    MovingObstacle(polygon, waypoints)
    """

    _document: dict[str, Any]

    @suggests
    def __init__(
        self,
        *,
        radius_m: float | None = None,
        corners: ArrayLike | None = None,
        pose: tuple[float, float, float] | None = None,
        velocity_mps: tuple[float, float] | None = None,
        speed_mps: float | None = None,
        turn_rad_per_s: float | None = None,
        waypoints: ArrayLike | None = None,
        growth_mps: float = 0.0,
        name: str | None = None,
    ) -> None:
        steered = {"speed_mps": speed_mps, "turn_rad_per_s": turn_rad_per_s}
        motion = {"pose": pose, "velocity_mps": velocity_mps, **steered}
        document: dict[str, Any] = {
            "shape": _shape(radius_m, corners),
            "motion": _motion(motion, waypoints),
            "growth_mps": growth_mps,
        }
        if name is not None:
            document["name"] = name
        self._set(document)

    def _set(self, document: dict[str, Any]) -> None:
        import json

        core = _formicar.Moving({"horizon_s": 1.0, "obstacles": [document]})
        self._document = json.loads(core.to_json())["obstacles"][0]

    @classmethod
    def from_dict(cls, document: dict[str, Any]) -> MovingObstacle:
        """Make an obstacle of a member of ``obstacles`` in a file of moving obstacles."""
        obstacle = cls.__new__(cls)
        obstacle._set(document)
        return obstacle

    def to_dict(self) -> dict[str, Any]:
        """Return the obstacle as it stands in a file of moving obstacles."""
        import copy

        return copy.deepcopy(self._document)

    @property
    def name(self) -> str | None:
        """Its name."""
        found: str | None = self._document.get("name")
        return found

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MovingObstacle):
            return NotImplemented
        return self._document == other._document

    def __hash__(self) -> int:
        return hash(repr(self._document))

    def __repr__(self) -> str:
        name = f"{self.name!r}, " if self.name else ""
        shape, motion = (next(iter(self._document[word])) for word in ("shape", "motion"))
        return f"MovingObstacle({name}{shape}, {motion})"


def _rows(data: ArrayLike, name: str, n_cols: int) -> list[list[float]]:
    try:
        rows: list[list[float]] = rows_of(data, name, (n_cols,)).tolist()
    except InvalidPath as error:
        raise InvalidObstacle(str(error)) from None
    return rows


def _shape(radius_m: float | None, corners: ArrayLike | None) -> dict[str, Any]:
    if (radius_m is None) == (corners is None):
        raise InvalidObstacle(
            "an obstacle has one shape; hint: radius_m of a disc, or corners of a convex polygon"
        )
    if corners is None:
        return {"disc": {"radius_m": radius_m}}
    return {"polygon": _rows(corners, "corners", 2)}


def _motion(given: dict[str, Any], waypoints: ArrayLike | None) -> dict[str, Any]:
    named = [word for word, value in given.items() if value is not None]
    if waypoints is not None:
        if named:
            raise InvalidObstacle(f"waypoints and {named[0]}; hint: an obstacle has one motion")
        rows = _rows(waypoints, "waypoints", 4)
        return {"waypoints": [{"t_s": t, "pose": pose} for t, *pose in rows]}
    if given["pose"] is None:
        raise InvalidObstacle("an obstacle needs a pose at time 0, or waypoints")
    pose = given["pose"]
    turns = given["speed_mps"] is not None or given["turn_rad_per_s"] is not None
    if turns and given["velocity_mps"] is not None:
        raise InvalidObstacle(
            "velocity_mps and speed_mps or turn_rad_per_s; hint: an obstacle has one motion"
        )
    if turns:
        speed, rate = given["speed_mps"] or 0.0, given["turn_rad_per_s"] or 0.0
        return {"turn": {"pose": pose, "speed_mps": speed, "rate_rad_per_s": rate}}
    velocity = given["velocity_mps"]
    return {
        "velocity": {"pose": pose, "velocity_mps": (0.0, 0.0) if velocity is None else velocity}
    }


class Predictions:
    """Moving obstacles and the time up to which they are predicted.

    From the horizon on, every obstacle is taken to stand where it was predicted last.

    Parameters
    ----------
    obstacles : iterable of MovingObstacle or dict
        The obstacles; dicts as in a file of moving obstacles.
    horizon_s : float
        Time up to which they are predicted, seconds, above 0 and at most 600.

    Raises
    ------
    InvalidObstacle
        A horizon out of its range, or an obstacle that cannot be.

    Examples
    --------
    >>> walker = MovingObstacle(radius_m=0.3, pose=(6, 7, 0), velocity_mps=(0, -1.2))
    >>> crossing = Predictions([walker], horizon_s=30)
    >>> crossing.poses([0.0, 5.0, 100.0])[0, :, 1]
    array([  7.,   1., -29.])
    """

    _core: _formicar.Moving

    def __init__(
        self, obstacles: Iterable[MovingObstacle | dict[str, Any]], horizon_s: float
    ) -> None:
        documents = [one.to_dict() if isinstance(one, MovingObstacle) else one for one in obstacles]
        self._core = _formicar.Moving({"horizon_s": horizon_s, "obstacles": documents})

    @classmethod
    def _of(cls, core: _formicar.Moving) -> Predictions:
        predictions = cls.__new__(cls)
        predictions._core = core
        return predictions

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Predictions:
        """Read the JSON file that ``formicar plan --moving`` reads.

        Raises
        ------
        FileNotFoundError
            No such file.
        InvalidObstacle
            A file that holds no moving obstacles.
        """
        return cls._of(_formicar.Moving.load(os.fspath(path)))

    @classmethod
    def from_dict(cls, document: dict[str, Any]) -> Predictions:
        """Make predictions of the same document as a dict: ``horizon_s`` and ``obstacles``."""
        return cls._of(_formicar.Moving(document))

    def to_dict(self) -> dict[str, Any]:
        """Return the document that ``formicar plan --moving`` reads."""
        import json

        return dict(json.loads(self._core.to_json()))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file that ``formicar plan --moving`` reads."""
        from pathlib import Path

        Path(path).write_text(self._core.to_json() + "\n", encoding="utf-8")

    @property
    def horizon_s(self) -> float:
        """Time up to which the obstacles are predicted, seconds."""
        return self._core.horizon_s

    @property
    def obstacles(self) -> tuple[MovingObstacle, ...]:
        """The obstacles, in the order given."""
        return tuple(MovingObstacle.from_dict(one) for one in self.to_dict()["obstacles"])

    def poses(self, t_s: ArrayLike) -> NDArray[np.float64]:
        """Return the predicted pose of every obstacle at every time.

        Parameters
        ----------
        t_s : array_like, shape (n,)
            Times, seconds.

        Returns
        -------
        ndarray of float64, shape (n_obstacles, n, 3)
            ``x, y, heading``, meters and radians; read-only.
        """
        return frozen(self._core.poses(times_of(t_s)))

    def __len__(self) -> int:
        return len(self._core.names)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Predictions):
            return NotImplemented
        return self._core.to_json() == other._core.to_json()

    def __hash__(self) -> int:
        return hash(self._core.to_json())

    def __repr__(self) -> str:
        return f"Predictions({', '.join(self._core.names) or 'nothing'}, {self.horizon_s:g} s)"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Predictions.from_dict, (self.to_dict(),))


def predictions_of(predictions: object) -> _formicar.Moving:
    """Return predictions as the compiled part takes them.

    Raises
    ------
    TypeError
        Something else.
    """
    if isinstance(predictions, Predictions):
        return predictions._core
    kind = type(predictions).__name__
    raise TypeError(
        f"predictions is of type {kind}; expected Predictions; hint: Predictions(obstacles, "
        "horizon_s=30)"
    )


def times_of(t_s: ArrayLike) -> NDArray[np.float64]:
    """Return times as a contiguous array.

    Raises
    ------
    ValueError
        Another shape, or times that are not finite.
    """
    times = np.ascontiguousarray(t_s, dtype=np.float64)
    if np.ndim(t_s) > 1:
        raise ValueError(f"t_s has shape {times.shape}; expected (n,)")
    if not np.isfinite(times).all():
        raise ValueError("t_s is not finite; expected seconds")
    return times
