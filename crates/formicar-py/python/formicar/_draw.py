"""Pictures with matplotlib, and pages for notebooks."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

from ._formicar import InvalidPath
from ._lazy import np

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from ._map import OccupancyGrid
    from ._plan import Plan
    from ._vehicle import Vehicle

FREE, UNKNOWN, GRADED, OCCUPIED = "#ffffff", "#c9ccd1", "#e8c468", "#33373d"
PATH, REVERSE, BODY, START, GOAL = "#1f6feb", "#d9480f", "#1f6feb", "#2b8a3e", "#c2255c"


def axes_of(ax: Axes | None) -> Axes:
    """Return axes to draw on."""
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("a plot needs matplotlib; hint: pip install matplotlib") from None
    return plt.subplots(figsize=(8, 6), layout="constrained")[1]


def draw_map(map: OccupancyGrid, ax: Axes | None) -> Axes:
    """Draw a map in world coordinates."""
    ax = axes_of(ax)
    from matplotlib.colors import to_rgb
    from matplotlib.transforms import Affine2D

    free, unknown, graded, occupied = (
        np.array(to_rgb(color)) for color in (FREE, UNKNOWN, GRADED, OCCUPIED)
    )
    data = map.data
    share = np.clip(data, 0, 99)[..., None] / 99.0
    pixels = free + share * (graded - free)
    pixels[data == 100] = occupied
    pixels[data == -1] = unknown
    width, height = map.extent
    x, y, yaw = map.origin
    place = Affine2D().rotate(yaw).translate(x, y) + ax.transData
    ax.imshow(
        pixels, origin="lower", extent=(0, width, 0, height), transform=place, zorder=0,
        interpolation="nearest",
    )  # fmt: skip
    corners = np.array([(0, 0), (width, 0), (width, height), (0, height)])
    cos, sin = np.cos(yaw), np.sin(yaw)
    world = corners @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    ax.set_xlim(world[:, 0].min(), world[:, 0].max())
    ax.set_ylim(world[:, 1].min(), world[:, 1].max())
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    return ax


def body_at(vehicle: Vehicle, pose: Any) -> NDArray[np.float64]:
    """Return the corners of a body at a pose, shape (n, 2)."""
    x, y, heading = (float(number) for number in pose)
    cos, sin = np.cos(heading), np.sin(heading)
    turned: NDArray[np.float64] = vehicle.footprint @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    return turned


def draw_vehicle(vehicle: Vehicle, pose: Any, ax: Axes | None, color: str = BODY) -> Axes:
    """Draw a body at a pose, with its rear axle."""
    is_new = ax is None
    ax = axes_of(ax)
    from matplotlib.patches import Polygon

    x, y, heading = (float(number) for number in pose)
    if not vehicle.is_point:
        corners = body_at(vehicle, pose)
        ax.add_patch(Polygon(corners, closed=True, fill=False, edgecolor=color, linewidth=1.6))
        reach = max(vehicle.length * 0.5, 1e-3)
        tip = (x + reach * np.cos(heading), y + reach * np.sin(heading))
        ax.annotate("", tip, (x, y), arrowprops={"arrowstyle": "->", "color": color})
    ax.plot([x], [y], ".", color=color, markersize=5)
    if is_new:
        ax.set_aspect("equal")
        ax.margins(0.2)
        ax.autoscale_view()
        ax.set_xlabel("x [m]")
        ax.set_ylabel("y [m]")
    return ax


def draw_plan(plan: Plan, ax: Axes | None) -> Axes:
    """Draw a plan on its map."""
    ax = draw_map(plan.map, ax)
    from matplotlib.collections import PolyCollection

    if plan:
        poses = plan.poses
        if not plan.vehicle.is_point:
            bodies = [body_at(plan.vehicle, (p["x"], p["y"], p["heading"])) for p in poses[::2]]
            ax.add_collection(PolyCollection(bodies, facecolors=BODY, alpha=0.06, zorder=1))
        for direction, color, label in ((1, PATH, "forward"), (-1, REVERSE, "in reverse")):
            driven = poses["direction"] == direction
            if driven.any():
                # A stretch begins with the pose at which the one before it ends.
                here = driven.copy()
                here[:-1] |= driven[1:]
                line = (np.where(here, poses["x"], np.nan), np.where(here, poses["y"], np.nan))
                ax.plot(*line, color=color, linewidth=2, label=label)
    draw_vehicle(plan.vehicle, plan.start, ax, START)
    draw_vehicle(plan.vehicle, plan.goal, ax, GOAL)
    ax.set_title(_heading(plan))
    if plan:
        ax.legend(loc="best", framealpha=0.9)
    return ax


def _heading(plan: Plan) -> str:
    if not plan or plan.metrics is None:
        return f"{plan.status}: {plan.reason}"
    metrics = plan.metrics
    return f"{metrics.length_m:.2f} m, clearance {metrics.min_clearance_m:.2f} m"


def animate_plan(plan: Plan, ax: Axes | None, interval_ms: int) -> FuncAnimation:
    """Return an animation of the vehicle on its path."""
    if not plan:
        raise InvalidPath(f"the plan has no path: {plan.status}")
    ax = draw_plan(plan, ax)
    from matplotlib.animation import FuncAnimation
    from matplotlib.patches import Polygon

    poses = plan.poses
    corners = body_at(plan.vehicle, plan.start)
    body = Polygon(corners, closed=True, facecolor=BODY, edgecolor="white", alpha=0.8, zorder=5)
    ax.add_patch(body)

    def show(i: int) -> tuple[Polygon]:
        pose = poses[i]
        body.set_xy(body_at(plan.vehicle, (pose["x"], pose["y"], pose["heading"])))
        return (body,)

    figure = ax.get_figure(root=True)
    assert figure is not None, "axes that were drawn on have a figure"
    return FuncAnimation(figure, show, frames=len(poses), interval=interval_ms, blit=True)


def plan_html(plan: Plan) -> str:
    """Return a plan as a page: key numbers and picture."""
    rows = [("status", plan.status), ("planner", plan.planner), ("seed", str(plan.seed))]
    if plan and plan.metrics is not None and plan.certificate is not None:
        metrics = plan.metrics
        rows += [
            ("length", f"{metrics.length_m:.2f} m"),
            ("clearance", f"{metrics.min_clearance_m:.3f} m"),
            ("curvature", f"{metrics.max_curvature_per_m:.3f} 1/m at most"),
            ("cusps", str(metrics.n_cusps)),
            ("query", f"{plan.timing.query_s * 1e3:.1f} ms"),
            ("certificate", plan.certificate.path_hash),
        ]
    else:
        rows.append(("reason", plan.reason or ""))
    cells = "".join(f"<tr><th>{escape(a)}</th><td>{escape(b)}</td></tr>" for a, b in rows)
    picture = plan.to_svg()
    return f"<table>{cells}</table><div style='max-width:900px'>{picture}</div>"
