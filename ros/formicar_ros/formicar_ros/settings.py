"""Everything that parameters decide, checked as a whole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import formicar
import numpy as np

from .vehicles import vehicle_of

MOTIONS = ("reverse", "forward")
MAP_TYPES = ("occupancy_grid", "costmap")
GOAL_HEADINGS = ("exact", "bidirectional", "any")


@dataclass(frozen=True)
class PlannerSettings:
    """How one of the `planner_plugins` plans."""

    config: dict[str, Any]
    tolerance: tuple[float, float]
    max_planning_time_s: float
    allow_unknown: bool
    motion: str
    goal_heading: str
    continuous_curvature: bool
    soft_weight: float
    keep_to_path: bool
    seed: int


@dataclass(frozen=True)
class Settings:
    """The vehicle, and the planners by their names."""

    vehicle: formicar.Vehicle
    planners: dict[str, PlannerSettings]


def settings_of(values: Mapping[str, Any], config_keys: Mapping[str, list[str]]) -> Settings:
    """Return the settings that parameter values make.

    Parameters
    ----------
    values : mapping
        Values by the names of the parameters.
    config_keys : mapping
        The dotted configuration keys of each of the `planner_plugins`.

    Raises
    ------
    ValueError
        A value that cannot be, in formicar's words.
    """
    vehicle = vehicle_of(values)
    _check_word("map_type", values["map_type"], MAP_TYPES)
    planners = {}
    for plugin, keys in config_keys.items():
        planners[plugin] = _planner_of(plugin, keys, values, vehicle)
    return Settings(vehicle, planners)


def _planner_of(
    plugin: str, keys: list[str], values: Mapping[str, Any], vehicle: formicar.Vehicle
) -> PlannerSettings:
    def value(name: str) -> Any:
        return values[f"{plugin}.{name}"]

    config = {key: value(key) for key in ["planner", *keys]}
    try:
        formicar.Planner(_speck(), vehicle, config)
    except formicar.ConfigError as error:
        raise formicar.ConfigError(f"{plugin}: {error}") from None
    _check_word(f"{plugin}.motion", value("motion"), MOTIONS)
    _check_word(f"{plugin}.goal_heading", value("goal_heading"), GOAL_HEADINGS)
    return PlannerSettings(
        config=config,
        tolerance=(
            _number(f"{plugin}.tolerance", value("tolerance"), 0.0, 100.0),
            _number(f"{plugin}.angle_tolerance", value("angle_tolerance"), 0.0, 3.2),
        ),
        max_planning_time_s=_number(
            f"{plugin}.max_planning_time", value("max_planning_time"), 0.001, 3600.0
        ),
        allow_unknown=_flag(f"{plugin}.allow_unknown", value("allow_unknown")),
        motion=value("motion"),
        goal_heading=value("goal_heading"),
        continuous_curvature=_flag(f"{plugin}.continuous_curvature", value("continuous_curvature")),
        soft_weight=_number(f"{plugin}.soft_weight", value("soft_weight"), 0.0, 1000.0),
        keep_to_path=_flag(f"{plugin}.keep_to_path", value("keep_to_path")),
        seed=int(_number(f"{plugin}.seed", value("seed"), 0, 2**63 - 1)),
    )


def config_of(word: str) -> dict[str, Any]:
    """Return the default configuration of a planner, by dotted keys, without its word.

    Raises
    ------
    formicar.ConfigError
        No planner of this name.
    """
    planner = formicar.Planner(_speck(), "warehouse_amr", planner=word)
    flat = dict(_flattened(planner.config))
    flat.pop("planner")
    return flat


def _flattened(table: Mapping[str, Any], within: str = "") -> list[tuple[str, Any]]:
    found: list[tuple[str, Any]] = []
    for key, value in table.items():
        if isinstance(value, Mapping):
            found += _flattened(value, f"{within}{key}.")
        elif value is not None:
            found.append((f"{within}{key}", value))
    return found


def _speck() -> formicar.OccupancyGrid:
    """Return the smallest map, for planners that are made to be checked alone."""
    return formicar.OccupancyGrid(np.zeros((2, 2), dtype=bool), 0.1)


def _number(name: str, value: Any, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
        raise formicar.ConfigError(f"{name} = {value!r}; it must be in {low:g} to {high:g}")
    return float(value)


def _flag(name: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise formicar.ConfigError(f"{name} = {value!r}; it must be true or false")
    return value


def _check_word(name: str, value: Any, words: tuple[str, ...]) -> None:
    if value not in words:
        raise formicar.ConfigError(f"{name} = {value!r}; expected one of {', '.join(words)}")
