"""Arrays as the compiled part takes them: plain, aligned, in the byte order of the machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, SupportsFloat

from ._formicar import InvalidPath
from ._lazy import np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def plain(data: ArrayLike, name: str) -> NDArray[Any]:
    """Return an array as it is where it can be read directly, else a copy.

    Raises
    ------
    TypeError
        A masked array, whose mask would be lost, or a sequence of rows of unequal lengths.
    """
    if isinstance(data, np.ma.MaskedArray):
        raise TypeError(
            f"{name} is a masked array, whose mask would be lost; hint: .filled(-1), which is "
            "unknown ground on a map"
        )
    try:
        array = np.asarray(data)
    except ValueError as error:
        raise TypeError(f"{name} is no array: {error}") from None
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    # Fields of packed records may lie anywhere in memory.
    return array if array.flags.aligned else array.copy()


def rows_of(data: ArrayLike, name: str, n_cols: tuple[int, ...]) -> NDArray[np.float64]:
    """Return rows of numbers as float64.

    Raises
    ------
    TypeError
        Values that are no real numbers.
    InvalidPath
        Another shape.
    """
    array = plain(data, name)
    check_real(array, name, "iuf")
    if array.ndim != 2 or array.shape[1] not in n_cols:
        columns = " or ".join(f"(n, {n})" for n in n_cols)
        raise InvalidPath(f"{name} has shape {array.shape}; expected {columns}")
    return np.ascontiguousarray(array, dtype=np.float64)


def check_real(array: NDArray[Any], name: str, kinds: str) -> None:
    """Refuse an array whose dtype is of none of NumPy's kinds.

    Raises
    ------
    TypeError
        Another dtype.
    """
    if array.dtype.kind not in kinds:
        hint = "; hint: .astype(float)" if array.dtype.kind == "O" else ""
        raise TypeError(f"{name} is of dtype {array.dtype}; expected real numbers{hint}")


def number_of(value: Any, name: str, unit: str, error: type[ValueError]) -> float:
    """Return a real number; text is none."""
    try:
        if isinstance(value, SupportsFloat):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise error(f"{name} = {value!r}; expected a number{unit}")


def whole_of(value: Any, name: str, error: type[ValueError]) -> int:
    """Return a whole number."""
    import operator

    try:
        return operator.index(value)
    except TypeError:
        raise error(f"{name} = {value!r}; it must be a whole number") from None


def pose_of(value: Any, name: str, error: type[ValueError]) -> tuple[float, float, float]:
    """Return three numbers as a pose."""
    try:
        x, y, heading = (float(number) for number in value)
    except (TypeError, ValueError):
        raise error(
            f"{name} = {value!r}; expected x, y, heading in meters and radians: three numbers"
        ) from None
    return (x, y, heading)


def table_of(columns: dict[str, NDArray[Any]], kinds: dict[str, str]) -> NDArray[np.void]:
    """Return columns as a structured array; those without a kind are float64."""
    pairs = [(name, kinds.get(name, "f8")) for name in columns]
    n_rows = len(next(iter(columns.values()))) if columns else 0
    table = np.zeros(n_rows, dtype=np.dtype(pairs, align=True))
    for name, values in columns.items():
        table[name] = values
    return table


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return an array that cannot be written to."""
    array.flags.writeable = False
    return array
