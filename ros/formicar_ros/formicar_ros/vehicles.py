"""The vehicle from parameters: a preset, measures, a file, or a footprint as Nav2 writes it."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

import formicar

# Measures that are single numbers, and what they are.
MEASURES = {
    "wheelbase_m": "Distance between the axles, meters",
    "width_m": "Width of the body, meters",
    "front_overhang_m": "From the front axle to the front, meters",
    "rear_overhang_m": "From the rear axle to the rear, meters",
    "max_steer_rad": "Largest angle of the virtual middle front wheel, radians",
    "max_steer_deg": "Largest angle of the virtual middle front wheel, degrees",
    "min_turning_radius_m": "Smallest turning radius of the rear axle's center, meters",
    "track_width_m": "Distance between the wheels of an axle, meters",
    "safety_margin_m": "What is kept free around the body, meters",
    "max_steer_rate_rad_per_s": "Largest steering rate, radians per second",
    "speed_mps": "Speed, meters per second",
    "max_acceleration_mps2": "Largest acceleration, meters per second squared",
}


def corners_of(footprint: str) -> list[list[float]]:
    """Return the corners of a footprint as Nav2 writes it: ``"[[x, y], [x, y], ...]"``.

    Raises
    ------
    formicar.InvalidVehicle
        Another text.
    """
    try:
        return [[float(x), float(y)] for x, y in ast.literal_eval(footprint)]
    except (ValueError, TypeError, SyntaxError):
        raise formicar.InvalidVehicle(
            f"footprint = {footprint!r}; expected corners in meters around the rear axle; hint: "
            '"[[0.5, 0.3], [0.5, -0.3], [-0.2, -0.3], [-0.2, 0.3]]"'
        ) from None


def vehicle_of(values: Mapping[str, Any]) -> formicar.Vehicle:
    """Return the vehicle that the parameters describe.

    Raises
    ------
    formicar.InvalidVehicle
        No description, several, or one that is no vehicle.
    """
    measures = {
        name: values[f"vehicle.{name}"]
        for name in MEASURES
        if values.get(f"vehicle.{name}") is not None
    }
    ways = [
        ("vehicle.preset", bool(values.get("vehicle.preset"))),
        ("vehicle.file", bool(values.get("vehicle.file"))),
        ("footprint", bool(values.get("footprint"))),
        ("vehicle's measures", "width_m" in measures or "wheelbase_m" in measures),
    ]
    given = [name for name, is_given in ways if is_given]
    if len(given) != 1:
        found = f"both {' and '.join(given)} are given" if given else "nothing says which it is"
        raise formicar.InvalidVehicle(
            f"vehicle: {found}; hint: set one of vehicle.preset, vehicle.file, the vehicle.* "
            "measures, or footprint with minimum_turning_radius"
        )
    return _padded(_described(given[0], values, measures), values)


def _described(way: str, values: Mapping[str, Any], measures: dict[str, Any]) -> formicar.Vehicle:
    if way == "vehicle.preset":
        _refuse_rest(way, measures)
        return formicar.Vehicle.preset(values["vehicle.preset"])
    if way == "vehicle.file":
        _refuse_rest(way, measures)
        try:
            return formicar.Vehicle.load(values["vehicle.file"])
        except OSError as error:
            raise formicar.InvalidVehicle(f"vehicle.file: {error}") from None
    if way == "footprint":
        return _of_footprint(values, measures)
    return formicar.Vehicle(**measures)


def _of_footprint(values: Mapping[str, Any], measures: dict[str, Any]) -> formicar.Vehicle:
    corners = corners_of(values["footprint"])
    radius = values.get("minimum_turning_radius") or 0.0
    if radius:
        measures = {**measures, "min_turning_radius_m": radius}
    if not any(
        name in measures for name in ("min_turning_radius_m", "max_steer_rad", "max_steer_deg")
    ):
        raise formicar.InvalidVehicle(
            "footprint is given without a turning radius; hint: set minimum_turning_radius in "
            "meters"
        )
    return formicar.Vehicle(footprint=corners, **measures)


def _refuse_rest(way: str, measures: Mapping[str, Any]) -> None:
    if measures:
        raise formicar.InvalidVehicle(
            f"vehicle: {way} is given, and vehicle.{next(iter(measures))} besides; hint: leave one "
            "of them out"
        )


def _padded(vehicle: formicar.Vehicle, values: Mapping[str, Any]) -> formicar.Vehicle:
    padding = values.get("footprint_padding") or 0.0
    return vehicle.with_margin(padding) if padding else vehicle
