"""The bee colony with an objective of Python's."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from formicar import Choice, ConfigError, Integer, Real, tune

SPACE = {"x": (-5.0, 5.0), "n": (1, 9), "word": ["a", "b", "c"], "scale": Real(1e-3, 1e3, log=True)}


def cost(values: dict[str, Any]) -> float:
    off = {"a": 2.0, "b": 0.0, "c": 1.0}[values["word"]]
    return float((values["x"] - 1) ** 2 + abs(values["n"] - 4) + off + abs(values["scale"] - 1))


def test_the_best_values_are_found_and_have_their_types() -> None:
    found = tune(cost, SPACE, seed=3, max_evaluations=3000)
    assert found.best["word"] == "b" and found.best["n"] == 4
    assert isinstance(found.best["n"], int) and isinstance(found.best["x"], float)
    assert found.cost == cost(found.best) < 0.2
    assert found.n_evaluations == 3000 == found.history["n_evaluations"][-1]
    assert (found.history["best_cost"][1:] <= found.history["best_cost"][:-1]).all()


def test_the_same_seed_asks_the_same_on_any_number_of_threads() -> None:
    asked: list[list[dict[str, Any]]] = [[], []]

    def noted(i: int) -> Callable[[dict[str, Any]], float]:
        def note(values: dict[str, Any]) -> float:
            asked[i].append(values)
            return cost(values)

        return note

    one = tune(noted(0), SPACE, seed=3, max_evaluations=200)
    with ThreadPoolExecutor(3) as pool:
        other = tune(noted(1), SPACE, seed=3, max_evaluations=200, map=pool.map)
    assert one.best == other.best and (one.history == other.history).all()
    key = str
    assert sorted(asked[0], key=key) == sorted(asked[1], key=key)
    assert tune(cost, SPACE, seed=4, max_evaluations=200).best != one.best


def test_known_values_are_where_it_begins() -> None:
    known = {"x": 1.0, "n": 4, "word": "b", "scale": 1.0}
    found = tune(cost, SPACE, known=[known], max_evaluations=20)
    assert found.cost == pytest.approx(0.0, abs=1e-9)


def test_progress_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    tune(cost, SPACE, max_evaluations=50, progress=True)
    assert "50/50" in capsys.readouterr().err


def test_costs_that_are_no_numbers_are_the_worst_and_errors_come_through() -> None:
    found = tune(lambda v: float("nan") if v["n"] != 2 else 1.0, {"n": (1, 3)}, max_evaluations=60)
    assert found.best == {"n": 2}
    with pytest.raises(ZeroDivisionError):
        tune(lambda v: 1 / 0, {"n": (1, 3)})
    with pytest.raises(TypeError):
        tune(lambda v: None, {"n": (1, 3)})  # type: ignore[arg-type, return-value]


@pytest.mark.parametrize(
    ("space", "settings", "told"),
    [
        ({}, {}, "at least 1"),
        ({"x": (1.0, 1.0)}, {}, "high of x"),
        ({"x": Real(0.0, 1.0, log=True)}, {}, "low of x"),
        ({"x": Integer(0, 4, log=True)}, {}, "low of x"),
        ({"x": Choice(["a"])}, {}, "at least 2"),
        ({"x": "wide"}, {}, "pair of numbers"),
        ({"x": (0.0, float("inf"))}, {}, "not finite"),
        ({"x": (0, 1)}, {"n_sources": 2}, "n_sources = 2"),
        ({"x": (0, 1)}, {"max_evaluations": 3}, "max_evaluations = 3"),
        ({"x": (0, 1)}, {"variant": "fast"}, "variant"),
        ({"x": (0, 1)}, {"seed": -1}, "seed = -1"),
        ({"x": (0, 1)}, {"known": [{"y": 1}]}, "one for each"),
        ({"x": ["a", "b"]}, {"known": [{"x": "z"}]}, "none of"),
    ],
)
def test_spaces_and_settings_that_cannot_be_are_refused(
    space: dict[str, Any], settings: dict[str, Any], told: str
) -> None:
    with pytest.raises(ConfigError, match=told):
        tune(lambda v: 0.0, space, **settings)
