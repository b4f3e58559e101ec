"""ROS parameters: names, defaults, ranges and help, those of planners from formicar's schema."""

from __future__ import annotations

from functools import cache
from typing import Any

import formicar
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

from .settings import GOAL_HEADINGS, MOTIONS, config_of
from .vehicles import MEASURES

Declaration = tuple[str, Any, ParameterDescriptor]

_NODE = {
    "autostart": (False, "Configure and activate at once, without a lifecycle manager"),
    "map_topic": ("map", "Topic of the map; updates come on the same name with _updates"),
    "map_type": ("occupancy_grid", "Type of the map: occupancy_grid, or costmap for Costmap"),
    "map_subscribe_transient_local": (True, "Ask for the last map that was published"),
    "global_frame": ("map", "Frame of the map and of the paths"),
    "robot_base_frame": ("base_link", "Frame of the center of the rear axle, x forward"),
    "transform_tolerance": (0.5, "Largest age of the robot's pose, and wait for it, seconds"),
    "costmap_update_timeout": (1.0, "How long a goal waits for the first map, seconds"),
    "expected_planner_frequency": (1.0, "Rate below which planning is reported as slow, hertz"),
    "action_server_result_timeout": (10.0, "How long the result of a goal is kept, seconds"),
    "bond_heartbeat_period": (0.1, "Period of the bond with a lifecycle manager, seconds; 0: none"),
    "publish_costmap": (True, "Publish the map on global_costmap/costmap, and offer to clear it"),
    "n_threads": (1, "Threads that a colony may use"),
    "footprint": ("", "Corners of the body around the rear axle, as Nav2 writes them"),
    "footprint_padding": (0.0, "What is kept free around the body, meters"),
    "minimum_turning_radius": (0.0, "Turning radius that goes with the footprint, meters"),
    "vehicle.preset": ("", "A built-in vehicle"),
    "vehicle.file": ("", "A vehicle file, TOML or JSON"),
}

# Those that are looked at while the node is configured, and not later.
FIXED = (
    "autostart",
    "map_topic",
    "map_type",
    "map_subscribe_transient_local",
    "planner_plugins",
    "action_server_result_timeout",
    "bond_heartbeat_period",
    "publish_costmap",
    "n_threads",
)

_PLUGIN = {
    "tolerance": (0.01, "Distance allowed at the goal, meters"),
    "angle_tolerance": (0.01, "Heading difference allowed at the goal, radians"),
    "max_planning_time": (5.0, "Time after which planning gives up, seconds"),
    "allow_unknown": (False, "Drive over unknown cells"),
    "motion": ("reverse", f"Gears that may be used: {' or '.join(MOTIONS)}; reverse allows both"),
    "goal_heading": ("exact", f"Heading at the goal: {', '.join(GOAL_HEADINGS)}"),
    "continuous_curvature": (False, "Ask for a path whose curvature does not jump within a gear"),
    "soft_weight": (0.0, "Meters that a meter over the worst graded cell costs besides; 0: none"),
    "keep_to_path": (True, "Plan again from the path that is driven while the goal stays"),
    "seed": (0, "Seed of the planner"),
}


def node_declarations() -> list[Declaration]:
    """Return the parameters of the node itself."""
    found = [(name, value, _described(about)) for name, (value, about) in _NODE.items()]
    plugins = _described("Names of the planners that goals may ask for")
    found.append(("planner_plugins", ["GridBased"], plugins))
    found += [(f"vehicle.{name}", None, _described(about)) for name, about in MEASURES.items()]
    return found


def word_declaration(plugin: str) -> Declaration:
    """Return the parameter that says which of formicar's planners stands behind a name."""
    words = ", ".join(formicar.planners())
    return (f"{plugin}.planner", "formicar", _described("formicar's planner", f"one of {words}"))


def plugin_declarations(plugin: str, word: str) -> list[Declaration]:
    """Return the parameters of one of the `planner_plugins`.

    Raises
    ------
    formicar.ConfigError
        No planner of this name.
    """
    found = [
        (f"{plugin}.{name}", value, _described(about)) for name, (value, about) in _PLUGIN.items()
    ]
    for key, default in config_of(word).items():
        found.append((f"{plugin}.{key}", default, _of_schema(key, default)))
    return found


def own_names(plugin: str) -> list[str]:
    """Return the names that every one of the `planner_plugins` has, whatever its planner."""
    return [f"{plugin}.{name}" for name in ["planner", *_PLUGIN]]


@cache
def _schema() -> dict[str, dict[str, Any]]:
    found: dict[str, dict[str, Any]] = {}
    for parameter in formicar.parameters():
        found.setdefault(parameter["key"], parameter)
    return found


def _of_schema(key: str, default: Any) -> ParameterDescriptor:
    """Return help and range of a configuration key."""
    entry = _schema().get(key)
    if entry is None:
        return _described("")
    about = " ".join(entry["about"].split())
    unit = f" Unit: {entry['unit']}." if entry["unit"] else ""
    constraints = entry["range"] or (
        f"one of {', '.join(entry['words'])}" if entry["words"] else ""
    )
    descriptor = _described(f"{about}{unit}", constraints)
    _set_range(descriptor, entry["range"], default)
    return descriptor


def _set_range(descriptor: ParameterDescriptor, limits: str | None, default: Any) -> None:
    low, _, high = (limits or "").partition(" to ")
    if not high:
        return
    if isinstance(default, int) and not isinstance(default, bool):
        descriptor.integer_range = [
            IntegerRange(from_value=int(float(low)), to_value=int(float(high)), step=1)
        ]
    elif isinstance(default, float):
        descriptor.floating_point_range = [
            FloatingPointRange(from_value=float(low), to_value=float(high), step=0.0)
        ]


def _described(about: str, constraints: str = "") -> ParameterDescriptor:
    # Dynamic, so that formicar says what is wrong with a value of another type.
    return ParameterDescriptor(
        description=about, additional_constraints=constraints, dynamic_typing=True
    )
