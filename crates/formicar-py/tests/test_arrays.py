"""Property tests: arrays of any kind make a map, a path, a plan, or an exception with words."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import formicar
from formicar import OccupancyGrid, Plan, Planner

REFUSED = (ValueError, TypeError)

any_dtype = st.one_of(
    arrays.scalar_dtypes(),
    st.sampled_from([np.dtype("O"), np.dtype([("a", "i1")]), np.dtype("S3")]),
)
any_shape = arrays.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=7)
any_array = any_dtype.flatmap(
    lambda dtype: arrays.arrays(
        dtype, any_shape, elements=None if dtype.kind != "O" else st.just(None)
    )
)


@st.composite
def views(draw: Any, source: Any) -> Any:
    """Return an array in another order, with strides of either sign, or as a list."""
    array = draw(source)
    if array.ndim == 2:
        step = st.sampled_from([1, -1, 2, -2])
        array = array[:: draw(step), :: draw(step)]
    how = draw(st.sampled_from(["as it is", "fortran", "transposed", "list", "read-only"]))
    if how == "fortran":
        return np.asfortranarray(array)
    if how == "transposed":
        return array.T
    if how == "list":
        return array.tolist()
    if how == "read-only":
        array = array.copy()
        array.flags.writeable = False
    return array


@given(views(any_array), st.floats(), st.sampled_from(["occupancy", "costmap", "grey"]))
def test_any_array_is_a_map_or_refused(data: Any, resolution: float, values: Any) -> None:
    try:
        grid = OccupancyGrid(data, resolution, values=values)
    except REFUSED as error:
        assert str(error)
        return
    assert grid.shape == np.asarray(data).shape
    assert ((grid.data >= -1) & (grid.data <= 100)).all()


numbers = arrays.arrays(
    st.sampled_from(["i1", "i2", "i4", "i8"]),
    arrays.array_shapes(min_dims=2, max_dims=2, max_side=9),
    elements=st.integers(-1, 100),
)


@given(views(numbers))
def test_values_come_back_as_they_went_in(data: Any) -> None:
    array = np.asarray(data)
    if (array == 1).any() and np.isin(array, (0, 1)).all():
        return
    assert (OccupancyGrid(data, 1.0).data == array).all()
    assert (OccupancyGrid(data, 1.0, row0="top").data == array[::-1]).all()


@given(views(arrays.arrays("?", arrays.array_shapes(min_dims=2, max_dims=2, max_side=9))))
def test_flags_are_occupied_where_true(data: Any) -> None:
    assert (OccupancyGrid(data, 1.0).data == 100 * np.asarray(data)).all()


rows = arrays.arrays(
    st.sampled_from(["f2", "f4", "f8", ">f8", "i4", "c8", "?"]),
    st.tuples(st.integers(0, 12), st.integers(0, 4)),
)


@given(views(rows))
def test_any_rows_are_a_path_or_refused(hall: OccupancyGrid, path: Any) -> None:
    try:
        judged = formicar.check(path, hall, "warehouse_amr")
        measured = formicar.metrics(path)
    except REFUSED as error:
        assert str(error)
        return
    assert judged.valid == (not judged.certificate.violations)
    assert measured.length_m >= 0


anything = st.one_of(
    st.none(),
    st.floats(),
    st.integers(),
    st.text(max_size=3),
    st.lists(st.one_of(st.floats(), st.integers(), st.text(max_size=2)), max_size=5),
    st.lists(st.lists(st.floats(-20, 20), max_size=4), max_size=4),
    arrays.arrays("f8", arrays.array_shapes(max_dims=2, max_side=4)),
    st.dictionaries(st.text(max_size=3), st.floats(), max_size=3),
)
poses = st.tuples(st.floats(-1, 13), st.floats(-1, 9), st.floats(-7, 7))


@given(
    st.one_of(poses, anything),
    st.one_of(poses, st.lists(poses, min_size=1, max_size=3), anything),
    st.fixed_dictionaries(
        {},
        optional={
            "seed": anything,
            "via": anything,
            "goal_tolerance": anything,
            "motion": anything,
            "goal_heading": anything,
            "keep_out": anything,
            "continuous_curvature": st.one_of(st.booleans(), st.floats()),
        },
    ),
)
def test_any_request_is_answered_or_refused(
    planner: Planner, start: Any, goal: Any, how: dict[str, Any]
) -> None:
    try:
        plan = planner.plan(start, goal, budget=300, **how)
    except REFUSED as error:
        assert str(error)
        return
    assert isinstance(plan, Plan)
    assert plan.reason is None if plan else plan.reason
    if plan:
        assert formicar.check(plan)


@given(st.dictionaries(st.text(max_size=8), anything, max_size=3))
def test_any_settings_are_taken_or_refused(hall: OccupancyGrid, settings: dict[str, Any]) -> None:
    try:
        Planner(hall, "warehouse_amr", settings)
    except REFUSED as error:
        assert str(error)


@given(st.lists(st.tuples(st.sampled_from(sorted(formicar.Vehicle.preset("sedan").measures)),
                          anything), max_size=3))  # fmt: skip
def test_any_measures_are_a_vehicle_or_refused(changes: list[tuple[str, Any]]) -> None:
    measures = {**formicar.Vehicle.preset("sedan").measures, **dict(changes)}
    try:
        vehicle = formicar.Vehicle(**measures)
    except REFUSED as error:
        assert str(error)
        return
    assert vehicle.min_turning_radius > 0
