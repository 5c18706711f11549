"""Arms: loading them, and what they know of themselves."""

from __future__ import annotations

import difflib
import functools
import os
import warnings
from collections import namedtuple
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

from . import _dalembert
from ._keywords import keywords
from ._progress import Line, Note, is_watched
from ._toml import text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

Path = Union[str, "os.PathLike[str]"]


class Joint(NamedTuple):
    """A joint: its name, and whether it is ``revolute`` or ``prismatic``."""

    name: str
    kind: str


class Limits(NamedTuple):
    """Limits of all joints, an entry a joint; an infinity where there is none."""

    lower: NDArray[np.float64]
    """Lowest positions, rad or m."""
    upper: NDArray[np.float64]
    """Highest positions, rad or m."""
    velocity: NDArray[np.float64]
    """Largest speeds, rad/s or m/s."""
    acceleration: NDArray[np.float64]
    """Largest accelerations, rad/s² or m/s²."""
    torque: NDArray[np.float64]
    """Largest torques or forces, N·m or N."""


class Arm:
    """An arm: its functions as methods, compiled for it.

    ``load`` was told which there are. Each takes one state, arrays of shape ``(n,)``, or
    many, ``(N, n)``, broadcast against each other; see :class:`dalembert.Function`.

    >>> import dalembert
    >>> arm = dalembert.load("generated/robots/planar2r.toml", outputs=["gravity", "inertia"])
    >>> arm.gravity([0.0, 0.0])
    array([19.62 ,  4.905])
    >>> arm.inertia([[0.0, 0.0], [0.0, 0.5], [0.0, 1.0]]).shape
    (3, 2, 2)
    >>> [joint.kind for joint in arm.joints]
    ['revolute', 'revolute']
    """

    def __init__(self, native: _dalembert.Arm, name: str, options: dict[str, Any]) -> None:
        self._native = native
        self._loaded = (name, options)
        self._bound: tuple[Arm, _dalembert.Load] | None = None
        raises = options["nan"] == "raise"
        self._functions: dict[str, _dalembert.Function] = {}
        for name in dict.fromkeys(about["name"] for about in native.functions):
            function = native.function(name, None, raises, self._loaded)
            results = tuple(field for field, _ in function.results)
            if len(results) > 1:
                title = "".join(word.capitalize() for word in name.split("_"))
                structure = _structure(title, results)
                function = native.function(name, structure, raises, self._loaded)
            self._functions[name] = function
        self.__dict__.update(self._functions)

    def __getattr__(self, name: str) -> _dalembert.Function:
        # Functions are attributes of their own: these are what there is not.
        known = dict(_dalembert.outputs())
        if name in known:
            functions = ", ".join(self.__dict__.get("_functions", {}))
            raise AttributeError(
                f"this arm was loaded without {name!r}: add it to outputs=, which were {functions}"
            )
        near = difflib.get_close_matches(name, [*known, *dir(type(self))], 1)
        meant = f": did you mean `{near[0]}`?" if near else ""
        raise AttributeError(f"an arm has no {name!r}{meant}")

    def __reduce__(self) -> Any:
        """Pickle and copy by source, programs and options: they are proved and compiled again."""
        if self._bound is not None:
            return _with_load, self._bound
        name, options = self._loaded
        return _load, (name, self._native.source, self._native.plan, options)

    @property
    def functions(self) -> Mapping[str, _dalembert.Function]:
        """The functions by name."""
        return dict(self._functions)

    @property
    def name(self) -> str:
        """The robot's name."""
        return self._native.name

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints, from the base to the hand: q has their order, and behind the six entries of a
        base that floats, qd, qdd and tau."""
        return tuple(Joint(name, kind) for name, kind in self._native.joints)

    @property
    def base(self) -> str | None:
        """The name of the base if it floats: the first six entries of qd, qdd and tau are its."""
        return self._native.base

    @property
    def places(self) -> dict[str, int | slice]:
        """Where the base and each joint are in qd, qdd and tau, and in the rows of D."""
        base = self.base
        if base is None:
            return {**self._positions}
        joints = {name: 6 + place for name, place in self._positions.items()}
        return {base: slice(0, 6), **joints}

    @property
    def _positions(self) -> dict[str, int]:
        return {joint.name: place for place, joint in enumerate(self.joints)}

    def positions(self, named: Mapping[str, float], fill: float = 0.0) -> NDArray[np.float64]:
        """Return q, an entry a joint, from positions by the joints' names; ``fill`` is of the others."""
        return _filled(named, self._positions, len(self.joints), fill)

    def rates(self, named: Mapping[str, ArrayLike], fill: float = 0.0) -> NDArray[np.float64]:
        """Return an array like qd, qdd or tau, by names: six numbers of the base, one of a joint."""
        size = len(self.joints) + (0 if self.base is None else 6)
        return _filled(named, self.places, size, fill)

    def by_name(self, array: ArrayLike, axis: int = -1) -> dict[str, Any]:
        """Return the parts of an array by the names of joints: of q, of what is like qd, or of an
        axis of a matrix. The base has six entries."""
        import numpy as np

        values = np.asarray(array)
        n, length = len(self.joints), values.shape[axis]
        if length != n and (self.base is None or length != n + 6):
            expected = f"{n}" if self.base is None else f"{n} or {n + 6}"
            raise ValueError(f"by_name: axis {axis} has {length} entries, expected {expected}")
        places: Mapping[str, Any] = self._positions if length == n else self.places
        moved = np.moveaxis(values, axis, 0)
        return {name: moved[place] for name, place in places.items()}

    @functools.cached_property
    def limbs(self) -> tuple[tuple[str, ...], ...]:
        """The joints of each limb of a base that floats, as ``inertia_blocks`` has them: in a scene
        without what is locked. Empty on a fixed base."""
        names = tuple(self._positions)
        return tuple(tuple(names[joint] for joint in limb) for limb in self._native.limbs)

    def blocks(self, limbs: ArrayLike) -> list[Any]:
        """Return one matrix a limb, (…, k, k), from the field ``limbs`` of ``inertia_blocks``."""
        import numpy as np

        values = np.asarray(limbs)
        sizes = [len(limb) for limb in self.limbs]
        length = sum(size * size for size in sizes)
        if values.shape[-1:] != (length,):
            raise ValueError(f"blocks: expected (…, {length}), found {values.shape}")
        parts = np.split(values, np.cumsum([size * size for size in sizes])[:-1], axis=-1)
        return [part.reshape(*values.shape[:-1], n, n) for part, n in zip(parts, sizes)]

    @property
    def frames(self) -> tuple[str, ...]:
        """The frames that outputs may be at, as in ``jacobian@camera``; the hand is where no links branch."""
        return tuple(self._native.frames)

    @property
    def limits(self) -> Limits:
        """The joints' limits, rounded to nearest."""
        import numpy as np

        return Limits(*np.array(self._native.limits).reshape(-1, 5).T.copy())

    @property
    def parameters(self) -> dict[str, float]:
        """π of ``full_regressor``: ten numbers of each link, with the names of its columns.

        ``m2`` is the mass of link 2, ``mx2``, ``my2`` and ``mz2`` its first moments, ``Ixx2`` to
        ``Ixz2`` its tensor, about the origin and in the axes of the link's frame in the file, as
        ``link_poses`` has it. What is fixed to a link is part of it.
        """
        return dict(self._native.parameters)

    @functools.cached_property
    def base_parameters(self) -> dict[str, float]:
        """π of ``regressor``: each base parameter by its combination of :attr:`parameters`.

        ``armature2`` is the rotor's inertia that joint 2 feels, ``viscous2`` its friction.
        """
        return dict(self._native.base_parameters)

    @functools.cached_property
    def _loading(self) -> dict[str, NDArray[np.float64]]:
        import numpy as np

        arrays = {name: np.array(values, dtype=float) for name, values in self._native.loading}
        if "bodies" in arrays:
            arrays["bodies"] = arrays["bodies"].reshape(-1, 10)
        return arrays

    @functools.cached_property
    def body_links(self) -> tuple[int, ...]:
        """The links whose bodies ``load`` takes, counted from one; 0 is a base that floats."""
        return tuple(self._native.body_links)

    @property
    def bodies(self) -> NDArray[np.float64]:
        """The robot's bodies, (k, 10), as ``load`` takes them: mass, com x y z, inertia xx yy zz xy yz
        xz of each of :attr:`body_links`, in the frame of the link in the file.

        The arm has to be loaded with ``parameters="bodies"``.
        """
        return self._default("bodies")

    def _default(self, name: str) -> NDArray[np.float64]:
        if name not in self._loading:
            raise ValueError(
                f"{name} are constants of this arm: load it with parameters={name!r} among others"
            )
        return self._loading[name].copy()

    def with_bodies(
        self,
        masses: ArrayLike | None = None,
        centres: ArrayLike | None = None,
        inertias: ArrayLike | None = None,
        *,
        bodies: ArrayLike | None = None,
        armature: ArrayLike | None = None,
        viscous: ArrayLike | None = None,
        payload: ArrayLike | None = None,
    ) -> Arm:
        """Return this arm with other bodies and drives: nothing is searched for, proved or compiled.

        The arm has to be loaded with ``parameters="bodies"``, and with ``"armature"``, ``"viscous"``
        or ``"payload"`` for these. What is not given is the robot's; nothing is carried then.

        Parameters
        ----------
        masses, centres, inertias
            Of each of :attr:`body_links`, in kg, m and kg·m²: (k,), (k, 3) and (k, 6), inertias
            about the centre of mass as xx yy zz xy yz xz. A mass that is given alone scales the
            inertia, as a body of the same shape has it. With leading axes, (N, k), there are N
            robots, and functions take N states, or one for all.
        bodies
            All ten numbers of each, (k, 10).
        armature, viscous
            Rotors' inertias and viscous friction, an entry a row of the robot's table.
        payload
            What the hand carries, (10,).
        """
        import numpy as np

        numbers = self._default("bodies") if bodies is None else np.array(bodies, dtype=float)
        count = len(self.body_links)
        if numbers.shape[-2:] != (count, 10):
            raise ValueError(f"bodies: expected ({count}, 10), found {numbers.shape}")
        for name, values, place, width in (
            ("masses", masses, slice(0, 1), ()),
            ("centres", centres, slice(1, 4), (3,)),
            ("inertias", inertias, slice(4, 10), (6,)),
        ):
            if values is None:
                continue
            given = np.asarray(values, dtype=float)
            expected = (count, *width)
            if given.shape[given.ndim - len(expected) :] != expected:
                raise ValueError(f"{name}: expected {expected}, found {given.shape}")
            given = given if width else given[..., None]
            lead = np.broadcast_shapes(numbers.shape[:-2], given.shape[:-2])
            numbers = np.broadcast_to(numbers, (*lead, count, 10)).copy()
            if name == "masses" and inertias is None:
                old = numbers[..., :1]
                scale = np.divide(given, old, out=np.ones_like(old * given), where=old > 0)
                numbers[..., 4:] *= scale
            numbers[..., place] = given
        taken: dict[str, Any] = {"bodies": numbers}
        for name, values in (("armature", armature), ("viscous", viscous), ("payload", payload)):
            if name in self._loading or values is not None:
                default = np.zeros(10) if name == "payload" else self._default(name)
                taken[name] = default if values is None else values
        return self._with_load(self.__dict__["load"](**taken))

    def _with_load(self, load: Any) -> Arm:
        arm = object.__new__(type(self))
        arm.__dict__.update(self.__dict__)
        functions: dict[str, Any] = {
            name: _Loaded(function, load) if "load" in function.arguments else function
            for name, function in self._functions.items()
            if name != "load"
        }
        arm.__dict__.pop("load", None)
        arm._functions = functions
        arm._bound = (self, load)
        arm.__dict__.update(functions)
        return arm

    @property
    def counts(self) -> dict[str, dict[str, int]]:
        """The operations of each function."""
        return {about["name"]: about["counts"] for about in reversed(self._native.functions)}

    @property
    def proof(self) -> dict[str, str]:
        """What was proved of each function, in a sentence."""
        return {about["name"]: about["proof"] for about in self._native.functions}

    @property
    def claim(self) -> dict[str, Any]:
        """The claim about the functions: exact programs, and error bounds under a tolerance."""
        import json

        found: dict[str, Any] = json.loads(self._native.claim)
        return found

    @property
    def notes(self) -> list[str]:
        """What there is to know of the robot: warnings, and numbers taken for others."""
        return [keywords(note) for note in self._native.notes]

    @property
    def is_from_cache(self) -> bool:
        """Whether nothing was searched for and proved now, since it was kept."""
        return self._native.is_from_cache

    @property
    def has_ended_early(self) -> bool:
        """Whether Ctrl-C ended the search: these are the best functions so far."""
        return self._native.has_ended_early

    def to_rust(self, path: Path) -> None:
        """Write the functions as flat Rust, as the command does: the second of two scalars to a
        file that ends in ``_f32``, and the claim that ``certify`` reads beside the first."""
        _ends_in(path, [".rs"], "Rust", "to_c writes a header of C")
        base, ending = os.path.splitext(os.fspath(path))
        for suffix, text in self._native.rust():
            _write(base + suffix + ending, text)
        _write(base + ".claim.json", self._native.claim)

    def to_c(self, path: Path, *, name: str | None = None) -> None:
        """Write the functions as one header of C99, which C++ reads too; proved once more. The
        claim that ``certify`` reads stands beside it.

        Names in it begin with ``name``; with the robot's, if ``None``, which is shortened where
        it is too long for C: a warning says how.
        """
        _ends_in(path, [".h", ".hpp", ".hh"], "C", "to_rust writes Rust")
        header, claim, said = self._native.c(name)
        for warning in said:
            warnings.warn(keywords(warning), stacklevel=2)
        _write(path, header)
        _write(os.path.splitext(os.fspath(path))[0] + ".claim.json", claim)

    def save(self, path: Path) -> None:
        """Write the robot file, and beside it the plan with the programs found.

        ``load(path)`` and the command then search for nothing again. ``path`` ends in
        ``.toml``; the plan's name ends in ``.plan``.
        """
        root, extension = os.path.splitext(os.fspath(path))
        if extension != ".toml":
            raise ValueError(f"path: a robot file's name ends in .toml, found {extension!r}")
        _write(path, self._native.robot_file)
        _write(root + ".plan", self._native.plan)

    def svg(self, q: ArrayLike | None = None) -> str:
        """Draw the arm at a position, zero by default, in two views with its table."""
        import numpy as np

        n = len(self.joints)
        position = np.zeros(n) if q is None else np.asarray(q, dtype=float)
        if position.shape != (n,):
            raise ValueError(f"svg: argument `q` has shape {position.shape}, expected ({n},)")
        return self._native.svg(position.tolist())

    def __repr__(self) -> str:
        functions = ", ".join(self._functions)
        return f"<dalembert.Arm {self.name!r}: {len(self.joints)} joints; {functions}>"

    def _repr_html_(self) -> str:
        """Return the drawing and the table of functions, for notebooks."""
        import html

        counts = ("mul", "add", "sincos")
        rows: list[tuple[str, tuple[Any, ...]]] = []
        rows.append(("th", ("function", "scalar", *counts, "proved")))
        for about in self._native.functions:
            own = [about["counts"][count] for count in counts]
            rows.append(("td", (about["name"], about["scalar"], *own, about["proof"])))
        table = "".join(
            "<tr>" + "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in cells) + "</tr>"
            for tag, cells in rows
        )
        return f"<div>{self.svg()}<table>{table}</table></div>"


