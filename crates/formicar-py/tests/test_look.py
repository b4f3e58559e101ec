"""How things show themselves: in notebooks, with matplotlib, as data frames."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest

import formicar
from formicar import OccupancyGrid, Plan, Planner

mpl.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).parents[1]


def test_maps_vehicles_plans_and_drives_draw_themselves(plan: Plan, colony: Plan) -> None:
    drawn = [
        plan.map._repr_svg_(),
        plan.vehicle._repr_svg_(),
        formicar.Vehicle.preset("point")._repr_svg_(),
        formicar.track(plan)._repr_svg_(),
        colony.to_svg(ants=True),
    ]
    for svg in drawn:
        assert ElementTree.fromstring(svg).tag.endswith("svg")
    page = plan._repr_html_()
    assert plan.metrics and plan.certificate
    assert f"{plan.metrics.length_m:.2f} m" in page and "<svg" in page
    assert plan.certificate.path_hash in page
    with pytest.raises(ValueError, match="keep_ants"):
        plan.to_svg(ants=True)


def test_a_plan_without_a_path_shows_the_reason(planner: Planner) -> None:
    cut = planner.plan((2.0, 2.0, 0.0), (10.0, 2.0, 0.0), budget=2)
    assert "budget_exhausted" in cut._repr_html_() and "<svg" in cut._repr_html_()
    ax = cut.plot()
    assert "budget_exhausted" in ax.get_title()
    with pytest.raises(formicar.InvalidPath, match="no path"):
        cut.animate()
    plt.close("all")


def test_a_plot_has_the_map_in_world_coordinates(plan: Plan) -> None:
    ax = plan.plot()
    assert ax.get_xlim() == (0.0, 12.0) and ax.get_ylim() == (0.0, 8.0)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]  # type: ignore[union-attr]
    assert labels == ["forward"]
    line = next(line for line in ax.lines if line.get_label() == "forward")
    np.testing.assert_array_equal(line.get_xdata(), plan.poses["x"])
    figure, own = plt.subplots()
    assert plan.plot(own) is own
    turned = OccupancyGrid([[0, 100], [-1, 50]], 1.0, (5.0, 1.0, np.pi / 2)).plot()
    assert turned.get_xlim() == pytest.approx((3.0, 5.0))
    assert turned.get_ylim() == pytest.approx((1.0, 3.0))
    body = plan.vehicle.plot((1.0, 2.0, 0.3))
    assert body.get_xlabel() == "x [m]"
    figure.canvas.draw()
    plt.close("all")


def test_an_animation_moves_the_body(plan: Plan) -> None:
    animation = plan.animate(interval_ms=10)
    body = animation._func(3)[0]  # type: ignore[attr-defined]
    middle = body.get_xy()[:-1].mean(axis=0)
    assert np.hypot(*(middle - plan.xy[3])) < plan.vehicle.length
    animation._draw_was_started = True  # type: ignore[attr-defined]
    plt.close("all")


def test_a_data_frame_has_the_poses_as_columns(plan: Plan) -> None:
    frame = plan.to_dataframe()
    assert type(frame).__module__.startswith("pandas")
    assert list(frame.columns) == list(plan.poses.dtype.names or ())
    np.testing.assert_array_equal(frame["x"], plan.poses["x"])


def test_packages_that_are_not_there_are_named(plan: Plan, monkeypatch: pytest.MonkeyPatch) -> None:
    polars = ModuleType("polars")
    polars.DataFrame = dict  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "polars", polars)
    columns = plan.to_dataframe("polars")
    np.testing.assert_array_equal(columns["heading"], plan.poses["heading"])
    with pytest.raises(ValueError, match="backend"):
        plan.to_dataframe("excel")  # type: ignore[arg-type]
    monkeypatch.setitem(sys.modules, "pandas", None)
    assert isinstance(plan.to_dataframe(), dict)
    monkeypatch.setitem(sys.modules, "polars", None)
    with pytest.raises(ImportError, match="pip install pandas"):
        plan.to_dataframe()
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match="pip install matplotlib"):
        plan.plot()
