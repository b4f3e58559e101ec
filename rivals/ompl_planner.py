#!/usr/bin/env python3
"""Planners of OMPL (https://ompl.kavrakilab.org) as rivals in a campaign of formicar.

Reads one question of the protocol formicar/rival/1 from stdin and prints one answer:

    python3 rivals/ompl_planner.py RRTConnect [--simplify] [--range M] [--time-limit S]

Needs the Python packages `ompl` and `numpy` (pip install ompl numpy); where they are missing the
answer says so. The state space is Reeds-Shepp where reverse is allowed and Dubins where it is not,
with the vehicle's smallest turning radius.

What is valid is decided here, by code that shares nothing with formicar: the convex footprint at a
pose, grown by a slack, must not touch an occupied cell square nor the border. Motions are checked
at poses so close that no point of the body moves farther than the slack (less the clearance that
the judge wants) from the nearest of them, so that what is valid here is valid for the judge. By
default the slack is 0.15 cells; a start or goal nearer to an obstacle than that is refused.

Licensed like formicar itself: MIT or Apache-2.0.
"""

import argparse
import json
import math
import resource
import sys
import time

SCHEMA = "formicar/rival/1"
#: Distance that the judge wants between the body and everything else, metres.
MIN_CLEARANCE_M = 1e-3
#: Slack by default, in cells.
SLACK_CELLS = 0.15
#: Distance between the poses of the answer, metres.
SPACING_M = 0.05
#: Time limit where the question has no deadline, seconds.
TIME_LIMIT_S = 10.0
#: Solving is done in slices of this length, so that improvements are seen, seconds.
SLICE_S = 0.1
#: Planners that go on improving until their time is over.
ANYTIME = {"RRTstar", "InformedRRTstar", "SORRTstar", "BITstar", "PRMstar", "AORRTC"}


class Ground:
    """The occupied cells, and whether a footprint stands free of them."""

    def __init__(self, request, slack_m, np):
        self.np = np
        grid = request["map"]
        n_cols, n_rows = grid["n_cols"], grid["n_rows"]
        self.resolution_m = grid["resolution_m"]
        self.origin = grid["origin"]
        self.extent_m = (n_cols * self.resolution_m, n_rows * self.resolution_m)
        footprint = np.array(request["vehicle"]["footprint"])
        self.radius_m = float(np.hypot(footprint[:, 0], footprint[:, 1]).max())
        rows = np.frombuffer(bytes.fromhex(grid["lethal"]), dtype=np.uint8)
        rows = np.unpackbits(rows.reshape(n_rows, -1), axis=1)[:, :n_cols]
        # Beyond the border everything is occupied.
        self.pad = math.ceil((self.radius_m + slack_m) / self.resolution_m) + 2
        self.cells = np.pad(rows.astype(bool), self.pad, constant_values=True)
        sums = self.cells.cumsum(axis=0, dtype=np.int32).cumsum(axis=1, dtype=np.int32)
        self.sums = np.pad(sums, ((1, 0), (1, 0)))
        self.set_body(footprint / self.resolution_m, slack_m / self.resolution_m)

    def set_body(self, corners, slack):
        """The body as half planes in its own frame, in cells: normal . p <= offset."""
        edges = self.np.roll(corners, -1, axis=0) - corners
        lengths = self.np.hypot(edges[:, 0], edges[:, 1])
        edges, corners = edges[lengths > 0], corners[lengths > 0]
        lengths = lengths[lengths > 0]
        # Corners run counter-clockwise: outside is to the right of an edge.
        self.normals = self.np.stack([edges[:, 1], -edges[:, 0]], axis=1) / lengths[:, None]
        self.offsets = (self.normals * corners).sum(axis=1) + slack
        self.corners = [tuple(corner) for corner in corners.tolist()]
        self.slack = slack

    def is_free(self, x, y, heading):
        """Whether the grown body touches no occupied square."""
        np, (x0, y0, turn) = self.np, self.origin
        dx, dy = (x - x0) / self.resolution_m, (y - y0) / self.resolution_m
        cos, sin = math.cos(turn), math.sin(turn)
        col, row = cos * dx + sin * dy + self.pad, cos * dy - sin * dx + self.pad
        cos, sin = math.cos(heading - turn), math.sin(heading - turn)
        cols = [cos * px - sin * py for px, py in self.corners]
        rows = [sin * px + cos * py for px, py in self.corners]
        first_col = math.floor(col + min(cols) - self.slack)
        last_col = math.floor(col + max(cols) + self.slack) + 1
        first_row = math.floor(row + min(rows) - self.slack)
        last_row = math.floor(row + max(rows) + self.slack) + 1
        n_rows, n_cols = self.cells.shape
        if first_col < 0 or first_row < 0 or last_col > n_cols or last_row > n_rows:
            return False
        sums = self.sums
        n_occupied = (
            int(sums[last_row, last_col])
            - int(sums[first_row, last_col])
            - int(sums[last_row, first_col])
            + int(sums[first_row, first_col])
        )
        if n_occupied == 0:
            return True
        at = np.argwhere(self.cells[first_row:last_row, first_col:last_col])
        centers = np.empty((len(at), 2))
        centers[:, 0] = at[:, 1] + (first_col + 0.5 - col)
        centers[:, 1] = at[:, 0] + (first_row + 0.5 - row)
        normals = self.normals @ np.array([[cos, sin], [-sin, cos]])
        reach = 0.5 * np.abs(normals).sum(axis=1)
        # A square is apart from the body where one edge has all of it outside.
        is_apart = (centers @ normals.T - reach > self.offsets).any(axis=1)
        return bool(is_apart.all())


