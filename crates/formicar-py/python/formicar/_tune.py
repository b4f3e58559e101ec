"""Search for parameters of least cost."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _formicar
from ._arrays import frozen, whole_of
from ._formicar import ConfigError
from ._hints import suggests
from ._lazy import np

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Real(NamedTuple):
    """Numbers from `low` to `high`; with `log`, equal ratios are equally far."""

    low: float
    high: float
    log: bool = False

    def _kind(self) -> dict[str, Any]:
        kind = "log-real" if self.log else "real"
        return {"kind": kind, "low": float(self.low), "high": float(self.high)}

    def _value(self, number: float) -> float:
        return number

    def _number(self, value: Any) -> float:
        return float(value)


class Integer(NamedTuple):
    """Integers from `low` to `high`, both included; with `log`, equal ratios are equally far."""

    low: int
    high: int
    log: bool = False

    def _kind(self) -> dict[str, Any]:
        kind = "log-integer" if self.log else "integer"
        return {"kind": kind, "low": float(self.low), "high": float(self.high)}

    def _value(self, number: float) -> int:
        return int(number)

    def _number(self, value: Any) -> float:
        return float(value)


class Choice(NamedTuple):
    """One of some values."""

    values: Sequence[Any]

    def _kind(self) -> dict[str, Any]:
        return {"kind": "choice", "n_choices": len(self.values)}

    def _value(self, number: float) -> Any:
        return self.values[int(number)]

    def _number(self, value: Any) -> float:
        if value not in self.values:
            raise ConfigError(f"{value!r} is none of {list(self.values)!r}")
        return float(list(self.values).index(value))


class Tuning(NamedTuple):
    """The result of a search.

    Attributes
    ----------
    best : dict
        The values of least cost.
    cost : float
        Their cost.
    n_evaluations : int
        Evaluations of the objective.
    history : ndarray of void
        After each cycle: ``n_evaluations``, ``best_cost``, ``median_cost``, ``n_gains``,
        ``scouted``.
    """

    best: dict[str, Any]
    cost: float
    n_evaluations: int
    history: NDArray[np.void]


Dimension = Real | Integer | Choice
Evaluate = Callable[[list[dict[str, Any]]], Sequence[float]]


@suggests
def tune(
    objective: Callable[[dict[str, Any]], float],
    space: Mapping[str, Any],
    *,
    seed: int = 0,
    max_evaluations: int = 500,
    n_sources: int = 10,
    limit: int | None = None,
    variant: str = "variable-strategy",
    known: Sequence[Mapping[str, Any]] = (),
    map: Callable[..., Any] = map,
    progress: bool = False,
) -> Tuning:
    """Look for the parameters of least cost with an artificial bee colony.

    The same space, settings and seed ask for the same values in the same order.

    Parameters
    ----------
    objective : callable
        Gets a dict of values, returns their cost. A cost that is not finite counts as the worst.
    space : mapping
        For each name a `Real`, `Integer` or `Choice`; a pair of floats is a `Real`, a pair of ints
        an `Integer`, a list of anything else a `Choice`.
    seed : int, optional
        Seed of the search.
    max_evaluations : int, optional
        Evaluations after which it ends.
    n_sources : int, optional
        Food sources, and as many employed bees and onlookers; 4 to 10 000.
    limit : int, optional
        Trials without gain after which a source is abandoned.
    variant : {"variable-strategy", "basic"}, optional
        The rules by which bees search.
    known : sequence of mappings, optional
        Values that are known to be good, where the search begins.
    map : callable, optional
        Evaluates the candidates of a phase at once: the ``map`` of a process pool, for instance.
    progress : bool, optional
        Show a tqdm bar.

    Returns
    -------
    Tuning
        The best values.

    Raises
    ------
    ConfigError
        A space or a setting out of range.

    Examples
    --------
    >>> found = tune(lambda v: (v["x"] - 1) ** 2 + v["n"], {"x": (-5.0, 5.0), "n": (0, 9)}, seed=1)
    >>> found.best["n"], abs(found.best["x"] - 1) < 0.01
    (0, True)
    """
    dimensions = {name: _dimension(name, values) for name, values in space.items()}

    def evaluate(candidates: list[dict[str, Any]]) -> list[float]:
        return [float(cost) for cost in map(objective, candidates)]

    settings = {
        "max_evaluations": max_evaluations,
        "n_sources": n_sources,
        "limit": limit,
        "variant": variant,
    }
    return search(evaluate, dimensions, seed, settings, known, progress)


def search(
    evaluate: Evaluate,
    dimensions: dict[str, Dimension],
    seed: int,
    settings: dict[str, Any],
    known: Sequence[Mapping[str, Any]],
    progress: bool,
) -> Tuning:
    """Run a bee colony whose candidates of a phase are evaluated at once."""
    seed = whole_of(seed, "seed", ConfigError)
    if not 0 <= seed < 2**64:
        raise ConfigError(f"seed = {seed}; it must be 0 to 2**64 - 1")
    listed = [{"name": name, "kind": of._kind()} for name, of in dimensions.items()]
    first = [_numbers(values, dimensions) for values in known]
    settings = {key: value for key, value in settings.items() if value is not None}
    bees = _formicar.Bees(listed, settings, seed, first)

    def costs(candidates: list[list[float]]) -> list[float]:
        named = [
            {
                name: of._value(number)
                for (name, of), number in zip(dimensions.items(), numbers, strict=True)
            }
            for numbers in candidates
        ]
        return [float(cost) for cost in evaluate(named)]

    shown = None
    if progress:
        from ._progress import tqdm_of

        shown = tqdm_of(settings["max_evaluations"], "evaluations")
    try:
        while not bees.is_done:
            bees.cycle(costs)
            if shown is not None:
                shown.update(bees.n_evaluations - shown.n)
    finally:
        if shown is not None:
            shown.close()
    best = bees.best
    assert best is not None, "the first cycle finds one"
    numbers, cost = best
    kinds = [
        ("n_evaluations", "u8"),
        ("best_cost", "f8"),
        ("median_cost", "f8"),
        ("n_gains", "u4"),
        ("scouted", "?"),
    ]
    return Tuning(
        best={
            name: of._value(number)
            for (name, of), number in zip(dimensions.items(), numbers, strict=True)
        },
        cost=cost,
        n_evaluations=bees.n_evaluations,
        history=frozen(np.array(bees.history, dtype=kinds)),
    )


def _dimension(name: str, values: Any) -> Dimension:
    if isinstance(values, (Real, Integer, Choice)):
        return values
    items = list(values) if isinstance(values, (tuple, list)) else []
    is_number = [isinstance(item, (int, float)) and not isinstance(item, bool) for item in items]
    if len(items) == 2 and all(is_number):
        if all(isinstance(item, int) for item in items):
            return Integer(*items)
        return Real(*items)
    if items:
        return Choice(items)
    raise ConfigError(
        f"{name} = {values!r}; expected a pair of numbers, a list of choices, or a Real, Integer "
        "or Choice"
    )


def _numbers(values: Mapping[str, Any], dimensions: dict[str, Dimension]) -> list[float]:
    if set(values) != set(dimensions):
        raise ConfigError(
            f"known values of {', '.join(values)}; expected one for each of {', '.join(dimensions)}"
        )
    return [of._number(values[name]) for name, of in dimensions.items()]
