"""Turns the parameters of SmacPlannerHybrid into those of formicar's planner server.

    python -m formicar_ros.migrate nav2_params.yaml --out formicar_params.yaml

Reads a file of Nav2 parameters, writes the section `planner_server`, and says of every key what has
become of it. Exit codes: 0 written, 2 a file that cannot be read or has no SmacPlannerHybrid.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from .parameters import node_declarations

SMAC = ("nav2_smac_planner::SmacPlannerHybrid", "nav2_smac_planner/SmacPlannerHybrid")

# Keys that keep their meaning: Smac's name, and ours.
_SAME = {
    "tolerance": "tolerance",
    "allow_unknown": "allow_unknown",
    "max_planning_time": "max_planning_time",
    "angle_quantization_bins": "hybrid_astar.angle_quantization_bins",
    "change_penalty": "hybrid_astar.change_penalty",
    "non_straight_penalty": "hybrid_astar.non_straight_penalty",
    "reverse_penalty": "cost.reverse_factor",
}

# Words that have other names: Smac's key, ours, and the words.
_WORDS = {
    "motion_model_for_search": ("motion", {"DUBIN": "forward", "REEDS_SHEPP": "reverse"}),
    "goal_heading_mode": (
        "goal_heading",
        {"DEFAULT": "exact", "BIDIRECTIONAL": "bidirectional", "ALL_DIRECTION": "any"},
    ),
}

# Keys without a counterpart, and why.
_CLEARANCE = "clearance has weights of its own, in widths of the body: cost.clearance_weight"
_EXACT = "the swept body is checked exactly on the map's own cells"
_SMOOTH = "paths are improved with the exact body; there is no smoother behind"
_CURVES = "analytic curves are tried wherever they may end the search"
_GONE = {
    "cost_penalty": _CLEARANCE,
    "use_quadratic_cost_penalty": _CLEARANCE,
    "retrospective_penalty": "the search needs no bias towards the end of the path",
    "downsample_costmap": _EXACT,
    "downsampling_factor": _EXACT,
    "smooth_path": _SMOOTH,
    "smoother": _SMOOTH,
    "analytic_expansion_ratio": _CURVES,
    "analytic_expansion_max_length": _CURVES,
    "analytic_expansion_max_cost": _CURVES,
    "analytic_expansion_max_cost_override": _CURVES,
    "lookup_table_size": "distances without obstacles are computed when they are needed",
    "cache_obstacle_heuristic": "the goal field is kept as long as the goal stays",
    "allow_primitive_interpolation": "steps are hybrid_astar.step_radii long",
    "max_on_approach_iterations": "tolerance is room for the planner from the beginning",
    "terminal_checking_interval": "a query can be canceled within milliseconds",
    "coarse_search_resolution": "all goal headings are searched at once",
    "debug_visualizations": "plan_markers shows the swept ground and the tightest place",
    "viz_expansions": "plan_markers shows the swept ground and the tightest place",
}
_HANDLED = ("plugin", "max_iterations", "minimum_turning_radius")

# Keys of the server and of its costmap that have the same names here.
_SERVER = (
    "expected_planner_frequency",
    "costmap_update_timeout",
    "action_server_result_timeout",
    "bond_heartbeat_period",
    "use_sim_time",
)
_COSTMAP = (
    "global_frame",
    "robot_base_frame",
    "transform_tolerance",
    "footprint",
    "footprint_padding",
)

# The most steps that hybrid A* takes; Smac calls it -1.
_UNLIMITED = 1_000_000_000


class Unreadable(ValueError):
    """A file that cannot be migrated."""


@dataclass
class Migration:
    """New parameters, and what has become of the old ones."""

    parameters: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def migrated(document: Mapping[str, Any]) -> Migration:
    """Return the parameters of our server for those of a Nav2 system.

    Raises
    ------
    Unreadable
        No planner server with a SmacPlannerHybrid.
    """
    server = _parameters(document, "planner_server")
    costmap = _parameters(document, "global_costmap", "global_costmap")
    plugins = [
        name
        for name in server.get("planner_plugins", [])
        if _table(server.get(name)).get("plugin") in SMAC
    ]
    if not plugins:
        raise Unreadable(
            "no SmacPlannerHybrid among planner_plugins of planner_server; hint: other planners "
            "have no counterpart of their parameters"
        )
    done = Migration()
    done.parameters = {name: server[name] for name in _SERVER if name in server}
    done.parameters["planner_plugins"] = plugins
    _note_rest_of_server(server, plugins, done)
    _take_costmap(costmap, done)
    for plugin in plugins:
        done.parameters[plugin] = _nested(_planner_of(plugin, server[plugin], done))
    _take_radius(server, plugins, done)
    return done


def _take_costmap(costmap: Mapping[str, Any], done: Migration) -> None:
    done.parameters |= {name: costmap[name] for name in _COSTMAP if name in costmap}
    if "footprint" not in costmap:
        radius = costmap.get("robot_radius")
        told = f"robot_radius = {radius} is a disc" if radius else "there is no footprint"
        done.notes.append(f"global_costmap: {told}; set footprint, vehicle.preset or vehicle.file")


def _take_radius(server: Mapping[str, Any], plugins: list[str], done: Migration) -> None:
    """Take the turning radius, which is the vehicle's here, and one for all planners."""
    radii = {server[plugin].get("minimum_turning_radius", 0.4) for plugin in plugins}
    done.parameters["minimum_turning_radius"] = max(radii)
    if len(radii) > 1:
        done.notes.append(f"minimum_turning_radius: of {sorted(radii)}, the largest is taken")


