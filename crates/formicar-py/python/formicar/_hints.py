"""Hints for words that nobody knows: the nearest known one."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint that names the nearest known word; empty where none is near.

    Parameters
    ----------
    word : str
        The word that is not known.
    known : iterable of str
        The words that are. Of dotted ones the last part counts too.

    Returns
    -------
    str
        ``"; hint: ..."`` or ``""``.
    """
    from difflib import get_close_matches

    whole = {name: name for name in known}
    by_last = {name.rsplit(".", 1)[-1]: name for name in whole}
    begun = [name for name in by_last if name.startswith(word)] if len(word) > 2 else []
    found = get_close_matches(word, whole, 1) or get_close_matches(word, by_last, 1) or begun
    return f"; hint: {(whole | by_last)[found[0]]!r}" if found else ""


def suggests(function: Function) -> Function:
    """Let a function name the nearest keyword where one is not known."""

    @functools.wraps(function)
    def called(*args: Any, **keywords: Any) -> Any:
        try:
            return function(*args, **keywords)
        except TypeError as error:
            message = _unknown_keyword(function, keywords, error)
            if message is None:
                raise
        raise TypeError(message)

    return called  # type: ignore[return-value]


def _unknown_keyword(
    function: Callable[..., Any], keywords: dict[str, Any], error: TypeError
) -> str | None:
    if "unexpected keyword argument" not in str(error):
        return None
    code = function.__code__
    known = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    unknown = [word for word in keywords if word not in known]
    if not unknown:
        return None
    name = function.__qualname__.removesuffix(".__init__").rsplit(".", 1)[-1]
    named = f"{name}() has no keyword {unknown[0]!r}"
    return named + (nearest(unknown[0], known) or f"; there are {', '.join(known[1:])}")
