"""Dynamics as PyTorch functions, differentiated by our own derivative outputs.

>>> tau = dalembert.torch.inverse_dynamics(arm)(q, qd, qdd)     # doctest: +SKIP

The arm is loaded with the function and with its derivatives, such as
``outputs=["inverse_dynamics", "inverse_dynamics_derivatives"]``. Tensors are on the CPU,
``(n,)`` or ``(N, n)``, of one shape.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
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
    arguments = len(slopes.arguments)

    def tensor(array: Any, like: Any) -> Any:
        return torch.from_numpy(np.ascontiguousarray(array)).to(like.dtype)

    class Dynamics(torch.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(ctx: Any, q: Any, qd: Any, last: Any) -> Any:
            ctx.save_for_backward(q, qd, last)
            arrays = [x.detach().numpy() for x in (q, qd, last)]
            return tensor(function(*arrays), q)

        @staticmethod
        @torch.autograd.function.once_differentiable
        def backward(ctx: Any, gradient: Any) -> Any:
            arrays = [x.detach().numpy() for x in ctx.saved_tensors]
            found = (tensor(slope, gradient) for slope in slopes(*arrays[:arguments]))
            return tuple(torch.einsum("...i,...ij->...j", gradient, slope) for slope in found)

    return Dynamics.apply  # type: ignore[no-any-return]
