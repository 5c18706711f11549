"""Dynamics as PyTorch functions, differentiated by our own derivative outputs.

>>> tau = dalembert.torch.inverse_dynamics(arm)(q, qd, qdd)     # doctest: +SKIP

The arm is loaded with the function and with its derivatives, such as
``outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]``; second derivatives
(``create_graph=True``, ``hessian``) need ``"inverse_dynamics_second_derivatives"`` too.
Tensors are on the CPU, ``(n,)`` or ``(N, n)``, with the same leading axes. Where the base floats,
functions take gravity in its axes too, ``g``, by which alone the orientation enters: a function of
the orientation that PyTorch differentiates gives it. Its second derivatives are not there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import torch

from ._arm import Arm
from ._tangents import lengths


def inverse_dynamics(arm: Arm) -> Callable[..., Any]:
    """Return τ(q, qd, qdd), differentiated by ``inverse_dynamics_derivatives``; where the base
    floats, τ(q, qd, qdd, g)."""
    return _differentiated(arm, "inverse_dynamics")


def forward_dynamics(arm: Arm) -> Callable[..., Any]:
    """Return q̈(q, qd, tau), differentiated by ``forward_dynamics_derivatives``; where the base
    floats, q̈(q, qd, tau, g)."""
    return _differentiated(arm, "forward_dynamics")


def _differentiated(arm: Arm, name: str) -> Callable[..., Any]:
    function, slopes = getattr(arm, name), getattr(arm, f"{name}_derivatives")
    sizes = lengths(arm, name)

    def called(of: Any, tensors: Any, **more: Any) -> list[Any]:
        given = dict(zip(function.arguments, tensors), **more)
        found = of(*(given[argument].detach().numpy() for argument in of.arguments))
        return [torch.from_numpy(own).to(tensors[0].dtype) for own in found]

    def product(matrix: Any, vector: Any) -> Any:
        return torch.einsum("...ij,...j->...i", matrix, vector)

    class Dynamics(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
        """The results x of three arguments."""

        @staticmethod
        def forward(ctx: Any, *tensors: Any) -> Any:
            lead = tensors[0].shape[:-1]
            if [tensor.shape for tensor in tensors] != [(*lead, size) for size in sizes]:
                shapes = ", ".join(str(tuple(tensor.shape)) for tensor in tensors)
                raise ValueError(
                    f"{name}: expected tensors of lengths {sizes} with the same leading axes, "
                    f"found {shapes}"
                )
            ctx.save_for_backward(*tensors)
            found = function(*(tensor.detach().numpy() for tensor in tensors))
            return torch.from_numpy(found).to(tensors[0].dtype)

        @staticmethod
        def backward(ctx: Any, gradient: Any) -> Any:
            return Gradient.apply(gradient, *ctx.saved_tensors)

    class Gradient(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
        """The gradient λᵀ ∂x/∂y of λᵀx by each argument y, which is differentiated once more."""

        @staticmethod
        def forward(ctx: Any, gradient: Any, *tensors: Any) -> Any:
            ctx.save_for_backward(gradient, *tensors)
            found = called(slopes, tensors)
            # A base that floats has no entries of q.
            by = [
                product(slope[..., -size:].transpose(-1, -2), gradient)
                for slope, size in zip(found, sizes)
            ]
            if len(sizes) > 3 and name == "inverse_dynamics":
                by.append(-by[2][..., :3])
            elif len(sizes) > 3:
                by.append(gradient[..., :3].clone())
            return tuple(by)

        @staticmethod
        def backward(ctx: Any, *directions: Any) -> Any:
            if len(sizes) > 3:
                raise RuntimeError(f"{name}: no second derivatives for a base that floats")
            return Curvature.apply(*directions, *ctx.saved_tensors)

    class Curvature(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
        """The slopes of λᵀ Σ ∂x/∂y v_y, for directions v, by λ and by each argument."""

        @staticmethod
        def forward(ctx: Any, v: Any, w: Any, u: Any, gradient: Any, *tensors: Any) -> Any:
            by_gradient = sum(map(product, called(slopes, tensors), (v, w, u)))
            # What the function is linear in, its last argument, has no block of its own.
            second = getattr(arm, f"{name}_second_derivatives")
            qq, qv, vv, lq = called(second, tensors, multiplier=gradient)
            by_q = product(qq, v) + product(qv, w) + product(lq.transpose(-1, -2), u)
            by_qd = product(qv.transpose(-1, -2), v) + product(vv, w)
            return by_gradient, by_q, by_qd, product(lq, v)

        @staticmethod
        def backward(ctx: Any, *_: Any) -> Any:
            raise RuntimeError(f"{name}: third derivatives are not supported")

    return Dynamics.apply  # type: ignore[no-any-return, unused-ignore]
