"""Dynamics as JAX functions: inside ``jit``, batched by ``vmap``, differentiated by our own
derivative outputs.

>>> tau = dalembert.jax.inverse_dynamics(arm)          # doctest: +SKIP
>>> jax.jit(jax.vmap(jax.grad(loss)))(q, qd, qdd)      # doctest: +SKIP

Compiled programs call the arm's code by XLA's foreign-function interface, on the CPU and
without Python. The arm is loaded with the function and with its derivatives, such as
``outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]``, and in the scalar of the
arrays: those of JAX are float32, so ``scalar="f32"``, unless ``jax_enable_x64`` is set.
An arm that was called lives as long as the process. JAX 0.5 or later.
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

_TARGET = "dalembert"


def inverse_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return τ(q, qd, qdd), differentiated by ``inverse_dynamics_derivatives``."""
    return _differentiated(arm, "inverse_dynamics")


def forward_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return q̈(q, qd, tau), differentiated by ``forward_dynamics_derivatives``."""
    return _differentiated(arm, "forward_dynamics")


@functools.cache
def _register() -> None:
    handler = jax.ffi.pycapsule(_dalembert.xla_handler())
    jax.ffi.register_ffi_target(_TARGET, handler, platform="cpu")


def _call(function: _dalembert.Function, n: int, *arrays: Any) -> Any:
    """Call compiled code; leading axes are those of all arrays, or that vmap adds."""
    shape = arrays[0].shape
    if shape[-1:] != (n,):
        raise ValueError(f"{function.__name__}: arrays have shape {shape}, expected (..., {n})")
    dtype = arrays[0].dtype
    number = np.uint64(function.xla(dtype.name))
    shapes = [jax.ShapeDtypeStruct((*shape[:-1], *own), dtype) for _, own in function.results]
    _register()
    return jax.ffi.ffi_call(_TARGET, shapes, vmap_method="broadcast_all")(*arrays, number=number)


def _differentiated(arm: Arm, name: str) -> Callable[[Any, Any, Any], Any]:
    function, slopes = getattr(arm, name), getattr(arm, f"{name}_derivatives")
    if len(function.arguments) != 3:
        raise ValueError(f"{name}: parameters that are arguments are not supported here")
    n = len(arm.joints)
    arguments = [function.arguments.index(argument) for argument in slopes.arguments]

    @jax.custom_jvp
    def value(*arrays: Any) -> Any:
        return _call(function, n, *_alike(*arrays))[0]

    @value.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        arrays = _alike(*primals)
        found = _call(slopes, n, *(arrays[place] for place in arguments))
        changes = (
            jnp.einsum("...ij,...j->...i", slope, jnp.broadcast_to(tangent, arrays[0].shape))
            for slope, tangent in zip(found, tangents)
        )
        return value(*primals), sum(changes)

    def dynamics(q: Any, qd: Any, last: Any) -> Any:
        return value(q, qd, last)

    return dynamics


def _alike(*arrays: Any) -> Any:
    """Give all arrays one dtype and one shape."""
    dtype = jnp.result_type(float, *arrays)
    return jnp.broadcast_arrays(*(jnp.asarray(x, dtype) for x in arrays))
