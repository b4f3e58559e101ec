"""From a goal to a certified path: the map is brought up to date, formicar plans."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import formicar
import numpy as np
from numpy.typing import NDArray

from .codes import Code, Failed, Stopped
from .maps import MapStore, decided
from .poses import Pose
from .settings import PlannerSettings, Settings


class Ticket:
    """A goal that is under way, and whether it still is."""

    def __init__(self) -> None:
        self._stopped = threading.Event()
        self.reason = ""
        self.on_stop: Callable[[], None] | None = None

    @property
    def is_stopped(self) -> bool:
        """True once the goal is not wanted any more."""
        return self._stopped.is_set()

    def stop(self, reason: str) -> None:
        """Say that the goal is not wanted any more, from any thread."""
        if self._stopped.is_set():
            return
        self.reason = reason
        self._stopped.set()
        on_stop = self.on_stop
        if on_stop is not None:
            on_stop()

    def check(self) -> None:
        """Raise `Stopped` if the goal is not wanted any more."""
        if self._stopped.is_set():
            raise Stopped(self.reason)

    def wait(self, timeout_s: float) -> None:
        """Wait, and raise `Stopped` as soon as the goal is not wanted any more."""
        if self._stopped.wait(timeout_s):
            raise Stopped(self.reason)


@dataclass(frozen=True)
class Query:
    """A start, a goal, and what lies between, in the frame of the map."""

    planner_id: str
    start: Pose
    goal: Pose
    via: tuple[tuple[float, ...], ...] = ()


@dataclass
class _Prepared:
    """A planner with the number of the map that it knows, and its last path."""

    planner: formicar.Planner
    settings: PlannerSettings
    vehicle: formicar.Vehicle
    number: int
    last: tuple[Query, formicar.Plan] | None = None


class Scene:
    """The planners on the map. One query at a time; they follow one another."""

    def __init__(self, store: MapStore, settings: Settings, n_threads: int) -> None:
        self.store = store
        self.settings = settings
        self._n_threads = n_threads
        self._prepared: dict[str, _Prepared] = {}
        self._turn = threading.Lock()

    def forget(self) -> None:
        """Plan anew next time, from no earlier path and with a planner that is made for the map."""
        self._prepared = {}

    def plan(self, query: Query, ticket: Ticket) -> formicar.Plan:
        """Plan, and return a plan with a path.

        Raises
        ------
        Failed
            No path, and why.
        Stopped
            The goal is not wanted any more.
        """
        with self._turn:
            ticket.check()
            try:
                settings = self.settings
                return self._asked(self._up_to_date(query.planner_id, settings), query, ticket)
            finally:
                ticket.on_stop = None

    def _asked(self, prepared: _Prepared, query: Query, ticket: Ticket) -> formicar.Plan:
        ticket.on_stop = prepared.planner.cancel
        ticket.check()
        try:
            plan = _planned(prepared, query, lambda _: ticket.check())
            while plan.status == "cancelled" and not ticket.is_stopped:
                # The cancel was that of the goal before, and came late.
                plan = _planned(prepared, query, lambda _: ticket.check())
        except formicar.InvalidRequest as error:
            raise Failed(self._code_of_refusal(prepared, query), str(error)) from None
        ticket.check()
        if not plan:
            prepared.last = None
            raise Failed(_CODES.get(plan.status, Code.NO_VALID_PATH), f"{plan.reason}")
        prepared.last = (query, plan)
        return plan

    def _up_to_date(self, planner_id: str, settings: Settings) -> _Prepared:
        """Return the planner of this name, on the map as it is now."""
        own = settings.planners[planner_id]
        known = self._prepared.get(planner_id)
        if known is not None and known.settings == own and known.vehicle == settings.vehicle:
            number, area, frame = self.store.changes_since(known.number)
            if area is not None and frame is not None:
                col, row, n_cols, n_rows = area
                if n_cols:
                    cells = frame.data[row : row + n_rows, col : col + n_cols]
                    cells = decided(cells, unknown_is_free=own.allow_unknown)
                    known.planner.update_map(_graded(cells), col, row)
                known.number = number
                return known
        return self._made(planner_id, own, settings.vehicle)

    def _made(self, planner_id: str, own: PlannerSettings, vehicle: formicar.Vehicle) -> _Prepared:
        number = self.store.number
        grid = self.store.grid(unknown_is_free=own.allow_unknown)
        if grid is None:
            raise Failed(Code.TIMEOUT, "the map is gone")
        planner = formicar.Planner(grid, vehicle, own.config, n_threads=self._n_threads)
        prepared = _Prepared(planner, own, vehicle, number)
        self._prepared[planner_id] = prepared
        return prepared

    def _code_of_refusal(self, prepared: _Prepared, query: Query) -> Code:
        """Return what is wrong with a request, by the judge's word on its ends."""
        outside = (Code.START_OUTSIDE_MAP, Code.GOAL_OUTSIDE_MAP)
        occupied = (Code.START_OCCUPIED, Code.GOAL_OCCUPIED)
        ends = [query.start, query.goal, *(place for place in query.via if len(place) == 3)]
        for n, pose in enumerate(ends):
            if not np.all(np.isfinite(pose)):
                return outside[min(n, 1)]
            kinds = kinds_of(pose, prepared.planner.map, prepared.vehicle)
            if "leaves_map" in kinds:
                return outside[min(n, 1)]
            if "collision" in kinds:
                return occupied[min(n, 1)]
        return Code.UNKNOWN


