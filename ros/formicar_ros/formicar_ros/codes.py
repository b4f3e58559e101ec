"""Why a goal has failed: Nav2's code, and a sentence."""

from __future__ import annotations

from enum import IntEnum

TO_POSE = 200
THROUGH_POSES = 300


class Code(IntEnum):
    """What the codes of the two actions have in common; each action adds a base of its own."""

    UNKNOWN = 0
    INVALID_PLANNER = 1
    TF_ERROR = 2
    START_OUTSIDE_MAP = 3
    GOAL_OUTSIDE_MAP = 4
    START_OCCUPIED = 5
    GOAL_OCCUPIED = 6
    TIMEOUT = 7
    NO_VALID_PATH = 8
    NO_VIAPOINTS_GIVEN = 9


class Failed(Exception):
    """A goal without a path.

    Parameters
    ----------
    code : Code
        The code, without the base of its action.
    sentence : str
        Thing, value, limit and hint.
    """

    def __init__(self, code: Code, sentence: str) -> None:
        super().__init__(sentence)
        self.code = code
        self.sentence = sentence


class Stopped(Exception):
    """The goal was canceled, or a newer one has taken its place."""
