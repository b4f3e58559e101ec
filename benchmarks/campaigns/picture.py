#!/usr/bin/env python3
"""Takes the picture of cost over time out of a page of `formicar report`.

    python3 benchmarks/campaigns/picture.py page/index.html cost-over-time.svg
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

TITLE = "<title>Trend: cost over the least of its scenario</title>"


def picture(page: str) -> str:
    """Return the SVG around the title, with the pictures nested in it."""
    begin = page.rindex("<svg", 0, page.index(TITLE))
    depth = 0
    for tag in re.finditer(r"<svg\b|</svg>", page[begin:]):
        depth += -1 if tag.group() == "</svg>" else 1
        if depth == 0:
            return page[begin : begin + tag.end()]
    raise SystemExit("the picture does not end")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    svg = picture(Path(sys.argv[1]).read_text(encoding="utf-8"))
    Path(sys.argv[2]).write_text(svg + "\n", encoding="utf-8")
