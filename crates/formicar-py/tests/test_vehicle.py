"""Vehicles."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

from formicar import InvalidVehicle, Vehicle

VAN = {
    "wheelbase_m": 3.0,
    "width_m": 2.0,
    "front_overhang_m": 0.9,
    "rear_overhang_m": 1.1,
    "min_turning_radius_m": 6.0,
}


def test_presets_have_a_body_and_a_turning_radius() -> None:
    for name in Vehicle.presets():
        vehicle = Vehicle.preset(name)
        assert vehicle.name == name
        assert vehicle.is_point == (name == "point")
        if not vehicle.is_point:
            assert vehicle.min_turning_radius > 0 and vehicle.wheelbase
            assert vehicle.max_curvature == pytest.approx(1 / vehicle.min_turning_radius)
    assert repr(Vehicle.preset("point")) == "Vehicle(point)"


def test_measures_make_a_rectangle_around_the_rear_axle() -> None:
    van = Vehicle(**VAN)
    assert (van.length, van.width, van.wheelbase) == (5.0, 2.0, 3.0)
    assert van.footprint[:, 0].min() == -1.1 and van.footprint[:, 0].max() == 3.9
    assert van.max_steer == pytest.approx(np.arctan(0.5))
    assert van.measures == VAN
    assert van.with_margin(0.5).width == 3.0
    assert "margin 0.5 m" in repr(van.with_margin(0.5))
    with pytest.raises(ValueError, match="read-only"):
        van.footprint[0, 0] = 1.0


def test_a_footprint_may_be_an_array() -> None:
    corners = np.array([[-1.0, -0.5], [2.0, -0.5], [2.0, 0.5], [-1.0, 0.5]])
    cart = Vehicle(footprint=corners, min_turning_radius_m=np.float32(2.0))
    assert (cart.length, cart.width, cart.wheelbase, cart.max_steer) == (3.0, 1.0, None, None)


@pytest.mark.parametrize(
    ("measures", "told"),
    [
        ({"wheelbse_m": 3.0}, "hint: 'wheelbase_m'"),
        ({"wheelbase_m": -1.0}, "wheelbase_m = -1"),
        ({"width_m": float("nan")}, "width_m is not finite"),
        ({"width_m": "wide"}, "width_m"),
        ({"max_steer_deg": 80.0}, "disagree"),
        ({"footprint": [[0, 0], [1, 1]]}, "footprint"),
    ],
)
def test_what_is_no_vehicle_is_refused(measures: dict[str, object], told: str) -> None:
    with pytest.raises(InvalidVehicle, match=told):
        Vehicle(**{**VAN, **measures})


def test_missing_measures_are_named() -> None:
    with pytest.raises(InvalidVehicle, match="width_m is missing"):
        Vehicle(wheelbase_m=1.0, min_turning_radius_m=2.0, front_overhang_m=0.1,
                rear_overhang_m=0.1)  # fmt: skip
    with pytest.raises(InvalidVehicle, match="sedan"):
        Vehicle.preset("tank")
    with pytest.raises(InvalidVehicle, match="safety_margin_m"):
        Vehicle(**VAN).with_margin(-1.0)


def test_a_vehicle_file_is_read(tmp_path: Path) -> None:
    file = tmp_path / "van.toml"
    file.write_text("\n".join(f"{key} = {value}" for key, value in VAN.items()))
    assert Vehicle.load(file) == Vehicle(**VAN)
    (tmp_path / "bad.toml").write_text("wheelbase_m = -3\n")
    with pytest.raises(InvalidVehicle, match=r"bad\.toml"):
        Vehicle.load(tmp_path / "bad.toml")
    with pytest.raises(FileNotFoundError):
        Vehicle.load(tmp_path / "none.toml")
    with pytest.raises(InvalidVehicle, match="preset"):
        Vehicle.load("sedan")


def test_equal_vehicles_are_equal_also_from_elsewhere() -> None:
    for vehicle in (Vehicle(**VAN), Vehicle.preset("point"), Vehicle.preset("sedan")):
        other = pickle.loads(pickle.dumps(vehicle))
        assert other == vehicle and hash(other) == hash(vehicle)
        assert copy.deepcopy(vehicle) == vehicle and other.name == vehicle.name
    assert Vehicle(**VAN) != Vehicle.preset("sedan")
    assert (Vehicle(**VAN) == 3) is False