def _planner_of(plugin: str, table: Mapping[str, Any], done: Migration) -> dict[str, Any]:
    flat: dict[str, Any] = {"planner": "formicar"}
    for key, value in table.items():
        if key in _SAME:
            flat[_SAME[key]] = value
        elif key in _WORDS:
            flat |= dict(_reworded(f"{plugin}.{key}", key, value, done))
        elif key == "max_iterations":
            flat["hybrid_astar.max_iterations"] = _UNLIMITED if value <= 0 else value
        elif key in _GONE:
            done.notes.append(f"{plugin}.{key}: left out; {_GONE[key]}")
        elif key not in _HANDLED:
            done.notes.append(f"{plugin}.{key}: unknown; it is left out")
    return flat


def _reworded(name: str, key: str, value: Any, done: Migration) -> Iterator[tuple[str, str]]:
    ours, words = _WORDS[key]
    word = words.get(str(value).upper())
    if word is None:
        done.notes.append(f"{name} = {value!r}: unknown; it is left out")
    else:
        yield ours, word


def _note_rest_of_server(server: Mapping[str, Any], plugins: list[str], done: Migration) -> None:
    known = {*_SERVER, "planner_plugins", *(name for name, _, _ in node_declarations())}
    for name, value in server.items():
        if name in plugins or name in known:
            continue
        kind = _table(value).get("plugin")
        told = f"its plugin {kind} stays with Nav2" if kind else "unknown"
        done.notes.append(f"planner_server.{name}: {told}; it is left out")


def _parameters(document: Mapping[str, Any], *names: str) -> Mapping[str, Any]:
    table: Any = document
    for name in (*names, "ros__parameters"):
        table = _table(table).get(name, {})
    return _table(table)


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _nested(flat: Mapping[str, Any]) -> dict[str, Any]:
    nested: dict[str, Any] = {}
    for key, value in flat.items():
        *sections, name = key.split(".")
        table = nested
        for section in sections:
            table = table.setdefault(section, {})
        table[name] = value
    return nested


def text_of(done: Migration) -> str:
    """Return the new file."""
    document = {"planner_server": {"ros__parameters": done.parameters}}
    return str(yaml.safe_dump(document, sort_keys=False))


def _read(path: Path) -> Mapping[str, Any]:
    try:
        return _table(yaml.safe_load(path.read_text(encoding="utf-8")))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise Unreadable(f"{path}: {error}") from None


def main(arguments: list[str] | None = None) -> int:
    """Migrate a file, and return the exit code."""
    parser = argparse.ArgumentParser(prog="formicar_ros.migrate", description=__doc__)
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("parameters", type=Path, help="a file of Nav2 parameters")
    parser.add_argument("--out", type=Path, help="where to write; by default to standard output")
    given = parser.parse_args(arguments)
    try:
        done = migrated(_read(given.parameters))
    except Unreadable as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for note in done.notes:
        print(f"note: {note}", file=sys.stderr)
    if given.out is None:
        print(text_of(done), end="")
    else:
        given.out.write_text(text_of(done), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
