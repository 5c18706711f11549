"""Slopes of functions of a base that floats, for JAX and PyTorch."""

from __future__ import annotations

from typing import Any

from ._arm import Arm


def lengths(arm: Arm, name: str) -> list[int]:
    """Return the lengths of the arguments q, qd, qdd or tau, and of ``g`` where the base floats."""
    arguments = getattr(arm, name).arguments
    n = len(arm.joints)
    if arm.base is None and len(arguments) == 3:
        return [n, n, n]
    if arm.base is not None and arguments[3:] == ["g"]:
        return [n, n + 6, n + 6, 3]
    raise ValueError(f"{name}: parameters that are arguments are not supported here")


def by_gravity(name: str, slopes: Any, change: Any, xp: Any) -> Any:
    """Return the change of the result with gravity, from the slopes by q, qd and the last argument.

    Gravity is an acceleration of the base upward: torques change by −D of the base's first three
    columns, and accelerations fall with it.
    """
    if name == "inverse_dynamics":
        return -xp.einsum("...ij,...j->...i", slopes[2][..., :3], change)
    rest = slopes[2].shape[-1] - 3
    return xp.concatenate([change, xp.zeros((*change.shape[:-1], rest), dtype=change.dtype)], -1)
