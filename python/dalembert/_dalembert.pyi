from os import PathLike
from typing import Any, Callable

from numpy.typing import ArrayLike

class Function:
    """A function of an arm.

    Call it with one state, arrays of shape ``(n,)``, or with many, ``(N, n)``; leading axes
    are broadcast by NumPy's rules and lead the result's. Rows and columns, and any other
    strides that are not negative, are read without a copy.

    Arguments, by place or name, are those of ``arguments``: ``q``, ``qd``, ``qdd``, ``tau``
    (positions, velocities, accelerations, torques: rad or m, a second, N·m or N), ``v`` and
    ``a`` of a controller, ``g`` (3,) in m/s², ``load``.

    ``out`` is an array, or a tuple of several, of the result's shape and dtype; ``threads``
    share many states among them. Arrays of float32 are computed as such where the arm was
    loaded with ``scalar="f32"`` or both, else in float64.

    A function with several results returns a named tuple of arrays.
    """

    def __call__(
        self, *args: ArrayLike, out: Any = None, threads: int = 1, **kwargs: ArrayLike
    ) -> Any: ...
    @property
    def __name__(self) -> str: ...
    @property
    def arguments(self) -> list[str]: ...
    @property
    def results(self) -> list[tuple[str, list[int]]]: ...
    @property
    def dtypes(self) -> list[str]: ...

class Arm:
    @property
    def name(self) -> str: ...
    @property
    def joints(self) -> list[tuple[str, str]]: ...
    @property
    def limits(self) -> list[list[float]]: ...
    @property
    def functions(self) -> list[dict[str, Any]]: ...
    def function(self, name: str, structure: Any, raises_on_nan: bool) -> Function: ...
    @property
    def certificates(self) -> str | None: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def is_from_cache(self) -> bool: ...
    @property
    def has_ended_early(self) -> bool: ...
    @property
    def rust(self) -> str: ...
    @property
    def robot_file(self) -> str: ...
    @property
    def plan(self) -> str: ...
    def svg(self, q: list[float]) -> str: ...

def load(
    source: str,
    name: str,
    path: str | PathLike[str] | None,
    options: dict[str, Any],
    progress: Callable[[str], None] | None,
) -> Arm: ...
def outputs() -> list[tuple[str, str]]: ...
