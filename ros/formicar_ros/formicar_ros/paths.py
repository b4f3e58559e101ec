"""Paths as messages, and messages as paths."""

from __future__ import annotations

from typing import Any

import formicar
import numpy as np
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from numpy.typing import NDArray
from std_msgs.msg import Header

from .poses import message_of

Rows = NDArray[np.float64]


def rows_of(plan: formicar.Plan) -> Rows:
    """Return ``x, y, yaw`` along a plan, no pose twice in a row."""
    poses = plan.poses
    rows = np.column_stack([poses[name] for name in ("x", "y", "heading")])
    if len(rows) < 2:
        return rows
    moves = np.append(True, np.diff(poses["s"]) > 0.0)
    kept: Rows = rows[moves]
    return kept


def path_of(rows: Rows, header: Header) -> Path:
    """Return rows ``x, y, yaw`` as a path."""
    path = Path(header=header)
    path.poses = [
        PoseStamped(header=header, pose=message_of((x, y, yaw))) for x, y, yaw in rows.tolist()
    ]
    return path


def position_of(message: Any) -> tuple[float, float]:
    """Return where a stamped pose is."""
    return (message.pose.position.x, message.pose.position.y)
