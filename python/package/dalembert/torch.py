"""Dynamics as PyTorch functions, differentiated by our own derivative outputs.

>>> tau = dalembert.torch.inverse_dynamics(arm)(q, qd, qdd)     # doctest: +SKIP

The arm is loaded with the function and with its derivatives, such as
``outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]``. Tensors are on the CPU,
``(n,)`` or ``(N, n)``, of one shape.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import torch

from ._arm import Arm


def inverse_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return τ(q, qd, qdd), differentiated by ``inverse_dynamics_derivatives``."""
    return _differentiated(arm, "inverse_dynamics")


def forward_dynamics(arm: Arm) -> Callable[[Any, Any, Any], Any]:
    """Return q̈(q, qd, tau), differentiated by ``forward_dynamics_derivatives``."""
    return _differentiated(arm, "forward_dynamics")


def _differentiated(arm: Arm, name: str) -> Callable[[Any, Any, Any], Any]:
    function, slopes = getattr(arm, name), getattr(arm, f"{name}_derivatives")
    if len(function.arguments) != 3:
        raise ValueError(f"{name}: parameters that are arguments are not supported here")
    arguments = [function.arguments.index(argument) for argument in slopes.arguments]

    class Dynamics(torch.autograd.Function):  # type: ignore[misc, unused-ignore]
        @staticmethod
        def forward(ctx: Any, *tensors: Any) -> Any:
            if len({tensor.shape for tensor in tensors}) > 1:
                shapes = ", ".join(str(tuple(tensor.shape)) for tensor in tensors)
                raise ValueError(f"{name}: expected tensors of one shape, found {shapes}")
            ctx.save_for_backward(*tensors)
            found = function(*(tensor.detach().numpy() for tensor in tensors))
            return torch.from_numpy(found).to(tensors[0].dtype)

        @staticmethod
        @torch.autograd.function.once_differentiable
        def backward(ctx: Any, gradient: Any) -> Any:
            arrays = [tensor.detach().numpy() for tensor in ctx.saved_tensors]
            found = slopes(*(arrays[place] for place in arguments))
            slope = (torch.from_numpy(own).to(gradient.dtype) for own in found)
            return tuple(torch.einsum("...i,...ij->...j", gradient, own) for own in slope)

    return Dynamics.apply  # type: ignore[no-any-return, unused-ignore]
