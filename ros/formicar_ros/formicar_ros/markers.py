"""What rviz shows of a plan: the swept ground and the tightest place."""

from __future__ import annotations

import math
from typing import Any

import formicar
import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from .poses import message_of

# A body is drawn every so many meters of the path.
BODY_SPACING_M = 0.2
_SWEPT = ColorRGBA(r=0.2, g=0.5, b=0.9, a=0.25)
_TIGHT = ColorRGBA(r=0.9, g=0.3, b=0.1, a=0.9)


def markers_of(plan: formicar.Plan, header: Header) -> MarkerArray:
    """Return the swept ground, the body at the tightest place, and its clearance as text."""
    certificate = plan.certificate
    assert certificate is not None, "a path that was found is certified"
    body = plan.vehicle.footprint
    swept = _marker(header, 0, "swept_ground", Marker.TRIANGLE_LIST, _SWEPT)
    swept.points = _bodies(plan, body)
    tight = _marker(header, 1, "tightest_place", Marker.LINE_STRIP, _TIGHT)
    tight.scale.x = 0.03
    tight.pose = message_of(certificate.tightest)
    tight.points = [_point(x, y, 0.02) for x, y in [*body.tolist(), body[0].tolist()]]
    text = _marker(header, 2, "tightest_place", Marker.TEXT_VIEW_FACING, _TIGHT)
    text.scale.z = 0.2
    text.pose = message_of(certificate.tightest)
    text.pose.position.z = 0.3
    text.text = f"{certificate.min_clearance_m:.2f} m"
    return MarkerArray(markers=[swept, tight, text])


def _bodies(plan: formicar.Plan, body: Any) -> list[Point]:
    """Return the triangles of the bodies along a plan; convex bodies are fans."""
    poses = plan.poses
    n_bodies = max(2, math.ceil(float(poses["s"][-1]) / BODY_SPACING_M) + 1)
    picked = np.unique(
        np.searchsorted(poses["s"], np.linspace(0.0, poses["s"][-1], n_bodies)).clip(
            0, len(poses) - 1
        )
    )
    points = []
    for pose in poses[picked]:
        cos, sin = math.cos(pose["heading"]), math.sin(pose["heading"])
        corners = body @ np.array([[cos, sin], [-sin, cos]]) + [pose["x"], pose["y"]]
        for k in range(1, len(corners) - 1):
            points += [_point(*corners[n].tolist()) for n in (0, k, k + 1)]
    return points


def _marker(header: Header, number: int, namespace: str, kind: int, color: ColorRGBA) -> Marker:
    marker = Marker(header=header, ns=namespace, id=number, type=kind, action=Marker.ADD)
    marker.color = color
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0
    marker.pose.orientation.w = 1.0
    marker.lifetime = Duration(sec=0)
    return marker


def _point(x: float, y: float, z: float = 0.0) -> Point:
    return Point(x=x, y=y, z=z)
