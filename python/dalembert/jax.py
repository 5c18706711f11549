"""Dynamics as JAX functions: inside ``jit``, batched by ``vmap``, differentiated by our own
derivative outputs.

>>> tau = dalembert.jax.inverse_dynamics(arm)          # doctest: +SKIP
>>> jax.jit(jax.vmap(jax.grad(loss)))(q, qd, qdd)      # doctest: +SKIP

The compiled code is called back from XLA on the host (``jax.pure_callback``). The arm is
loaded with the function and with its derivatives, such as ``outputs=["inverse_dynamics",
"inverse_dynamics_derivatives"]``. Without ``jax_enable_x64``, arrays are float32; the arm
computes in float64 unless it was loaded with ``scalar="f32"`` or both.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from ._arm import Arm


def inverse_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return τ(q, qd, qdd), differentiated by ``inverse_dynamics_derivatives``."""
    return _differentiated(arm, "inverse_dynamics")


def forward_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return q̈(q, qd, tau), differentiated by ``forward_dynamics_derivatives``."""
    return _differentiated(arm, "forward_dynamics")


def _differentiated(arm: Arm, name: str) -> Callable[[Any, Any, Any], Any]:
    function, slopes = getattr(arm, name), getattr(arm, f"{name}_derivatives")
    n = len(arm.joints)
    if slopes.arguments not in (["q", "qd"], ["q", "qd", "tau"], ["q", "qd", "qdd"]):
        raise ValueError(f"{name}: parameters that are arguments are not supported here")
    arguments = len(slopes.arguments)

    def called(of: Any, shapes: Any, *arrays: Any) -> Any:
        """Call compiled code from XLA; leading axes are those that vmap added."""

        def run(*given: Any) -> Any:
            found = of(*(np.asarray(x, dtype=_own(of, x)) for x in given))
            return jax.tree.map(lambda x: np.asarray(x, dtype=given[0].dtype), found)

        return jax.pure_callback(run, shapes, *arrays, vmap_method="broadcast_all")

    @jax.custom_jvp
    def value(q: Any, qd: Any, last: Any) -> Any:
        shape = jax.ShapeDtypeStruct((n,), jnp.result_type(q, qd, last))
        return called(function, shape, *_same(q, qd, last))

    @value.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        arrays = _same(*primals)
        shape = jax.ShapeDtypeStruct((n, n), arrays[0].dtype)

        def all_three(*given: Any) -> Any:
            return tuple(slopes(*given[:arguments]))

        all_three.dtypes = slopes.dtypes  # type: ignore[attr-defined]
        found = called(all_three, (shape,) * 3, *arrays)
        change = sum(slope @ tangent for slope, tangent in zip(found, tangents))
        return value(*primals), change

    return value


def _same(*arrays: Any) -> Any:
    """Give all arrays one dtype."""
    dtype = jnp.result_type(*arrays)
    return tuple(jnp.asarray(x, dtype) for x in arrays)


def _own(of: Any, array: Any) -> str:
    """Return the dtype to compute in: the array's, if there is code for it."""
    name = str(array.dtype)
    return name if name in of.dtypes else str(of.dtypes[0])
