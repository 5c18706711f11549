"""Gradients of JAX and PyTorch against differences, where they are installed."""

import importlib
import importlib.util

import numpy as np
import pytest
from conftest import slopes
from numpy.testing import assert_allclose

import dalembert

NAMES = ["inverse_dynamics", "forward_dynamics"]


def states(count=4):
    return [np.random.default_rng(k).normal(size=(count, 3)) for k in range(3)]


@pytest.mark.parametrize("name", NAMES)
def test_jax(planar, name):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    of = getattr(importlib.import_module("dalembert.jax"), name)(planar)
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
    of = getattr(importlib.import_module("dalembert.torch"), name)(planar)
    arrays = states()
    expected = slopes(getattr(planar, name), arrays)
    tensors = [torch.tensor(x, requires_grad=True) for x in arrays]
    of(*tensors).sum().backward()
    scale = max(np.abs(x).max() for x in expected)
    for own, other in zip(tensors, expected):
        assert_allclose(own.grad.numpy() / scale, other / scale, atol=1e-8)


@pytest.mark.parametrize("name", NAMES)
def test_torch_twice(name):
    torch = pytest.importorskip("torch")
    from conftest import robot

    outputs = [name, f"{name}_derivatives", f"{name}_second_derivatives"]
    arm = dalembert.load(robot("planar3r"), outputs=outputs)
    own = importlib.import_module("dalembert.torch")
    of = getattr(own, name)(arm)
    tensors = [torch.tensor(x, requires_grad=True) for x in states(2)]
    assert torch.autograd.gradcheck(of, tensors)
    assert torch.autograd.gradgradcheck(of, tensors)
    one = [x[0].detach() for x in tensors]
    hessian = torch.autograd.functional.hessian(lambda q: of(q, *one[1:]).sum() + (q**2).sum(), one[0])
    rows = [np.eye(3)[k] * 1e-6 for k in range(3)]
    first = getattr(arm, f"{name}_derivatives")
    names = first.arguments

    def slope(q):
        given = dict(zip(of_names, (q, *(x.numpy() for x in one[1:]))))
        return first(*(given[key] for key in names))[0].sum(axis=0) + 2 * q

    of_names = getattr(arm, name).arguments
    q = one[0].numpy()
    expected = np.array([(slope(q + row) - slope(q - row)) / 2e-6 for row in rows])
    assert_allclose(hessian.numpy(), expected, atol=1e-6 * np.abs(expected).max())
    # No third derivatives, and no second ones without their output: errors, not zeros.
    with pytest.raises(RuntimeError, match="third derivatives"):
        (third,) = torch.autograd.grad(of(*tensors).sum(), tensors[0], create_graph=True)
        (third,) = torch.autograd.grad(third.sum(), tensors[0], create_graph=True)
        third.sum().backward()
    less = dalembert.load(robot("planar3r"), outputs=outputs[:2])
    with pytest.raises(AttributeError, match=f"without '{name}_second_derivatives'"):
        torch.autograd.functional.hessian(lambda q: getattr(own, name)(less)(q, *one[1:]).sum(), one[0])


def test_jax_broadcasts_and_says_what_it_lacks(planar):
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    from conftest import robot

    own = importlib.import_module("dalembert.jax")
    of = own.inverse_dynamics(planar)
    q, qd, qdd = states()
    expected = planar.inverse_dynamics(q, qd[0], qdd[:1])
    assert_allclose(of(q, qd[0], qdd[:1]), expected, rtol=0, atol=0)
    given = [x[0].astype(np.float32) for x in (q, qd, qdd)]
    assert_allclose(of(*given), planar.inverse_dynamics(*given), rtol=0, atol=0)
    outputs = ["inverse_dynamics", "inverse_dynamics_derivatives"]
    other = dalembert.load(robot("planar2r"), outputs=outputs)
    with pytest.raises(TypeError, match="arrays are float32, but the arm computes in float64"):
        own.inverse_dynamics(other)(*(x[:2] for x in given))
    with pytest.raises(AttributeError, match="loaded without 'forward_dynamics'"):
        own.forward_dynamics(other)
    with pytest.raises(ValueError, match=r"arrays have shape \(4,\), expected \(..., 3\)"):
        of(np.zeros(4), np.zeros(4), np.zeros(4))


def test_derivatives_are_those_of_pinocchio():
    pin = pytest.importorskip("pinocchio")
    from conftest import urdf

    path = urdf("ur5")
    outputs = ["inverse_dynamics", "inverse_dynamics_derivatives"]
    arm = dalembert.load(path, tip="tool0", exact=True, outputs=outputs)
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    rng = np.random.default_rng(5)
    for _ in range(10):
        q, qd, qdd = (rng.normal(size=model.nv) for _ in range(3))
        slopes = arm.inverse_dynamics_derivatives
        given = {"q": q, "qd": qd, "qdd": qdd}
        found = [slopes(*(given[name] for name in slopes.arguments))]
        if importlib.util.find_spec("jax"):
            import jax

            jax.config.update("jax_enable_x64", True)
            of = importlib.import_module("dalembert.jax").inverse_dynamics(arm)
            found.append(jax.jacrev(of, argnums=(0, 1, 2))(q, qd, qdd))
            found.append(jax.jacfwd(of, argnums=(0, 1, 2))(q, qd, qdd))
        pin.computeRNEADerivatives(model, data, q, qd, qdd)
        mass = np.triu(data.M) + np.triu(data.M, 1).T
        expected = data.dtau_dq, data.dtau_dv + np.diag(model.damping), mass
        for own in found:
            for slope, other in zip(own, expected):
                assert_allclose(slope, other, atol=1e-9 * max(1, np.abs(other).max()))
