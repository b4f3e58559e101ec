"""Certified path planning for car-like robots on occupancy grids.

A robot with a steering axle cannot turn on the spot, and its body scrapes corners. Given a map, a
vehicle and two poses, `Planner.plan` returns a path that the vehicle can drive, with a certificate
that says so, or a named reason why there is none.

Lengths are meters and angles radians throughout. A pose is ``(x, y, heading)`` of the center of the
rear axle, x forward, y left, the heading counter-clockwise from the x axis.

Examples
--------
>>> import numpy as np
>>> import formicar
>>> walls = np.zeros((80, 120), dtype=bool)
>>> walls[:50, 60] = True
>>> hall = formicar.OccupancyGrid(walls, resolution=0.1)
>>> planner = formicar.Planner(hall, formicar.Vehicle.preset("warehouse_amr"))
>>> plan = planner.plan(start=(2.0, 2.0, 0.0), goal=(10.0, 2.0, 0.0), seed=7)
>>> bool(plan), plan.certificate.min_clearance_m > 0
(True, True)
>>> plan.xy.shape[1]
2
"""

from __future__ import annotations

from ._curves import Curve, Dubins, ReedsShepp
from ._formicar import (
    ConfigError,
    InvalidLog,
    InvalidMap,
    InvalidObstacle,
    InvalidPath,
    InvalidRequest,
    InvalidVehicle,
    __version__,
)
from ._map import OccupancyGrid, builtin_maps
from ._motion import MotionPlan, plan_motion, track_in_time
from ._moving import MovingObstacle, Predictions
from ._paths import Check, check, metrics
from ._plan import AntFrame, History, NoPath, Plan
from ._planner import Planner, parameters, planners
from ._records import (
    Certificate,
    Disconnected,
    Explanation,
    Gap,
    Metrics,
    Nearest,
    TimedCertificate,
    TimedViolation,
    Timing,
    Violation,
)
from ._scenarios import Scenario, load_scenarios
from ._track import Tracking, track
from ._tune import Choice, Integer, Real, Tuning, tune
from ._vehicle import Vehicle

__all__ = [
    "AntFrame",
    "Certificate",
    "Check",
    "Choice",
    "ConfigError",
    "Curve",
    "Disconnected",
    "Dubins",
    "Explanation",
    "Gap",
    "History",
    "Integer",
    "InvalidLog",
    "InvalidMap",
    "InvalidObstacle",
    "InvalidPath",
    "InvalidRequest",
    "InvalidVehicle",
    "Metrics",
    "MotionPlan",
    "MovingObstacle",
    "Nearest",
    "NoPath",
    "OccupancyGrid",
    "Plan",
    "Planner",
    "Predictions",
    "Real",
    "ReedsShepp",
    "Scenario",
    "TimedCertificate",
    "TimedViolation",
    "Timing",
    "Tracking",
    "Tuning",
    "Vehicle",
    "Violation",
    "__version__",
    "builtin_maps",
    "check",
    "load_scenarios",
    "metrics",
    "parameters",
    "plan_motion",
    "planners",
    "track",
    "track_in_time",
    "tune",
]
