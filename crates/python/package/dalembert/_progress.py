"""How far a search is, on a line of a terminal or a notebook, or that there is one."""

from __future__ import annotations

import sys
import time

_WIDTH = 24


def is_watched() -> bool:
    """Tell whether somebody sees what is printed: a terminal or a notebook."""
    return sys.stderr.isatty() or "ipykernel" in sys.modules


class Line:
    """A bar with a text, written over and over."""

    def __init__(self) -> None:
        self._line = ""

    def __call__(self, text: str, done: float | None) -> None:
        """Show a text and which part of it is done, if that is known."""
        full = 0 if done is None else round(_WIDTH * min(max(done, 0.0), 1.0))
        line = f"[{'#' * full}{'.' * (_WIDTH - full)}] {text}"
        if line != self._line:
            sys.stderr.write("\r" + line.ljust(len(self._line)))
            sys.stderr.flush()
            self._line = line

    def end(self) -> None:
        """Take the line away."""
        if self._line:
            sys.stderr.write("\r" + " " * len(self._line) + "\r")
            sys.stderr.flush()


class Note:
    """A line that says that there is a search, once it has taken a second."""

    def __init__(self, robot: str) -> None:
        self._robot = robot
        self._due = time.monotonic() + 1

    def __call__(self, text: str, done: float | None) -> None:
        """Write the line, the first time that it is due."""
        if time.monotonic() >= self._due:
            self._due = float("inf")
            print(
                f"dalembert: searching for functions of {self._robot}, which can take a minute: "
                "progress=True shows how far it is, progress=False is silent",
                file=sys.stderr,
                flush=True,
            )

    def end(self) -> None:
        """Leave the line: who comes back later still sees it."""
