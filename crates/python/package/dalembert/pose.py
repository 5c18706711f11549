"""The pose of a base that floats: gravity in its axes, steps and differences, axes of velocities.

>>> g = dalembert.pose.gravity(wxyz=qpos[3:7])                       # doctest: +SKIP
>>> tau = robot.inverse_dynamics(q, qd, qdd, g)                      # doctest: +SKIP

An orientation is given by name, ``xyzw=`` as Pinocchio, ROS and SciPy have it, or ``wxyz=`` as
MuJoCo and Drake: it turns the base's axes into the world's. Velocities are six numbers, linear
over angular, at the base's origin and in its axes where nothing else is said. Arrays may have
leading axes, which are broadcast. Results are those of the Rust crate ``dalembert-pose``, whose
documentation bounds their errors.

``axes`` is ``"mixed"`` (world axes at the base's origin, Pinocchio's ``LOCAL_WORLD_ALIGNED``),
``"world"`` (world axes at the world's origin, Pinocchio's ``WORLD``) or ``"split"`` (linear in
world axes, angular in the base's, MuJoCo's ``qvel``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Union

from . import _dalembert

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Numbers = NDArray[np.float64]
    Given = Union[ArrayLike, None]
    Axes = Literal["mixed", "world", "split"]

_AXES = ("mixed", "world", "split")


def gravity(
    *, xyzw: Given = None, wxyz: Given = None, world: ArrayLike = (0, 0, -9.81)
) -> Numbers:
    """Return the acceleration of gravity in the base's axes, the argument ``g``, m/s²."""
    return rotate_back(world, xyzw=xyzw, wxyz=wxyz)


def rotate(vector: ArrayLike, *, xyzw: Given = None, wxyz: Given = None) -> Numbers:
    """Return a vector of the base's axes in world axes."""
    return _rows("rotate", _pose(xyzw, wxyz), (vector, 3))


def rotate_back(vector: ArrayLike, *, xyzw: Given = None, wxyz: Given = None) -> Numbers:
    """Return a vector of world axes in the base's axes."""
    return _rows("rotate_back", _pose(xyzw, wxyz), (vector, 3))


def integrate(
    position: ArrayLike, step: ArrayLike, *, xyzw: Given = None, wxyz: Given = None
) -> tuple[Numbers, Numbers]:
    """Return the position and the orientation after a step in the base's axes.

    The step is six numbers, a velocity times a time, in m over rad; the orientation has the order
    that was given. It is Pinocchio's ``integrate``.
    """
    import numpy as np

    moved = _rows("integrate", _pose(xyzw, wxyz, position), (step, 6))
    turned = moved[..., 3:]
    return moved[..., :3], turned if wxyz is None else np.roll(turned, 1, axis=-1)


def difference(
    position: ArrayLike,
    to_position: ArrayLike,
    *,
    xyzw: tuple[ArrayLike, ArrayLike] | None = None,
    wxyz: tuple[ArrayLike, ArrayLike] | None = None,
) -> Numbers:
    """Return the step that leads from one pose to another, the shorter way round.

    The orientations of both are given as a pair. It is Pinocchio's ``difference``.
    """
    pair = wxyz if xyzw is None else xyzw
    if (xyzw is None) == (wxyz is None) or pair is None or len(pair) != 2:
        raise TypeError("difference: expected one of xyzw=(from, to) and wxyz=(from, to)")
    first, second = (
        _pose(own if wxyz is None else None, None if wxyz is None else own, place)
        for own, place in zip(pair, (position, to_position))
    )
    return _rows("difference", first, *second)


def velocity_in(
    axes: Axes, velocity: ArrayLike, *, position: ArrayLike = (0, 0, 0), xyzw: Given = None,
    wxyz: Given = None,
) -> Numbers:
    """Return the base's velocity in other axes; ``position`` is read for ``"world"`` alone."""
    return _rows(f"velocity_in {_known(axes)}", _pose(xyzw, wxyz, position), (velocity, 6))


def velocity_from(
    axes: Axes, velocity: ArrayLike, *, position: ArrayLike = (0, 0, 0), xyzw: Given = None,
    wxyz: Given = None,
) -> Numbers:
    """Return the velocity in the base's axes from that in other axes."""
    return _rows(f"velocity_from {_known(axes)}", _pose(xyzw, wxyz, position), (velocity, 6))


def acceleration_in(
    axes: Axes, velocity: ArrayLike, acceleration: ArrayLike, *,
    position: ArrayLike = (0, 0, 0), xyzw: Given = None, wxyz: Given = None,
) -> Numbers:
    """Return the rate of the velocity in other axes, from the rate in the base's axes.

    ``velocity`` is in the base's axes. It is not a rotation: ω × v belongs to it.
    """
    pose = _pose(xyzw, wxyz, position)
    return _rows(f"acceleration_in {_known(axes)}", pose, (velocity, 6), (acceleration, 6))


def acceleration_from(
    axes: Axes, velocity: ArrayLike, acceleration: ArrayLike, *,
    position: ArrayLike = (0, 0, 0), xyzw: Given = None, wxyz: Given = None,
) -> Numbers:
    """Return the rate of the velocity in the base's axes, from that in other axes.

    ``velocity`` is in the base's axes.
    """
    pose = _pose(xyzw, wxyz, position)
    return _rows(f"acceleration_from {_known(axes)}", pose, (velocity, 6), (acceleration, 6))


def _known(axes: str) -> str:
    if axes not in _AXES:
        raise ValueError(f"axes: expected one of {', '.join(_AXES)}, found {axes!r}")
    return axes


def _pose(xyzw: Given, wxyz: Given, position: ArrayLike = (0, 0, 0)) -> list[tuple[Any, int]]:
    import numpy as np

    if (xyzw is None) == (wxyz is None):
        raise TypeError("expected an orientation, one of xyzw= and wxyz=")
    given = np.asarray(wxyz if xyzw is None else xyzw, dtype=float)
    if given.shape[-1:] != (4,):
        raise ValueError(f"an orientation is four numbers, found an array of shape {given.shape}")
    return [(position, 3), (given if wxyz is None else np.roll(given, -1, axis=-1), 4)]


def _rows(operation: str, pose: list[tuple[Any, int]], *others: tuple[Any, int]) -> Numbers:
    """Compute with rows of the pose and the other arguments, whose leading axes are broadcast."""
    import numpy as np

    arrays = []
    for given, length in (*pose, *others):
        array = np.asarray(given, dtype=float)
        if array.shape[-1:] != (length,):
            name = operation.split()[0]
            raise ValueError(f"{name}: expected (..., {length}), found shape {array.shape}")
        arrays.append(array)
    lead = np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    wide = [np.broadcast_to(array, (*lead, array.shape[-1])) for array in arrays]
    rows = np.concatenate(wide, axis=-1)
    found = _dalembert.pose_rows(operation, np.ascontiguousarray(rows.reshape(-1, rows.shape[-1])))
    return np.asarray(found).reshape(*lead, -1)