class Task:
    """A question set up for OMPL."""

    def __init__(self, request, args, ompl, np):
        ob, og = ompl.base, ompl.geometric
        self.ob = ob
        vehicle = request["vehicle"]
        self.radius_m = vehicle["min_turning_radius_m"]
        slack_m = SLACK_CELLS * request["map"]["resolution_m"]
        slack_m = args.slack if args.slack is not None else max(slack_m, 3 * MIN_CLEARANCE_M)
        self.ground = Ground(request, slack_m, np)
        is_forward = request["motion"] == "forward"
        make = ob.DubinsStateSpace if is_forward else ob.ReedsSheppStateSpace
        self.space = make(self.radius_m)
        self.space.setBounds(self.bounds(request))
        self.setup = og.SimpleSetup(self.space)
        free = self.ground.is_free
        self.setup.setStateValidityChecker(
            lambda state: free(state.getX(), state.getY(), state.getYaw())
        )
        # Between two checks no point of the body moves farther than the slack from one of them.
        per_metre = 1 + self.ground.radius_m / self.radius_m
        step_m = 2 * (slack_m - MIN_CLEARANCE_M) / per_metre
        info = self.setup.getSpaceInformation()
        info.setStateValidityCheckingResolution(step_m / self.space.getMaximumExtent())
        self.ends = [self.state(request["start"]), self.state(request["goal"])]
        self.setup.setStartAndGoalStates(self.ends[0], self.ends[1])
        planner = getattr(og, args.planner)(info)
        if args.range is not None:
            planner.setRange(args.range)
        self.setup.setPlanner(planner)
        self.setup.setup()

    def bounds(self, request):
        """The box around the map."""
        x0, y0, turn = request["map"]["origin"]
        (width, height), cos, sin = self.ground.extent_m, math.cos(turn), math.sin(turn)
        xs = [x0 + cos * u - sin * v for u in (0, width) for v in (0, height)]
        ys = [y0 + sin * u + cos * v for u in (0, width) for v in (0, height)]
        bounds = self.ob.RealVectorBounds(2)
        for i, values in enumerate((xs, ys)):
            bounds.setLow(i, min(values))
            bounds.setHigh(i, max(values))
        return bounds

    def state(self, pose):
        state = self.space.allocState()
        state.setXY(pose[0], pose[1])
        state.setYaw(math.remainder(pose[2], 2 * math.pi))
        return state

    def blocked_end(self):
        """The end that is not free with its slack, if one is."""
        for name, end in zip(("start", "goal"), self.ends):
            if not self.ground.is_free(end.getX(), end.getY(), end.getYaw()):
                return name
        return None

    def solve(self, limit_s, is_anytime, is_simplified):
        """Times and lengths of the paths found, in seconds from here on."""
        begun, told = time.monotonic(), []
        while True:
            left_s = limit_s - (time.monotonic() - begun)
            if left_s <= 0:
                break
            self.setup.solve(min(SLICE_S, left_s))
            if self.setup.haveExactSolutionPath():
                length_m = self.setup.getSolutionPath().length()
                if not told or length_m < told[-1][1]:
                    told.append([time.monotonic() - begun, length_m])
                if not is_anytime:
                    break
        if told and is_simplified:
            self.setup.simplifySolution()
            length_m = self.setup.getSolutionPath().length()
            if length_m < told[-1][1]:
                told.append([time.monotonic() - begun, length_m])
        return told, time.monotonic() - begun

    def poses(self):
        """The path, dense, with a pose at every cusp."""
        states = self.setup.getSolutionPath().getStates()
        poses = [self.pose(states[0])]
        for one, other in zip(states, states[1:]):
            poses.extend(self.edge(one, other))
        return poses

    def edge(self, one, other):
        """Poses from one state of the tree (without it) to another (with it)."""
        length_m = self.space.distance(one, other)
        if length_m <= 1e-9:
            return []
        scratch, near = self.space.allocState(), 1e-6 / length_m

        def at(t):
            self.space.interpolate(one, other, min(max(t, 0.0), 1.0), scratch)
            return self.pose(scratch)

        def is_forward(t):
            (ax, ay, _), (bx, by, _) = at(t - near), at(t + near)
            heading = at(t)[2]
            return (bx - ax) * math.cos(heading) + (by - ay) * math.sin(heading) >= 0

        n_steps = max(1, math.ceil(length_m / SPACING_M))
        poses, gear = [], is_forward(near)
        for i in range(1, n_steps + 1):
            low, high = (i - 1) / n_steps, i / n_steps
            if i == n_steps:
                high -= near
            now = is_forward(high)
            if now != gear:
                for _ in range(50):
                    middle = 0.5 * (low + high)
                    if is_forward(middle) == gear:
                        low = middle
                    else:
                        high = middle
                poses.append(at(low))
                gear = now
            poses.append(at(i / n_steps))
        return poses

    @staticmethod
    def pose(state):
        return [state.getX(), state.getY(), state.getYaw()]


