"""Progress bars, where tqdm is there."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any


def tqdm_of(total: int | None, unit: str) -> Any:
    """Return a tqdm bar."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ImportError("a progress bar needs tqdm; hint: pip install tqdm") from None
    return tqdm(total=total, unit=f" {unit}")


@contextmanager
def bar(total: int | None, unit: str) -> Generator[Callable[[dict[str, Any]], None], None, None]:
    """Show the progress of a query: steps, and the length of the best path."""
    with tqdm_of(total, unit) as shown:

        def listen(event: dict[str, Any]) -> None:
            n_steps = event.get("n_steps", 0)
            if n_steps > shown.n:
                shown.update(n_steps - shown.n)
            if event["event"] == "improved":
                shown.set_postfix_str(f"{event['length_m']:.2f} m")
            elif event["event"] == "iteration":
                shown.set_postfix_str(f"iteration {event['iteration'] + 1}")

        yield listen