class _Loaded:
    """A function whose load is given, of the same name."""

    def __init__(self, function: _dalembert.Function, load: _dalembert.Load) -> None:
        self._function, self._load = function, load
        self.__name__ = function.__name__

    @property
    def arguments(self) -> list[str]:
        """The names of the arguments, in order."""
        return [name for name in self._function.arguments if name != "load"]

    @property
    def results(self) -> list[tuple[str, list[int]]]:
        """The results by name, each with its shape for one state."""
        return self._function.results

    @property
    def dtypes(self) -> list[str]:
        """The dtypes that it computes in."""
        return self._function.dtypes

    def __call__(self, *args: Any, out: Any = None, threads: int = 1, **kwargs: Any) -> Any:
        """Call it as the arm's function, without a load."""
        place = self._function.arguments.index("load")
        if len(args) >= place:
            args = (*args[:place], self._load, *args[place:])
        else:
            kwargs = {**kwargs, "load": self._load}
        return self._function(*args, out=out, threads=threads, **kwargs)

    def __repr__(self) -> str:
        return repr(self._function).replace(", load", "").replace("load, ", "")

    def __reduce__(self) -> Any:
        return _Loaded, (self._function, self._load)


def _with_load(arm: Arm, load: _dalembert.Load) -> Arm:
    return arm._with_load(load)


