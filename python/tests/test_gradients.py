"""Gradients of JAX and PyTorch against differences, where they are installed."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

NAMES = ["inverse_dynamics", "forward_dynamics"]


def states(count=4):
    return [np.random.default_rng(k).normal(size=(count, 3)) for k in range(3)]


def slopes(function, arrays, step=1e-6):
    """Central differences of Σ of the results by every entry of every argument."""
    found = []
    for k, array in enumerate(arrays):
        own = np.empty_like(array)
        for index in np.ndindex(array.shape):
            ends = []
            for sign in (1, -1):
                moved = [x.copy() for x in arrays]
                moved[k][index] += sign * step
                ends.append(function(*moved).sum())
            own[index] = (ends[0] - ends[1]) / (2 * step)
        found.append(own)
    return found


@pytest.mark.parametrize("name", NAMES)
def test_jax(planar, name):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    import dalembert.jax

    of = getattr(dalembert.jax, name)(planar)
    arrays = states()
    expected = slopes(getattr(planar, name), arrays)
    value = jax.jit(jax.vmap(of))(*arrays)
    assert_allclose(value, getattr(planar, name)(*arrays), rtol=0, atol=0)

    def total(*given):
        return of(*given).sum()

    reverse = jax.jit(jax.vmap(jax.grad(total, argnums=(0, 1, 2))))(*arrays)
    forward = jax.jit(jax.vmap(jax.jacfwd(total, argnums=(0, 1, 2))))(*arrays)
    scale = max(np.abs(x).max() for x in expected)
    for found in (reverse, forward):
        for own, other in zip(found, expected):
            assert_allclose(np.asarray(own) / scale, other / scale, atol=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_torch(planar, name):
    torch = pytest.importorskip("torch")
    import dalembert.torch

    of = getattr(dalembert.torch, name)(planar)
    arrays = states()
    expected = slopes(getattr(planar, name), arrays)
    tensors = [torch.tensor(x, requires_grad=True) for x in arrays]
    of(*tensors).sum().backward()
    scale = max(np.abs(x).max() for x in expected)
    for own, other in zip(tensors, expected):
        assert_allclose(own.grad.numpy() / scale, other / scale, atol=1e-8)


def test_derivatives_are_those_of_pinocchio():
    pin = pytest.importorskip("pinocchio")
    from conftest import urdf

    import dalembert

    path = urdf("ur5")
    arm = dalembert.load(path, exact=True, outputs=["inverse_dynamics_derivatives"])
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    rng = np.random.default_rng(5)
    for _ in range(10):
        q, qd = (rng.normal(size=model.nv) for _ in range(2))
        qdd = rng.normal(size=model.nv)
        given = [q, qd, qdd][: len(arm.inverse_dynamics_derivatives.arguments)]
        found = arm.inverse_dynamics_derivatives(*given)
        pin.computeRNEADerivatives(model, data, q, qd, qdd)
        damping = np.diag(model.damping) if hasattr(model, "damping") else 0
        for own, other in zip(found, (data.dtau_dq, data.dtau_dv + damping, data.M)):
            if other is data.M:
                other = np.triu(other) + np.triu(other, 1).T
            assert_allclose(own, other, atol=1e-9 * max(1, np.abs(other).max()))