_CODES = {
    "timed_out": Code.TIMEOUT,
    "budget_exhausted": Code.TIMEOUT,
    "no_path": Code.NO_VALID_PATH,
    "infeasible": Code.NO_VALID_PATH,
}


def kinds_of(
    pose: tuple[float, ...], grid: formicar.OccupancyGrid, vehicle: formicar.Vehicle
) -> set[str]:
    """Return the kinds of what the judge objects to in a single pose."""
    check = formicar.check(np.array([pose]), grid, vehicle)
    return {violation.kind for violation in check.certificate.violations}


def _planned(
    prepared: _Prepared, query: Query, on_progress: Callable[[dict[str, Any]], object]
) -> formicar.Plan:
    own = prepared.settings
    how: dict[str, Any] = {
        "seed": own.seed,
        "deadline_s": own.max_planning_time_s,
        "motion": own.motion,
        "goal_heading": own.goal_heading,
        "goal_tolerance": own.tolerance,
        "via": list(query.via) or None,
        "on_progress": on_progress,
    }
    previous = _path_driven(prepared, query)
    if previous is not None:
        return prepared.planner.replan(query.start, query.goal, previous, **how)
    if own.continuous_curvature:
        how["continuous_curvature"] = True
    if own.soft_weight > 0.0:
        how |= {"soft_costs": _soft(prepared.planner.map), "soft_weight": own.soft_weight}
    return prepared.planner.plan(query.start, query.goal, **how)


def _path_driven(prepared: _Prepared, query: Query) -> formicar.Plan | None:
    """Return the path to go on from: the last one, if it leads to the same goal.

    Via points that have been passed are no longer in the query.
    """
    own = prepared.settings
    if prepared.last is None or not own.keep_to_path or prepared.planner.name != "formicar":
        return None
    if own.continuous_curvature or own.soft_weight > 0.0:
        return None
    last, plan = prepared.last
    is_rest = not query.via or last.via[-len(query.via) :] == query.via
    return plan if last.goal == query.goal and is_rest else None


def _graded(cells: NDArray[np.int8]) -> NDArray[np.int8]:
    """Return a patch whose ones are zeros where there is no larger value.

    formicar refuses integers of 0 and 1 alone, as a map of booleans by mistake. In a patch of a
    costmap a 1 is a cost of one percent, and as good as free.
    """
    return np.where(cells == 1, np.int8(0), cells) if cells.size and cells.max() == 1 else cells


def _soft(grid: formicar.OccupancyGrid) -> NDArray[np.float64]:
    """Return the graded cells of a map as preferences from 0 to 1."""
    return np.where(grid.data < 100, np.maximum(grid.data, 0), 0) / 99.0
