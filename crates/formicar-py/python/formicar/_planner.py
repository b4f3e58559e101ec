"""Planners."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, Literal, SupportsFloat, SupportsIndex

from . import _formicar
from ._arrays import check_real, number_of, plain, whole_of
from ._formicar import ConfigError, InvalidRequest
from ._hints import nearest, suggests
from ._lazy import np
from ._map import OccupancyGrid, polygons
from ._plan import NoPath, Plan
from ._vehicle import Vehicle

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    Progress = Callable[[dict[str, Any]], object]


class Planner:
    """A planner, its map and its vehicle: prepared once, asked as often as you like.

    Threads may share a planner; their queries follow one another. Queries release the
    interpreter's lock, so planners of their own plan at the same time. Ctrl-C ends a query.

    Parameters
    ----------
    map : OccupancyGrid or str
        The map, or the name of a built-in one. The planner keeps a copy of its own, which
        `update_map` changes.
    vehicle : Vehicle or str, optional
        The vehicle, or the name of a preset; by default that of a built-in map, or
        ``"warehouse_amr"``.
    config : dict or path, optional
        Parameters: a dict as in a configuration file, keys dotted or nested, or a TOML file.
    n_threads : int, optional
        Threads that a colony may use. The result does not depend on it.
    **settings
        Parameters beside `config`, for instance ``planner="lei2020"`` or
        ``hybrid_astar={"weight": 1.2}``; dotted keys as ``**{"hybrid_astar.weight": 1.2}``.

    Raises
    ------
    ConfigError
        A parameter that does not exist, is of another type, or lies outside its range. The nearest
        known one is named.

    Examples
    --------
    >>> planner = Planner("parking-lot", planner="hybrid-astar")
    >>> planner.vehicle.name, planner.name
    ('sedan', 'hybrid-astar')
    """

    _core: _formicar.Planner

    def __init__(
        self,
        map: OccupancyGrid | str,
        vehicle: Vehicle | str | None = None,
        config: Mapping[str, Any] | str | os.PathLike[str] | None = None,
        *,
        n_threads: int = 1,
        **settings: Any,
    ) -> None:
        map, vehicle = scene_of(map, vehicle)
        n_threads = whole_of(n_threads, "n_threads", ConfigError)
        if not 1 <= n_threads <= 1024:
            raise ConfigError(f"n_threads = {n_threads}; it must be 1 to 1024")
        tables = [_table_of(config), settings]
        for table in tables:
            _check_keys(table)
        self._core = _formicar.Planner(map._core, vehicle._core, tables, n_threads)

    @property
    def name(self) -> str:
        """The planner's word, one of `planners`."""
        return self._core.name

    @property
    def config(self) -> dict[str, Any]:
        """Every parameter, nested as in a configuration file."""
        return dict(self._core.config())

    @property
    def map(self) -> OccupancyGrid:
        """The map as it is now."""
        return OccupancyGrid._of(self._core.grid())

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle."""
        return Vehicle._of(self._core.car())

    @suggests
    def plan(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        seed: SupportsIndex = 0,
        *,
        deadline_s: float | None = None,
        budget: SupportsIndex | None = None,
        motion: Literal["forward", "reverse"] | None = None,
        start_heading: Literal["exact", "any"] | None = None,
        goal_heading: Literal["exact", "bidirectional", "any"] | None = None,
        goal_tolerance: tuple[float, float] | None = None,
        via: Any = None,
        continuous_curvature: bool | float = False,
        keep_out: Any = None,
        soft_costs: ArrayLike | None = None,
        soft_weight: float = 3.0,
        keep_ants: bool = False,
        on_progress: Progress | bool | None = None,
    ) -> Plan:
        """Plan a path.

        The same map, vehicle, parameters, request and seed give the same path, to the last bit, on
        any machine and any number of threads.

        Parameters
        ----------
        start : array_like, shape (3,)
            Start pose ``(x, y, heading)`` of the rear axle, meters and radians.
        goal : array_like, shape (3,) or (n, 3)
            Goal pose, or several: the path ends at whichever is nearest.
        seed : int, optional
            Seed of the run.
        deadline_s : float, optional
            Time after which to give up, seconds. It alone can make two runs differ.
        budget : int, optional
            Search steps after which to give up.
        motion : {"reverse", "forward"}, optional
            Gears that may be used; ``"reverse"``, the default, allows both.
        start_heading : {"exact", "any"}, optional
            Whether the heading at the start is as given, or the planner's choice.
        goal_heading : {"exact", "bidirectional", "any"}, optional
            Whether the heading at the goal is as given, either way round, or the planner's choice.
        goal_tolerance : (float, float), optional
            Distance and heading difference allowed at the goal, meters and radians; 0.01 and 0.01
            by default.
        via : sequence, optional
            Places to pass in this order: ``(x, y)`` or ``(x, y, heading)`` each, within 0.1 m and
            0.1 rad, or dicts as in a request document with a tolerance of their own.
        continuous_curvature : bool or float, optional
            Ask for a path whose curvature does not jump inside a gear; a number is its largest rate
            of change, 1/m², ``True`` takes that of the vehicle's steering rate and speed.
        keep_out : sequence of array_like, each of shape (n, 2), optional
            Polygons closed for this query, meters. The map is prepared anew for them.
        soft_costs : array_like, shape of the map, optional
            Preference from 0 (indifferent) to 1 (unwanted), row 0 at the bottom, for planners that
            heed it: ``formicar`` and ``hybrid-astar``. It makes no path invalid.
        soft_weight : float, optional
            A meter over a cell of soft cost 1 costs 1 + `soft_weight` meters.
        keep_ants : bool, optional
            Keep iterations of a colony for `Plan.ants`.
        on_progress : callable or True, optional
            Called with a dict on every better path (``event == "improved"``, ``length_m``), every
            iteration of a colony (``"iteration"``, ``best_so_far_cost``) and every 20 ms
            (``"progress"``, ``n_steps``), each with ``elapsed_s``. What it raises ends the query.
            ``True`` shows a tqdm bar.

        Returns
        -------
        Plan
            True with a certified path; false with `Plan.status` and `Plan.reason` without one.

        Raises
        ------
        InvalidRequest
            A request that cannot be asked on this map.
        KeyboardInterrupt
            Ctrl-C.

        Examples
        --------
        >>> planner = Planner("parking-lot")
        >>> plan = planner.plan(*planner.map.requests["back-in"])
        >>> plan.status, plan.metrics.n_cusps
        ('found', 1)
        """
        request = request_of(
            start,
            goal,
            deadline_s=deadline_s,
            budget=budget,
            motion=motion,
            start_heading=start_heading,
            goal_heading=goal_heading,
            goal_tolerance=goal_tolerance,
            via=via,
            continuous_curvature=continuous_curvature,
        )
        return self._ask(
            request, seed, keep_out, soft_costs, soft_weight, keep_ants, on_progress, None
        )

    def plan_or_raise(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        seed: SupportsIndex = 0,
        **how: Any,
    ) -> Plan:
        """Plan as `plan` does, and raise `NoPath` where there is no path.

        Raises
        ------
        NoPath
            No path; the plan is its attribute ``plan``.
        """
        plan = self.plan(start, goal, seed, **how)
        if not plan:
            raise NoPath(plan)
        return plan

    @suggests
    def replan(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        previous: Plan,
        seed: SupportsIndex = 0,
        *,
        deadline_s: float | None = None,
        budget: SupportsIndex | None = None,
        motion: Literal["forward", "reverse"] | None = None,
        start_heading: Literal["exact", "any"] | None = None,
        goal_heading: Literal["exact", "bidirectional", "any"] | None = None,
        goal_tolerance: tuple[float, float] | None = None,
        via: Any = None,
        on_progress: Progress | bool | None = None,
    ) -> Plan:
        """Plan again from where the vehicle is now, keeping to the path that it drives.

        Mostly called after `update_map`. Another path takes the place of the previous one only
        where it is clearly cheaper. Of the built-in planners, ``formicar`` replans.

        Parameters
        ----------
        start : array_like, shape (3,)
            Where the vehicle is now, meters and radians.
        goal : array_like, shape (3,) or (n, 3)
            As in `plan`, as the other parameters are.
        previous : Plan
            The plan that is driven; one with a path.

        Returns
        -------
        Plan
            As `plan`.

        Raises
        ------
        InvalidRequest
            As `plan`, and of a planner that does not replan.
        InvalidPath
            A previous plan without a path.
        """
        request = request_of(
            start,
            goal,
            deadline_s=deadline_s,
            budget=budget,
            motion=motion,
            start_heading=start_heading,
            goal_heading=goal_heading,
            goal_tolerance=goal_tolerance,
            via=via,
            continuous_curvature=False,
        )
        if not isinstance(previous, Plan):
            raise TypeError(f"previous is of type {type(previous).__name__}; expected a Plan")
        return self._ask(request, seed, None, None, 3.0, False, on_progress, previous._core)

    def _ask(
        self,
        request: dict[str, Any],
        seed: SupportsIndex,
        keep_out: Any,
        soft_costs: ArrayLike | None,
        soft_weight: float,
        keep_ants: bool,
        on_progress: Progress | bool | None,
        previous: _formicar.Plan | None,
    ) -> Plan:
        number = whole_of(seed, "seed", InvalidRequest)
        if isinstance(seed, bool) or not 0 <= number < 2**64:
            raise InvalidRequest(f"seed = {seed!r}; it must be a whole number from 0 to 2**64 - 1")
        costs = None
        if soft_costs is not None:
            array = plain(soft_costs, "soft_costs")
            check_real(array, "soft_costs", "biuf")
            costs = np.ascontiguousarray(array, dtype=np.float64)
            if costs.ndim != 2:
                raise InvalidRequest(
                    f"soft_costs has shape {costs.shape}, the map {self.map.shape}; hint: one "
                    "value from 0 (indifferent) to 1 (unwanted) for each cell"
                )
        areas = polygons(keep_out) if keep_out is not None else None
        weight = number_of(soft_weight, "soft_weight", "", InvalidRequest)
        manner = _Manner(number, None, keep_ants, areas, weight)
        if on_progress is True:
            from ._progress import bar

            with bar(request.get("budget_steps"), "steps") as listener:
                manner.listener = listener
                return Plan._of(self._core.plan(request, manner, costs, previous))
        if on_progress is not None and on_progress is not False:
            if not callable(on_progress):
                raise TypeError(
                    f"on_progress = {on_progress!r}; expected a callable that takes an event, a "
                    "dict, or True for a progress bar"
                )
            manner.listener = on_progress
        return Plan._of(self._core.plan(request, manner, costs, previous))

    def cancel(self) -> None:
        """End every query that is under way or waits, from any thread.

        Such a query returns a plan whose `Plan.status` is ``"cancelled"``.
        """
        self._core.cancel()

    @suggests
    def update_map(self, array: ArrayLike, col: int = 0, row: int = 0) -> None:
        """Put new values into a rectangle of cells of the planner's map.

        Afterwards the planner is, to the bit of every path, one made for the changed map, at a cost
        proportional to the change.

        Parameters
        ----------
        array : array_like, shape (n_rows, n_cols)
            The values, as in `OccupancyGrid`, row 0 at the bottom.
        col, row : int, optional
            The lower left cell of the rectangle.

        Raises
        ------
        InvalidMap
            A part of the rectangle off the map, or a value that no cell may have.

        Examples
        --------
        >>> import numpy as np
        >>> planner = Planner("parking-lot")
        >>> planner.update_map(np.ones((2, 3), dtype=bool), col=40, row=20)
        >>> int(planner.map.data[20, 42])
        100
        """
        col, row = whole_of(col, "col", InvalidRequest), whole_of(row, "row", InvalidRequest)
        if min(col, row) < 0 or max(col, row) >= 2**32:
            raise InvalidRequest(f"col, row = {col}, {row}; both must be 0 to 2**32 - 1")
        patch = OccupancyGrid(array, self.map.resolution)
        self._core.update_map(patch._core, col, row)

    def __repr__(self) -> str:
        return f"Planner({self.name!r}, {self.map!r}, {self.vehicle!r})"

    def __copy__(self) -> Planner:
        return Planner(self.map, self.vehicle, self.config, n_threads=self._core.n_threads)

    def __deepcopy__(self, memo: object) -> Planner:
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        return (_planner_of, (self.map, self.vehicle, self.config, self._core.n_threads))


class _Manner:
    """How a query is asked, besides its request."""

    __slots__ = ("keep_out", "keeps_ants", "listener", "seed", "soft_weight")

    def __init__(
        self,
        seed: int,
        listener: Any,
        keeps_ants: bool,
        keep_out: list[list[list[float]]] | None,
        soft_weight: float,
    ) -> None:
        self.seed = seed
        self.listener = listener
        self.keeps_ants = keeps_ants
        self.keep_out = keep_out
        self.soft_weight = soft_weight


def _planner_of(
    map: OccupancyGrid, vehicle: Vehicle, config: dict[str, Any], n_threads: int
) -> Planner:
    return Planner(map, vehicle, config, n_threads=n_threads)


def scene_of(
    map: OccupancyGrid | str, vehicle: Vehicle | str | None
) -> tuple[OccupancyGrid, Vehicle]:
    """Return a map and a vehicle that may have been given by name."""
    if isinstance(map, str):
        map = OccupancyGrid.builtin(map)
    if not isinstance(map, OccupancyGrid):
        raise TypeError(
            f"map is of type {type(map).__name__}; expected an OccupancyGrid or the name of a "
            "built-in map; hint: OccupancyGrid(array, resolution) or OccupancyGrid.load(path)"
        )
    if vehicle is None:
        vehicle = map.vehicle_name or "warehouse_amr"
    if isinstance(vehicle, str):
        vehicle = Vehicle.preset(vehicle)
    if not isinstance(vehicle, Vehicle):
        raise TypeError(
            f"vehicle is of type {type(vehicle).__name__}; expected a Vehicle or the name of a "
            "preset; hint: config= is for parameters"
        )
    return map, vehicle


def request_of(
    start: ArrayLike,
    goal: ArrayLike,
    *,
    deadline_s: float | None,
    budget: SupportsIndex | None,
    motion: str | None,
    start_heading: str | None,
    goal_heading: str | None,
    goal_tolerance: tuple[float, float] | None,
    via: Any,
    continuous_curvature: bool | float,
) -> dict[str, Any]:
    """Return a request as the document that the command line reads too."""
    request: dict[str, Any] = {"start": start}
    several = _is_nested(goal)
    request["goals" if several else "goal"] = goal
    if deadline_s is not None:
        if not isinstance(deadline_s, SupportsFloat) or not 0 < float(deadline_s) <= 3e7:
            raise InvalidRequest(
                f"deadline_s = {deadline_s!r}; it must be above 0 and at most 3e7 seconds"
            )
        request["deadline_ms"] = float(deadline_s) * 1e3
    if budget is not None:
        n_steps = whole_of(budget, "budget", InvalidRequest)
        if isinstance(budget, bool) or not 0 <= n_steps < 2**64:
            raise InvalidRequest(f"budget = {budget!r}; it must be a whole number from 0 on")
        request["budget_steps"] = n_steps
    words = [("motion", motion), ("start_heading", start_heading), ("goal_heading", goal_heading)]
    request.update((name, word) for name, word in words if word is not None)
    if goal_tolerance is not None:
        request["goal_tolerance"] = _tolerance(goal_tolerance)
    if via is not None:
        request["via"] = [_via(place) for place in _places(via)]
    if continuous_curvature is not False:
        rate = {} if continuous_curvature is True else {"max_rate_per_m2": continuous_curvature}
        request["curvature"] = {"continuous": rate}
    return request


def _is_nested(goal: Any) -> bool:
    """Return True for several poses."""
    ndim = getattr(goal, "ndim", None)
    if ndim is not None:
        return bool(ndim == 2)
    try:
        return len(goal) > 0 and hasattr(goal[0], "__len__")
    except (TypeError, KeyError):
        return False


def _tolerance(value: Any) -> dict[str, Any]:
    try:
        xy, yaw = value
    except (TypeError, ValueError):
        raise InvalidRequest(
            f"goal_tolerance = {value!r}; expected meters and radians: two numbers"
        ) from None
    return {"xy": xy, "yaw": yaw}


def _places(via: Any) -> Iterator[Any]:
    try:
        return iter(via)
    except TypeError:
        raise InvalidRequest(
            f"via = {via!r}; expected a sequence of points, each (x, y) or (x, y, heading) in "
            "meters and radians, or a dict"
        ) from None


def _via(place: Any) -> Any:
    if isinstance(place, Mapping):
        return dict(place)
    try:
        numbers = [float(number) for number in place]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) not in (2, 3):
        raise InvalidRequest(
            f"via point {place!r}; expected (x, y) or (x, y, heading) in meters and radians, or a "
            'dict as {"at": (x, y), "heading": 0.0, "tolerance": {"xy": 0.1, "yaw": 0.1}}'
        )
    record: dict[str, Any] = {"at": numbers[:2]}
    if len(numbers) == 3:
        record["heading"] = numbers[2]
    return record


def _table_of(config: Mapping[str, Any] | str | os.PathLike[str] | None) -> dict[str, Any]:
    """Return the parameters of a dict or a file."""
    if config is None:
        return {}
    if isinstance(config, Mapping):
        return dict(config)
    return dict(_formicar.read_config(os.fspath(config)))


def _check_keys(table: Mapping[str, Any]) -> None:
    """Refuse keys that no planner has, and name the nearest one that there is."""
    known = _formicar.config_keys() if table else []
    for key in _keys_of(table):
        if not any(word == key or word.startswith(f"{key}.") for word in known):
            section = key.split(".")[0] + "."
            near = [word for word in known if word.startswith(section)] or known
            raise ConfigError(
                f"no planner parameter is named {key!r}{nearest(key, known)}; there are "
                + ", ".join(near)
            )


def _keys_of(table: Mapping[str, Any], within: str = "") -> list[str]:
    keys: list[str] = []
    for key, value in table.items():
        dotted = f"{within}{key}"
        if isinstance(value, Mapping) and value:
            keys += _keys_of(value, f"{dotted}.")
        else:
            keys.append(dotted)
    return keys


def planners() -> dict[str, str]:
    """Return the planners, each with its description, the default first.

    Examples
    --------
    >>> next(iter(planners()))
    'formicar'
    """
    return {name: about for name, about, _ in _formicar.planners()}


def parameters() -> list[dict[str, Any]]:
    """Return every parameter that a configuration may have.

    Returns
    -------
    list of dict
        ``key``, ``about``, ``unit``, ``range``, ``words`` and ``default`` of each.

    Examples
    --------
    >>> [p["range"] for p in parameters() if p["key"] == "hybrid_astar.weight"]
    ['1 to 10']
    """
    return _formicar.parameters()