def _filled(
    named: Mapping[str, Any], places: Mapping[str, Any], size: int, fill: float
) -> NDArray[np.float64]:
    import numpy as np

    array = np.full(size, fill)
    for name, value in named.items():
        if name not in places:
            near = difflib.get_close_matches(name, places, 1)
            meant = f": did you mean {near[0]!r}?" if near else f", but {', '.join(places)}"
            raise ValueError(f"there is no joint {name!r}{meant}")
        array[places[name]] = value
    return array


@functools.cache
def _structure(title: str, fields: tuple[str, ...]) -> Any:
    """Return the named tuple of a function's results, which pickles though no module has it."""
    structure = namedtuple(title, fields)  # type: ignore[misc]
    setattr(structure, "__reduce__", lambda own: (_structured, (title, fields, tuple(own))))
    return structure


def _structured(title: str, fields: tuple[str, ...], values: Iterable[Any]) -> Any:
    return _structure(title, fields)._make(values)


def _reduced(
    loaded: tuple[str, dict[str, Any]], source: str, plan: str, function: str
) -> tuple[Any, ...]:
    """Return what a function is pickled as: all that its arm is loaded from, and its name."""
    import pickle

    name, options = loaded
    return _function, (pickle.dumps((name, source, plan, options)), function)


def _function(arm: bytes, name: str) -> _dalembert.Function:
    return _unpickled(arm).functions[name]


