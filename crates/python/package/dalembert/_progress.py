"""How far a search is, on a line of a terminal or a notebook."""

from __future__ import annotations

import sys

_WIDTH = 24


def is_watched() -> bool:
    """Tell whether somebody sees what is printed: a terminal or a notebook."""
    return sys.stderr.isatty() or "ipykernel" in sys.modules


class Line:
    """A bar with a text, written over and over."""

    def __init__(self) -> None:
        self._length = 0

    def __call__(self, text: str, done: float | None) -> None:
        """Show a text and which part of it is done, if that is known."""
        full = 0 if done is None else round(_WIDTH * min(max(done, 0.0), 1.0))
        line = f"[{'#' * full}{'.' * (_WIDTH - full)}] {text}"
        sys.stderr.write("\r" + line.ljust(self._length))
        sys.stderr.flush()
        self._length = len(line)

    def end(self) -> None:
        """Take the line away."""
        if self._length:
            sys.stderr.write("\r" + " " * self._length + "\r")
            sys.stderr.flush()
