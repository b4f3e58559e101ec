"""Plans: certified paths, or the reason why there is none."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _formicar
from ._arrays import frozen, table_of
from ._lazy import np
from ._map import OccupancyGrid
from ._records import (
    Certificate,
    Explanation,
    Metrics,
    Pose,
    Timing,
    certificate_of,
    explanation_of,
    record_of,
)
from ._vehicle import Vehicle

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class History(NamedTuple):
    """The course of a query.

    Attributes
    ----------
    improvements : ndarray of void, fields ``at_s``, ``n_steps``, ``length_m``
        Certified paths, the best last: time since the query began in seconds, search steps, length
        in meters.
    iterations : ndarray of void
        Iterations of a colony or generations of a population, with the fields of an iteration in an
        answer: ``iteration``, ``n_ants``, ``n_arrived``, ``best_cost``, ``mean_cost``,
        ``best_length``, ``mean_length``, ``best_so_far_cost``, ``best_so_far_length``, ``rho``,
        ``min_pheromone``, ``max_pheromone``. NaN where no ant arrived; empty for other planners.
    """

    improvements: NDArray[np.void]
    iterations: NDArray[np.void]


class AntFrame(NamedTuple):
    """An iteration of a colony, as far as it is kept.

    Attributes
    ----------
    record : dict
        Its numbers.
    arrived, lost : ndarray of uint32, shape (n, 5)
        Passages between two cells, ``(col, row, col, row, number)``, of the ants that reached the
        goal and of the others.
    best : ndarray of uint32, shape (n, 2)
        ``(col, row)`` of the cells on the way of least cost; empty if no ant arrived.
    pheromone : ndarray of float32, shape (n_rows, n_cols)
        Pheromone after the update, row 0 at the bottom; NaN where no ant can go.
    """

    record: dict[str, Any]
    arrived: NDArray[np.uint32]
    lost: NDArray[np.uint32]
    best: NDArray[np.uint32]
    pheromone: NDArray[np.float32]


class Plan:
    """The answer to a request: true with a certified path, false with the reason without one.

    Made by `Planner.plan`. Plans can be pickled; two plans are equal where everything but their
    times is, bit for bit, also in another process.

    Examples
    --------
    >>> import formicar
    >>> planner = formicar.Planner("parking-lot")
    >>> plan = planner.plan(*planner.map.requests["back-in"])
    >>> plan.poses.dtype.names[:5], plan.poses.dtype.names[5:]
    (('x', 'y', 'heading', 's', 'direction'), ('curvature', 'steer', 'clearance', 'speed', 'time'))
    >>> round(plan.certificate.min_clearance_m, 2)
    0.25
    >>> cut = planner.plan(*planner.map.requests["back-in"], budget=10)
    >>> bool(cut), cut.status
    (False, 'budget_exhausted')
    """

    _core: _formicar.Plan

    def __init__(self) -> None:
        raise TypeError("plans are made by Planner.plan")

    @classmethod
    def _of(cls, core: _formicar.Plan) -> Plan:
        plan = cls.__new__(cls)
        plan._core = core
        return plan

    def __bool__(self) -> bool:
        return self._core.found

    @property
    def status(self) -> str:
        """How the query ended.

        ``found``, ``no_path``, ``infeasible``, ``budget_exhausted``, ``timed_out``, ``cancelled``.
        """
        return self._core.status

    @property
    def reason(self) -> str | None:
        """Why there is no path, as a sentence; ``None`` where there is one."""
        return self._core.reason

    @cached_property
    def explanation(self) -> Explanation | None:
        """The same in places and measures; ``None`` where there is a path."""
        document = self._core.member("explanation")
        return explanation_of(document) if document else None

    @cached_property
    def certificate(self) -> Certificate | None:
        """The judge's findings on the path found or, where ``infeasible``, refused."""
        document = self._core.member("certificate")
        return certificate_of(document) if document else None

    @cached_property
    def metrics(self) -> Metrics | None:
        """Exact metrics of the path; ``None`` without one."""
        document = self._core.member("metrics")
        return record_of(Metrics, document) if document else None

    @cached_property
    def poses(self) -> NDArray[np.void]:
        """Poses at most 0.1 m apart, with both ends of every segment; empty without a path.

        A read-only structured array with the fields ``x``, ``y`` (meters), ``heading`` (radians),
        ``s`` (arc length, meters), ``direction`` (1 forward, -1 in reverse), ``curvature`` (1/m,
        positive left), ``steer`` (radians; NaN where the wheelbase is not known), ``clearance``
        (meters), and for a vehicle with a speed ``speed`` (m/s) and ``time`` (s).
        """
        return frozen(table_of(self._core.columns(), {"direction": "i1"}))

    @cached_property
    def xy(self) -> NDArray[np.float64]:
        """Positions of `poses`, shape (n, 2), meters; read-only."""
        return frozen(np.column_stack((self.poses["x"], self.poses["y"])))

    @cached_property
    def segments(self) -> NDArray[np.void]:
        """The path itself, exactly: lines, arcs and clothoids; read-only, empty without a path.

        A structured array with the fields ``x``, ``y``, ``heading`` at the segment's start,
        ``curvature`` there (1/m), ``curvature_rate`` (1/m²), ``length`` (m) and ``direction``.
        """
        records = self._core.member("segments") or []
        names = ("x", "y", "heading", "curvature", "curvature_rate", "length", "direction")
        columns = {
            name: np.array([record.get(name, 0.0) for record in records], dtype=np.float64)
            for name in names
        }
        return frozen(table_of(columns, {"direction": "i1"}))

    @property
    def cells(self) -> NDArray[np.uint32]:
        """``(col, row)`` of the cells that a planner over cells has found, shape (n, 2)."""
        return self._core.cells()

    @property
    def nodes(self) -> NDArray[np.uint32]:
        """``(col, row)`` of those cells at which its polyline turns, shape (n, 2)."""
        return self._core.nodes()

    @property
    def pheromone(self) -> NDArray[np.float32] | None:
        """Pheromone at the end of a colony's run, shape of the map; ``None`` of other planners.

        Row 0 is at the bottom; NaN where no ant can go.
        """
        return self._core.pheromone()

    @cached_property
    def ants(self) -> list[AntFrame]:
        """Kept iterations of a colony; empty unless planned with ``keep_ants=True``.

        They are not pickled.
        """
        return [AntFrame(**frame) for frame in self._core.ants()]

    @cached_property
    def history(self) -> History:
        """Better and better paths over the query, and the iterations of a colony."""
        kinds = [("at_s", "f8"), ("n_steps", "u8"), ("length_m", "f8")]
        improvements = np.array(self._core.improvements(), dtype=kinds)
        colony = self._core.member("colony") or {}
        records = colony.get("iterations", [])
        columns = {name: _column(records, name) for name in _ITERATION}
        counts = {"iteration": "u4", "n_ants": "u4", "n_arrived": "u4"}
        return History(frozen(improvements), frozen(table_of(columns, counts)))

    @property
    def seed(self) -> int:
        """The seed that the planner was given."""
        return self._core.seed

    @property
    def planner(self) -> str:
        """The planner's word."""
        return self._core.planner_name

    @property
    def cut_by(self) -> str | None:
        """The limit that ended the improvement of the path early; ``None`` for most."""
        found: str | None = self._core.member("cut_by")
        return found

    @property
    def timing(self) -> Timing:
        """Times of the query, seconds."""
        return record_of(Timing, self._core.timing)

    @property
    def provenance(self) -> dict[str, Any]:
        """All that a repetition needs: version, map, vehicle, request and parameters."""
        return dict(self._core.member("provenance"))

    @cached_property
    def map(self) -> OccupancyGrid:
        """The map that was planned on, with unknown cells decided and keep-out areas closed."""
        return OccupancyGrid._of(self._core.grid())

    @cached_property
    def vehicle(self) -> Vehicle:
        """The vehicle."""
        return Vehicle._of(self._core.car())

    @property
    def start(self) -> Pose:
        """The start pose of the request, meters and radians."""
        return self._core.ends[0]

    @property
    def goal(self) -> Pose:
        """The goal of the request; of several that which was reached, or the first."""
        return self._core.ends[1]

    def to_dict(self) -> dict[str, Any]:
        """Return the answer document as the command line writes it."""
        import json

        return dict(json.loads(self._core.to_json()))

    def to_json(self) -> str:
        """Return the answer document as the command line writes it; ``formicar check`` reads it."""
        return self._core.to_json()

    def to_csv(self) -> str:
        """Return the poses as CSV, as the command line writes them.

        Raises
        ------
        InvalidPath
            A plan without a path.
        """
        return self._core.to_csv()

    def to_dataframe(self, backend: Literal["pandas", "polars"] | None = None) -> Any:
        """Return `poses` as a data frame.

        Parameters
        ----------
        backend : {"pandas", "polars"}, optional
            The package; by default pandas where it is installed, else polars.

        Returns
        -------
        pandas.DataFrame or polars.DataFrame
            A column for each field of `poses`.

        Raises
        ------
        ImportError
            Neither is installed.
        """
        names = self.poses.dtype.names or ()
        columns = {name: np.ascontiguousarray(self.poses[name]) for name in names}
        for package in (backend,) if backend else ("pandas", "polars"):
            if package not in ("pandas", "polars"):
                raise ValueError(f'backend = {package!r}; expected "pandas" or "polars"')
            try:
                module = __import__(package)
            except ImportError:
                continue
            return module.DataFrame(columns)
        wanted = backend or "pandas or polars"
        raise ImportError(f"a data frame needs {wanted}; hint: pip install {backend or 'pandas'}")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the answer (``.json``), the poses (``.csv``) or a picture (``.svg``)."""
        self._core.save(os.fspath(path))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw map, swept bodies, path, start and goal with matplotlib, and return the axes."""
        from ._draw import draw_plan

        return draw_plan(self, ax)

    def animate(self, ax: Axes | None = None, *, interval_ms: int = 40) -> FuncAnimation:
        """Return a matplotlib animation of the vehicle on its path.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw.
        interval_ms : int, optional
            Time from pose to pose, milliseconds.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            In Jupyter, ``IPython.display.HTML(animation.to_jshtml())`` shows it; keep a reference
            to it while it is shown.

        Raises
        ------
        InvalidPath
            A plan without a path.
        """
        from ._draw import animate_plan

        return animate_plan(self, ax, interval_ms)

    def to_svg(self, *, ants: bool = False) -> str:
        """Return the picture that the command line draws.

        Parameters
        ----------
        ants : bool, optional
            The colony's run instead: pheromone, ways of ants, nodes and convergence.

        Raises
        ------
        ValueError
            Ants of a planner that sends none, or of a plan that was unpickled.
        """
        if not ants:
            return self._core.svg(False)
        picture = self._core.ants_svg()
        if picture is None:
            raise ValueError(
                f"{self.planner}: no ants are kept; hint: planner='lei2020' and keep_ants=True"
            )
        return picture

    def __iter__(self) -> Iterator[np.void]:
        return iter(self.poses)

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        if not self:
            return f"Plan({self.status}: {self.reason})"
        metrics = self.metrics
        assert metrics is not None, "a path that was found has metrics"
        cusps = "1 cusp" if metrics.n_cusps == 1 else f"{metrics.n_cusps} cusps"
        return (
            f"Plan(found, {metrics.length_m:.2f} m, clearance {metrics.min_clearance_m:.2f} m, "
            f"{cusps})"
        )

    def _repr_html_(self) -> str:
        from ._draw import plan_html

        return plan_html(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Plan):
            return NotImplemented
        return self._core.same_as(other._core)

    def __hash__(self) -> int:
        return hash((self.status, self.seed, self.certificate and self.certificate.path_hash))

    def __copy__(self) -> Plan:
        return self

    def __deepcopy__(self, memo: object) -> Plan:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        text, grid, car, pheromone = self._core.state()
        state = (text, OccupancyGrid._of(grid), Vehicle._of(car), pheromone)
        return (_plan_of_state, state)


def _plan_of_state(
    text: str, grid: OccupancyGrid, vehicle: Vehicle, pheromone: list[float] | None
) -> Plan:
    return Plan._of(_formicar.Plan.of_state(text, grid._core, vehicle._core, pheromone))


# The fields of an iteration, in the order of the answer document.
_ITERATION = (
    "iteration",
    "n_ants",
    "n_arrived",
    "best_cost",
    "mean_cost",
    "best_length",
    "mean_length",
    "best_so_far_cost",
    "best_so_far_length",
    "rho",
    "min_pheromone",
    "max_pheromone",
)


def _column(records: list[dict[str, Any]], name: str) -> NDArray[np.float64]:
    values = (record[name] for record in records)
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)


class NoPath(RuntimeError):
    """There is no path, for callers that want that as an exception.

    Attributes
    ----------
    plan : Plan
        The plan without a path, with its status, reason and explanation.
    """

    def __init__(self, plan: Plan) -> None:
        super().__init__(f"{plan.status}: {plan.reason}")
        self.plan = plan

    def __reduce__(self) -> tuple[Any, ...]:
        return (NoPath, (self.plan,))
