"""Documents as objects: what a plan, a judged path and a simulated drive say of themselves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, TypeVar

Record = TypeVar("Record", bound="tuple[Any, ...]")
Pose = tuple[float, float, float]


def record_of(kind: type[Record], document: Mapping[str, Any]) -> Record:
    """Make a record from a document whose keys are its fields; a key left out is ``None``."""
    made: Record = kind._make(document.get(name) for name in kind._fields)  # type: ignore[attr-defined]
    return made


def pose_of(document: Mapping[str, float]) -> Pose:
    """Return ``(x, y, heading)`` of a pose in a document."""
    return (document["x"], document["y"], document["heading"])


class Violation(NamedTuple):
    """A violation on a path.

    Attributes
    ----------
    kind : str
        ``collision``, ``leaves_map``, ``curvature``, ``curvature_change``, ``discontinuity``,
        ``start``, ``goal``, ``via``, ``gear`` or ``malformed``.
    s_m : float
        Arc length where it is worst, meters.
    pose : tuple of float
        ``(x, y, heading)`` there, meters and radians.
    amount, limit : float
        The value found and the value allowed, in the unit of the limit.
    message : str
        Both as a sentence with units.
    """

    kind: str
    s_m: float
    pose: Pose
    amount: float
    limit: float
    message: str


class Certificate(NamedTuple):
    """The judge's findings on a path.

    Attributes
    ----------
    valid : bool
        True if nothing was violated.
    min_clearance_m : float
        Least distance from the footprint, with its safety margin, to an occupied cell or the
        border of the map along the whole swept path, meters.
    tightest : tuple of float
        ``(x, y, heading)`` where the clearance is least, meters and radians.
    tightest_s_m : float
        Arc length there, meters.
    max_curvature_per_m : float
        Largest absolute curvature, 1/m.
    max_curvature_rate_per_m2 : float
        Fastest change of curvature along a segment, 1/m².
    is_curvature_continuous : bool
        True if the curvature jumps nowhere inside one gear.
    goal_index : int or None
        The goal that was reached, counted from 0; ``None`` where none was given.
    goal_error_m, goal_error_rad : float
        Distance and heading difference of the last pose from that goal, meters and radians.
    via_s_m : tuple of float
        Arc length at which each via point is passed, meters.
    violations : tuple of Violation
        The violations in order of arc length; empty where the path is valid.
    assumptions : tuple of str
        Doubts about the map file that the findings take at its word.
    map_hash, vehicle_hash, path_hash : str
        Hashes of what was judged, 32 hexadecimal digits.
    """

    valid: bool
    min_clearance_m: float
    tightest: Pose
    tightest_s_m: float
    max_curvature_per_m: float
    max_curvature_rate_per_m2: float
    is_curvature_continuous: bool
    goal_index: int | None
    goal_error_m: float
    goal_error_rad: float
    via_s_m: tuple[float, ...]
    violations: tuple[Violation, ...]
    assumptions: tuple[str, ...]
    map_hash: str
    vehicle_hash: str
    path_hash: str


def certificate_of(document: Mapping[str, Any]) -> Certificate:
    """Make a certificate from its document."""
    violations = (violation_of(violation) for violation in document["violations"])
    return record_of(
        Certificate,
        {
            **document,
            "tightest": pose_of(document["tightest"]),
            "via_s_m": tuple(document["via_s_m"]),
            "violations": tuple(violations),
            "assumptions": tuple(document.get("assumptions", ())),
        },
    )


def violation_of(document: Mapping[str, Any]) -> Violation:
    """Make a violation from its document."""
    return record_of(Violation, {**document, "pose": pose_of(document["pose"])})


class TimedViolation(NamedTuple):
    """A violation during a drive.

    Attributes
    ----------
    kind : str
        ``distance``, ``speed``, ``acceleration``, ``lateral``, ``steer_rate``, ``jerk``, ``cusp``,
        ``discontinuity`` or ``malformed``.
    t_s : float
        Time where it is worst, or where it was found, seconds.
    s_m : float
        Arc length there, meters.
    pose : tuple of float
        ``(x, y, heading)`` of the vehicle there, meters and radians.
    amount, limit : float
        The value found and the value allowed, in the unit of the limit.
    message : str
        Both as a sentence with units.
    """

    kind: str
    t_s: float
    s_m: float
    pose: Pose
    amount: float
    limit: float
    message: str


class Nearest(NamedTuple):
    """The moment at which a vehicle comes nearest to a moving obstacle.

    Attributes
    ----------
    obstacle : str
        The obstacle's name, or its number counted from 1.
    t_s : float
        Time, seconds.
    s_m : float
        Arc length, meters.
    pose : tuple of float
        ``(x, y, heading)`` of the vehicle, meters and radians.
    distance_m : float
        The distance, meters; negative where they overlap.
    """

    obstacle: str
    t_s: float
    s_m: float
    pose: Pose
    distance_m: float


class TimedCertificate(NamedTuple):
    """The judge's findings on a drive in time: true where nothing was violated.

    Attributes
    ----------
    valid : bool
        True if nothing was violated.
    arrives : bool
        True if the drive ends at the end of the path.
    duration_s, horizon_s : float
        Time of the drive, and time up to which obstacles are predicted, seconds.
    distance_m : float
        The distance that was to be kept, meters.
    min_distance_m : float or None
        Proven least distance of the body, with its safety margin, from every obstacle, with its
        uncertainty, over drive and horizon, meters; ``None`` without obstacles.
    nearest : Nearest or None
        Where and when the body comes nearest; ``None`` without obstacles.
    max_speed_mps : float
        Highest speed, m/s.
    max_acceleration_mps2, max_braking_mps2, max_lateral_mps2 : float
        Largest acceleration, deceleration and lateral acceleration, m/s².
    max_steer_rate_rad_per_s : float or None
        Fastest change of the steering angle while driving, rad/s; ``None`` where the wheelbase is
        not known.
    max_jerk_mps3 : float
        Largest jerk within a phase, m/s³.
    violations : tuple of TimedViolation
        The violations in order of time; empty where the drive is valid.
    """

    valid: bool
    arrives: bool
    duration_s: float
    horizon_s: float
    distance_m: float
    min_distance_m: float | None
    nearest: Nearest | None
    max_speed_mps: float
    max_acceleration_mps2: float
    max_braking_mps2: float
    max_lateral_mps2: float
    max_steer_rate_rad_per_s: float | None
    max_jerk_mps3: float
    violations: tuple[TimedViolation, ...]

    def __bool__(self) -> bool:
        return self.valid


def timed_certificate_of(document: Mapping[str, Any]) -> TimedCertificate:
    """Make a certificate in time from its document."""
    nearest = document.get("nearest")
    violations = (
        record_of(TimedViolation, {**violation, "pose": pose_of(violation["pose"])})
        for violation in document["violations"]
    )
    return record_of(
        TimedCertificate,
        {
            **document,
            "nearest": nearest
            and record_of(Nearest, {**nearest, "pose": pose_of(nearest["pose"])}),
            "violations": tuple(violations),
        },
    )


class Metrics(NamedTuple):
    """Exact metrics of a path, computed from its segments.

    Attributes
    ----------
    length_m, reverse_length_m : float
        Driven length, and that driven in reverse, meters.
    max_curvature_per_m, mean_abs_curvature_per_m : float
        Largest and mean absolute curvature, 1/m.
    total_turning_rad : float
        Integral of the absolute curvature, with the angles of corners, radians.
    aol_rad_per_m : float
        Total turning per meter, rad/m.
    max_curvature_rate_per_m2 : float
        Fastest change of curvature along a segment, 1/m².
    n_curvature_jumps : int
        Joints where the curvature jumps while the vehicle moves on in the same gear.
    n_cusps : int
        Switches of direction.
    min_clearance_m, mean_clearance_m : float or None
        Least and mean clearance, meters; ``None`` without a map.
    max_steer_rad : float or None
        Largest angle of the virtual middle front wheel, radians; ``None`` where the wheelbase is
        not known.
    travel_time_s : float or None
        Time of the fastest drive, seconds; ``None`` where the vehicle has no speed.
    steering_share : dict of str to float
        Share of the path steered by up to 5, 5 to 10 and over 10 degrees per step of 0.2 m.
    goal_error_m, goal_error_rad : float
        Distance and heading difference of the last pose from the goal, meters and radians.
    compatible : dict of str to float, or None
        The metrics of other tools under their names; ``None`` where they were not asked for.
    """

    length_m: float
    reverse_length_m: float
    max_curvature_per_m: float
    mean_abs_curvature_per_m: float
    total_turning_rad: float
    aol_rad_per_m: float
    max_curvature_rate_per_m2: float
    n_curvature_jumps: int
    n_cusps: int
    min_clearance_m: float | None
    mean_clearance_m: float | None
    max_steer_rad: float | None
    travel_time_s: float | None
    steering_share: dict[str, float]
    goal_error_m: float
    goal_error_rad: float
    compatible: dict[str, float] | None = None


class Gap(NamedTuple):
    """The narrowest place on the widest way from start to goal.

    Attributes
    ----------
    x, y : float
        Its middle, meters.
    gap_m : float
        Its width, to about a cell, meters.
    vehicle_width_m : float
        The vehicle's width, meters.
    """

    x: float
    y: float
    gap_m: float
    vehicle_width_m: float


class Disconnected(NamedTuple):
    """Start and goal in parts of the map that are not connected for the vehicle's rear axle.

    Attributes
    ----------
    disc_radius_m : float
        What the axle's center keeps from obstacles at least, meters.
    n_cells_at_start, n_cells_at_goal : int
        Cells of the two parts.
    """

    disc_radius_m: float
    n_cells_at_start: int
    n_cells_at_goal: int


class Explanation(NamedTuple):
    """Why there is no path, in places and measures, as far as it is known.

    Attributes
    ----------
    leg : int or None
        The leg that failed, counted from 1; ``None`` without via points.
    disconnected : Disconnected or None
        Parts of the map that are not connected.
    gap : Gap or None
        The narrowest place on the widest way.
    """

    leg: int | None
    disconnected: Disconnected | None
    gap: Gap | None


def explanation_of(document: Mapping[str, Any]) -> Explanation:
    """Make an explanation from its document."""
    apart, gap = document["disconnected"], document["gap"]
    return Explanation(
        leg=document["leg"],
        disconnected=record_of(Disconnected, apart) if apart else None,
        gap=record_of(Gap, gap) if gap else None,
    )


class Timing(NamedTuple):
    """Times of a query in seconds.

    Attributes
    ----------
    map_setup_s : float
        Preparing the map, once per map and vehicle.
    first_feasible_s : float or None
        From the beginning of the query to its first certified path.
    query_s : float
        The query.
    total_s : float
        Both together.
    """

    map_setup_s: float
    first_feasible_s: float | None
    query_s: float
    total_s: float
