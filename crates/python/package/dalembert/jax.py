"""Dynamics as JAX functions: inside ``jit``, batched by ``vmap``, differentiated by our own
derivative outputs.

>>> tau = dalembert.jax.inverse_dynamics(arm)          # doctest: +SKIP
>>> jax.jit(jax.vmap(jax.grad(loss)))(q, qd, qdd)      # doctest: +SKIP

Compiled programs call the arm's code by XLA's foreign-function interface, on the CPU and
without Python. The arm is loaded with the function and with its derivatives, such as
``outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]``, and in the scalar of the
arrays: those of JAX are float32, so ``scalar="f32"``, unless ``jax_enable_x64`` is set.
An arm that was called lives as long as the process. JAX 0.5 or later.

Where the base floats, its orientation enters by gravity in its axes alone, the last argument ``g``:
a function of the orientation that JAX differentiates gives ``g``, and the slopes by it are exact.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from . import _dalembert
from ._arm import Arm
from ._tangents import by_gravity, lengths

_TARGET = "dalembert"


def inverse_dynamics(arm: Arm) -> Callable[..., Any]:
    """Return τ(q, qd, qdd), differentiated by ``inverse_dynamics_derivatives``; where the base
    floats, τ(q, qd, qdd, g)."""
    return _differentiated(arm, "inverse_dynamics")


def forward_dynamics(arm: Arm) -> Callable[..., Any]:
    """Return q̈(q, qd, tau), differentiated by ``forward_dynamics_derivatives``; where the base
    floats, q̈(q, qd, tau, g)."""
    return _differentiated(arm, "forward_dynamics")


@functools.cache
def _register() -> None:
    handler = jax.ffi.pycapsule(_dalembert.xla_handler())
    jax.ffi.register_ffi_target(_TARGET, handler, platform="cpu")


def _call(function: _dalembert.Function, *arrays: Any) -> Any:
    """Call compiled code; leading axes are those of all arrays, or that vmap adds."""
    dtype = arrays[0].dtype
    number = np.uint64(function.xla(dtype.name))
    lead = arrays[0].shape[:-1]
    shapes = [jax.ShapeDtypeStruct((*lead, *own), dtype) for _, own in function.results]
    _register()
    return jax.ffi.ffi_call(_TARGET, shapes, vmap_method="broadcast_all")(*arrays, number=number)


def _differentiated(arm: Arm, name: str) -> Callable[..., Any]:
    function, slopes = getattr(arm, name), getattr(arm, f"{name}_derivatives")
    sizes = lengths(arm, name)
    arguments = [function.arguments.index(argument) for argument in slopes.arguments]

    @jax.custom_jvp
    def value(*arrays: Any) -> Any:
        return _call(function, *_alike(name, sizes, *arrays))[0]

    @value.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        arrays = _alike(name, sizes, *primals)
        lead = arrays[0].shape[:-1]
        tangents = [jnp.broadcast_to(own, (*lead, own.shape[-1])) for own in tangents]
        found = _call(slopes, *(arrays[place] for place in arguments))
        # A base that floats has no entries of q.
        changes = (
            jnp.einsum("...ij,...j->...i", slope[..., -tangent.shape[-1] :], tangent)
            for slope, tangent in zip(found, tangents)
        )
        change = sum(changes)
        if len(tangents) > 3:
            change += by_gravity(name, found, tangents[3], jnp)
        return value(*primals), change

    def dynamics(*arrays: Any) -> Any:
        return value(*arrays)

    return dynamics


def _alike(name: str, sizes: list[int], *arrays: Any) -> Any:
    """Give all arrays one dtype and the same leading axes."""
    if len(arrays) != len(sizes):
        raise TypeError(f"{name}: expected {len(sizes)} arrays, found {len(arrays)}")
    dtype = jnp.result_type(float, *arrays)
    given = [jnp.asarray(own, dtype) for own in arrays]
    for own, size in zip(given, sizes):
        if own.shape[-1:] != (size,):
            raise ValueError(f"{name}: arrays have shape {own.shape}, expected (..., {size})")
    lead = jnp.broadcast_shapes(*(own.shape[:-1] for own in given))
    return [jnp.broadcast_to(own, (*lead, size)) for own, size in zip(given, sizes)]
