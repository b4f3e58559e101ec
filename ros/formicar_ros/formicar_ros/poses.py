"""Poses on the ground: messages as ``(x, y, yaw)`` and back."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Pose as PoseMessage

Pose = tuple[float, float, float]

# How far the norm of a quaternion may be from 1. Senders that round to three digits keep to it.
NORM_SLACK = 0.01


class BadPose(ValueError):
    """Numbers that are no pose."""


def yaw_of(quaternion: Any) -> float:
    """Return the yaw of a rotation, radians.

    Raises
    ------
    BadPose
        Numbers whose norm is not 1.
    """
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    if not abs(norm - 1.0) <= NORM_SLACK:
        raise BadPose(
            f"orientation ({x:g}, {y:g}, {z:g}, {w:g}) has the norm {norm:g}; a rotation has 1; "
            "hint: (0, 0, sin(yaw / 2), cos(yaw / 2))"
        )
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def pose_of(message: Any) -> Pose:
    """Return ``(x, y, yaw)`` of a pose.

    Raises
    ------
    BadPose
        A rotation that is none. Positions are not examined.
    """
    return (message.position.x, message.position.y, yaw_of(message.orientation))


def pose_of_transform(message: Any) -> Pose:
    """Return ``(x, y, yaw)`` of a transform.

    Raises
    ------
    BadPose
        A rotation that is none, or a translation that is not finite.
    """
    x, y = message.translation.x, message.translation.y
    if not (math.isfinite(x) and math.isfinite(y)):
        raise BadPose(f"translation ({x:g}, {y:g}) m is not finite")
    return (x, y, yaw_of(message.rotation))


def message_of(pose: Pose) -> PoseMessage:
    """Return a pose as a message."""
    message = PoseMessage()
    message.position.x, message.position.y = float(pose[0]), float(pose[1])
    message.orientation.z = math.sin(pose[2] / 2)
    message.orientation.w = math.cos(pose[2] / 2)
    return message


def compose(outer: Pose, inner: Pose) -> Pose:
    """Return the pose that `inner`, given in the frame of `outer`, has outside."""
    x, y, yaw = outer
    cos, sin = math.cos(yaw), math.sin(yaw)
    return (
        x + cos * inner[0] - sin * inner[1],
        y + sin * inner[0] + cos * inner[1],
        yaw + inner[2],
    )


def inverse(pose: Pose) -> Pose:
    """Return the pose of the outer frame in this one."""
    x, y, yaw = pose
    cos, sin = math.cos(yaw), math.sin(yaw)
    return (-cos * x - sin * y, sin * x - cos * y, -yaw)


def turn_between(start: float, end: float) -> float:
    """Return the shortest turn from one heading to another, radians."""
    return math.remainder(end - start, math.tau)