# A pool pickles a function for each of its tasks.
@functools.lru_cache(maxsize=8)
def _unpickled(arm: bytes) -> Arm:
    import pickle

    return _load(*pickle.loads(arm))


def _ends_in(path: Path, endings: list[str], language: str, other: str) -> None:
    extension = os.path.splitext(os.fspath(path))[1]
    if extension and extension.lower() not in endings:
        expected = " or ".join(endings)
        raise ValueError(
            f"path: the name of a file of {language} ends in {expected}, found {extension!r}: {other}"
        )


def _write(path: Path, text: str) -> None:
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def _locked(lock: Mapping[str | int, float | str] | str | None) -> list[tuple[str, str]]:
    if lock is None:
        return []
    if isinstance(lock, str):
        if lock != "*":
            raise ValueError(f'lock: expected "*" or a dictionary of positions, found {lock!r}')
        return [("*", "0")]
    return [(str(joint), str(at)) for joint, at in lock.items()]


def _load(
    name: str,
    source: str | None,
    plan: str | None,
    options: dict[str, Any],
    show: Line | Note | None = None,
) -> Arm:
    try:
        native = _dalembert.load(name, source, plan, options, show)
    except (RuntimeError, ValueError) as error:
        raise type(error)(keywords(str(error))) from None
    return Arm(native, name, options)