def plan(request, args, ompl, np):
    """The answer to a request."""
    if request["vehicle"]["motion"] != "car":
        return {"status": "refused", "reason": "it plans for cars; hint: a vehicle that steers"}
    begun = time.monotonic()
    ompl.util.RNG.setSeed(request["seed"] % (2**32 - 1) + 1)
    task = Task(request, args, ompl, np)
    map_setup_s = time.monotonic() - begun
    blocked = task.blocked_end()
    if blocked is not None:
        reason = f"the {blocked} is nearer to an obstacle than the slack of motion validation"
        return {"status": "refused", "reason": reason, "map_setup_s": map_setup_s}
    deadline_ms = request.get("deadline_ms")
    limit_s = args.time_limit if deadline_ms is None else deadline_ms / 1e3
    told, query_s = task.solve(limit_s, args.planner in ANYTIME, args.simplify)
    times = {"map_setup_s": map_setup_s, "query_s": query_s}
    if not told:
        return {"status": "not_found", "reason": f"no path within {limit_s:g} s", **times}
    return {
        "status": "found",
        "poses": task.poses(),
        "first_feasible_s": told[0][0],
        "improvements": told,
        **times,
    }


def answer(question, args):
    """The answer to a question; the packages are looked for only now."""
    if question.get("schema") != SCHEMA:
        raise SystemExit(f"schema: {question.get('schema')!r}; expected {SCHEMA!r}")
    try:
        import importlib.metadata

        import numpy as np
        import ompl
        import ompl.base
        import ompl.geometric
        import ompl.util
    except ImportError as error:
        reason = f"{error}; hint: pip install ompl numpy"
        return {"status": "unavailable", "reason": reason, "version": ""}
    version = f"ompl {importlib.metadata.version('ompl')}"
    if not hasattr(ompl.geometric, args.planner):
        raise SystemExit(f"OMPL has no planner {args.planner!r}")
    ompl.util.setLogLevel(ompl.util.LOG_ERROR)
    if question["ask"] == "version":
        return {"status": "ready", "version": version}
    return {**plan(question, args, ompl, np), "version": version}


def arguments():
    parser = argparse.ArgumentParser(description="Planners of OMPL as rivals of formicar.")
    parser.add_argument("planner", help="a geometric planner, for instance RRTConnect or RRTstar")
    parser.add_argument("--simplify", action="store_true", help="shorten the path in the end")
    parser.add_argument("--range", type=float, metavar="M", help="longest motion of the planner")
    parser.add_argument("--slack", type=float, metavar="M", help="how much the body is grown")
    parser.add_argument(
        "--time-limit", type=float, metavar="S", default=TIME_LIMIT_S,
        help="where the question has no deadline",
    )
    return parser.parse_args()


def main():
    args = arguments()
    answered = answer(json.load(sys.stdin), args)
    usage = resource.getrusage(resource.RUSAGE_SELF)
    answered["cpu_s"] = usage.ru_utime + usage.ru_stime
    answered["peak_rss_bytes"] = usage.ru_maxrss * 1024
    json.dump(answered, sys.stdout)
    print()


if __name__ == "__main__":
    main()
