"""What the installed interfaces offer: fields are looked up, a distribution's name never is."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def has_field(message: Any, name: str) -> bool:
    """Return True if a message, or its type, has a field of this name."""
    return name in message.get_fields_and_field_types()


def put(message: Any, **values: Any) -> None:
    """Set those of the fields that the message has."""
    for name, value in values.items():
        if has_field(message, name):
            setattr(message, name, value)


def value_of(message: Any, name: str, default: Any) -> Any:
    """Return a field of the message, or the default where it has none of this name."""
    return getattr(message, name) if has_field(message, name) else default


def optional(module: str, name: str) -> Any:
    """Return an interface, or ``None`` where its package is not installed."""
    try:
        return getattr(import_module(module), name)
    except (ImportError, AttributeError):
        return None


def goals_of(request: Any) -> tuple[list[Any], str]:
    """Return the poses of a request through poses, and the frame of those that name none.

    They are a list, or a list with a header.
    """
    goals = request.goals
    if hasattr(goals, "goals"):
        return list(goals.goals), goals.header.frame_id
    return list(goals), ""