def _words(option: str, value: str | Iterable[str] | None) -> list[str] | None:
    if value is None:
        return None
    words = [value] if isinstance(value, str) else list(value)
    for word in words:
        if not isinstance(word, str):
            raise TypeError(f"{option}: expected names, found {word!r}")
    return words


def load(
    source: Path | Mapping[str, Any],
    *,
    base: str | None = None,
    tip: str | Sequence[str] = (),
    tree: bool = False,
    floating: bool = False,
    lock: Mapping[str | int, float | str] | Literal["*"] | None = None,
    without: str | Sequence[str] = (),
    exact: bool = False,
    snap: bool = False,
    ignore_ties: bool = False,
    acceleration: float | str | None = None,
    name: str | None = None,
    outputs: str | Sequence[str] | None = None,
    scalar: str | Sequence[str] | None = None,
    parameters: str | Sequence[str] = (),
    bodies: Sequence[int] = (),
    keep_zeros: bool = False,
    scene: str | None = None,
    formulation: str = "auto",
    effort: str = "quick",
    prefer: str = "accuracy",
    fma: str = "off",
    sincos: str = "auto",
    nan: str = "propagate",
    cache: bool | Path = True,
    progress: bool | None = None,
) -> Arm:
    """Load an arm: search for its functions, prove each, and compile them in memory.

    Parameters
    ----------
    source
        The path of a URDF or of a robot file, or a dictionary with what a robot file has.
    base, tip
        Of a URDF: the link that stands still, and the one whose frame is the hand; of several,
        the joints on the ways to all of them.
    tree
        Of a URDF: take every joint that moves, as arms on a torso or fingers on a hand.
    floating
        Of a URDF: its root moves freely, with everything on it. Velocities, accelerations and
        torques then begin with six numbers of the base, and functions take ``g``, gravity in
        the base's axes; :mod:`dalembert.pose` has it from a quaternion.
    lock
        Of a URDF: joints that stay where they are, each with its position, such as
        ``{"gripper": 0}`` or ``{"elbow": "90deg"}``; a number that is no joint's name counts,
        from 1, those that move, from the root outwards; ``"*"``: all that hang on the chain,
        at zero or the limit nearest to it.
    without
        Of a URDF: links to leave away, with everything that hangs on them.
    exact
        Of a URDF: take every digit as it stands; else 1.57079632679 is π/2.
    snap
        Of a URDF: take rounded numbers for exact ones even where that changes a torque by more
        than 1e-6 of its limit.
    ignore_ties
        Of an MJCF: leave out tendons, loops and equalities, which links that hang on each other cannot have.
    acceleration
        Of a URDF: the limit of acceleration of every joint, rad/s² or m/s²; without one, there
        is none.
    name
        Of a URDF: the name of the robot, instead of the model's.
    outputs
        The functions, of those that :func:`dalembert.outputs` lists, or
        ``"NAME=OUTPUT+OUTPUT"``: one that returns what several do and shares their work.
    scalar
        ``"f64"``, the default, ``"f32"`` or both: arrays of float32 then are computed as
        such.
    parameters
        What is an argument instead of a constant: ``"gravity"``, then functions take ``g``
        (3,); ``"payload"``, then they take ``load``, a :class:`dalembert.Load`, which
        ``arm.load(payload)`` computes of mass, centre of mass and inertia (10,); ``"bodies"``,
        then ``arm.load(bodies)`` computes it of those of all links (k, 10), and
        :meth:`Arm.with_bodies` makes arms with others; ``"armature"`` and ``"viscous"`` friction.
    bodies, keep_zeros
        The links whose bodies are arguments, by their numbers, 0 a base that floats; all if none
        are given. Whether their numbers that are zero stay zero, for fewer operations.
    scene
        A scene of the robot file, with its tolerance, if it has one.
    formulation, effort, prefer, fma, sincos
        Words that ``dalembert generate --help`` explains: ``"quick"`` or ``"thorough"``;
        ``"accuracy"`` or ``"operations"``; ``"auto"``, ``"together"``,
        ``"libm"`` or ``"polynomial"``; with ``fma="on"`` results are not those of other
        machines.
    nan
        ``"propagate"``: a NaN reaches the results that depend on it; ``"raise"``: it is a
        ``ValueError`` that says where it is.
    cache
        Whether work is kept for the next time, or in which folder.
    progress
        Whether to show how far a search is; if ``None``, a thorough one in a terminal or a
        notebook, and of any other, a line after a second. Ctrl-C ends a thorough search with the
        best so far, any other without a result.
    """
    if nan not in ("propagate", "raise"):
        raise ValueError(f'nan: expected "propagate" or "raise", found {nan!r}')
    if exact and snap:
        raise ValueError("exact, snap: expected one of the two: they exclude each other")
    options = {
        "base": base,
        "tip": _words("tip", tip),
        "tree": tree,
        "floating": floating,
        "lock": _locked(lock),
        "without": _words("without", without),
        "exact": exact,
        "snap": snap,
        "ignore_ties": ignore_ties,
        "acceleration": None if acceleration is None else str(acceleration),
        "name": name,
        "outputs": _words("outputs", outputs),
        "scalar": _words("scalar", scalar),
        "parameters": _words("parameters", parameters),
        "bodies": [str(int(link)) for link in bodies],
        "keep_zeros": "on" if keep_zeros else "off",
        "scene": scene,
        "formulation": formulation,
        "effort": effort,
        "prefer": prefer,
        "fma": fma,
        "sincos": sincos,
        "nan": nan,
        "cache": bool(cache),
        "cache_folder": None if isinstance(cache, bool) else os.fspath(cache),
    }
    robot: str | None = None
    if isinstance(source, Mapping):
        path, robot = "the dictionary", text(source)
    else:
        path = os.fspath(source)
        if not os.path.exists(path):
            raise FileNotFoundError(f"{path!r} does not exist")
    show: Line | Note | None = None
    if progress or (progress is None and effort == "thorough" and is_watched()):
        show = Line()
    elif progress is None:
        show = Note(path)
    try:
        return _load(path, robot, None, options, show)
    finally:
        if show is not None:
            show.end()
