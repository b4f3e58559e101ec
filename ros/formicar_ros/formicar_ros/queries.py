"""From the goals of actions to queries in the frame of the map."""

from __future__ import annotations

import math
from typing import Any

from .codes import Code, Failed
from .planning import Query, Ticket
from .poses import BadPose, Pose, compose, pose_of
from .transforms import NoTransform, Transforms

# How often transforms that have not come yet are looked for, seconds.
_LOOK_S = 0.01


class Frames:
    """Poses in the frame of the map, as far as transforms tell.

    Parameters
    ----------
    transforms : Transforms
        The buffer.
    clock
        The clock of the node, by which transforms grow old.
    fixed, base : str
        Frames of the map and of the robot.
    tolerance_s : float
        Largest age of the robot's pose, and how long a goal waits for it.
    """

    def __init__(
        self, transforms: Transforms, clock: Any, fixed: str, base: str, tolerance_s: float
    ) -> None:
        self._transforms, self._clock = transforms, clock
        self.fixed, self.base = fixed.lstrip("/"), base.lstrip("/")
        self._tolerance_s = tolerance_s

    def robot(self) -> Pose:
        """Return where the robot is now.

        Raises
        ------
        NoTransform
            It is not known, or has not been for too long.
        """
        pose, time_s = self._transforms.look_up(self.fixed, self.base)
        age_s = 0.0 if time_s is None else self._clock.now().nanoseconds * 1e-9 - time_s
        if age_s > self._tolerance_s:
            raise NoTransform(
                f"the pose of {self.base!r} in {self.fixed!r} is {age_s:.2f} s old, more than the "
                f"{self._tolerance_s:g} s of transform_tolerance; hint: are clocks and "
                "use_sim_time the same everywhere?"
            )
        return pose

    def wait_for_robot(self, ticket: Ticket) -> Pose:
        """Return where the robot is, as soon as it is known.

        Raises
        ------
        Failed
            It is not known within the tolerance.
        """
        n_looks = max(1, math.ceil(self._tolerance_s / _LOOK_S))
        for n in range(n_looks + 1):
            try:
                return self.robot()
            except NoTransform as error:
                if n == n_looks:
                    raise Failed(Code.TF_ERROR, f"start: {error}") from None
            ticket.wait(_LOOK_S)
        raise AssertionError("the loop returns or raises")

    def pose(self, stamped: Any, what: str, frame: str = "") -> Pose:
        """Return a stamped pose in the frame of the map.

        Parameters
        ----------
        stamped
            The message.
        what : str
            What it is, for sentences.
        frame : str, optional
            The frame of poses that name none; by default the map's.

        Raises
        ------
        Failed
            An orientation that is none, or a frame that is not connected to the map.
        """
        frame = (stamped.header.frame_id or frame or self.fixed).lstrip("/")
        try:
            pose = pose_of(stamped.pose)
            if frame == self.fixed:
                return pose
            outer, _ = self._transforms.look_up(self.fixed, frame)
            return compose(outer, pose)
        except BadPose as error:
            raise Failed(Code.TF_ERROR, f"{what}: {error}") from None
        except NoTransform as error:
            raise Failed(Code.TF_ERROR, f"{what} in frame {frame!r}: {error}") from None


def query_of(
    frames: Frames,
    planner_id: str,
    goals: list[tuple[Any, str]],
    start: Any | None,
    ticket: Ticket,
    points: list[tuple[float, float]],
) -> Query:
    """Return a query from the poses of a request.

    Parameters
    ----------
    frames : Frames
        The frames.
    planner_id : str
        Which planner.
    goals : list
        Stamped poses to pass, the last to reach, each with the frame that it is in if it names
        none.
    start
        A stamped pose, or ``None`` to start where the robot is.
    ticket : Ticket
        The goal, which may be stopped while the robot's pose is waited for.
    points : list
        Points to pass before all goals, in the frame of the map.
    """
    names = [f"via pose {n}" for n in range(1, len(goals))] + ["goal"]
    poses = [
        frames.pose(stamped, name, frame)
        for (stamped, frame), name in zip(goals, names, strict=True)
    ]
    begin = frames.wait_for_robot(ticket) if start is None else frames.pose(start, "start")
    return Query(planner_id, begin, poses[-1], (*points, *poses[:-1]))
