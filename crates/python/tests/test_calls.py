"""Arrays in and out."""

import threading

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal


def states(shape, seed=1, dtype=float):
    return [np.random.default_rng(seed + k).normal(size=shape).astype(dtype) for k in range(3)]


def one_by_one(function, *arrays):
    return np.array([function(*rows) for rows in zip(*arrays)])


def test_one_state(planar):
    q, qd, qdd = states(3)
    tau = planar.inverse_dynamics(q, qd, qdd)
    assert tau.shape == (3,) and tau.dtype == np.float64
    assert_array_equal(tau, planar.inverse_dynamics(q, qdd=qdd, qd=qd))
    assert_array_equal(tau, planar.inverse_dynamics(list(q), tuple(qd), qdd))
    assert planar.inertia(q).shape == (3, 3)


@pytest.mark.parametrize("count", [0, 1, 2, 3, 7, 1000])
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_many_states_have_the_bits_of_one(planar, count, dtype):
    arrays = states((count, 3), dtype=dtype)
    tau = planar.inverse_dynamics(*arrays)
    assert tau.shape == (count, 3) and tau.dtype == dtype
    assert_array_equal(tau, one_by_one(planar.inverse_dynamics, *arrays).reshape(count, 3))


def test_strides_change_no_bit(planar):
    arrays = states((40, 3))
    expected = planar.inverse_dynamics(*arrays)
    columns = [np.asfortranarray(x) for x in arrays]
    wide = [np.repeat(x, 2, axis=1)[:, ::2] for x in arrays]
    backwards = [x[::-1].copy()[::-1] for x in arrays]
    odd = []
    for x in arrays:
        raw = np.zeros(x.nbytes + 1, dtype=np.uint8)[1:]
        view = raw.view(np.float64).reshape(x.shape)
        view[...] = x
        odd.append(view)
    for other in (columns, wide, backwards, odd):
        assert_array_equal(planar.inverse_dynamics(*other), expected)
    assert_array_equal(planar.inverse_dynamics(*(x[::2] for x in arrays)), expected[::2])


def test_broadcasting(planar):
    q, qd, qdd = states((5, 3))
    for shapes in [((5, 3), (3,), (1, 3)), ((2, 5, 3), (5, 3), (2, 1, 3)), ((1, 3), (3,), (3,))]:
        arrays = [np.resize(x, shape) for x, shape in zip((q, qd, qdd), shapes)]
        wide = np.broadcast_arrays(*arrays)
        flat = [x.reshape(-1, 3) for x in wide]
        expected = one_by_one(planar.inverse_dynamics, *flat).reshape(wide[0].shape)
        assert_array_equal(planar.inverse_dynamics(*arrays), expected)


def test_several_results_are_a_named_tuple(planar):
    q, qd, _ = states((4, 3))
    result = planar.manipulator_equation(q, qd)
    assert result._fields == ("d", "h", "c")
    assert [x.shape for x in result] == [(4, 3, 3), (4, 3), (4, 3)]
    assert_allclose(result.c, planar.gravity(q), rtol=1e-13)
    for k in range(4):
        for many, one in zip(result, planar.manipulator_equation(q[k], qd[k])):
            assert_array_equal(many[k], one)


def test_out(planar):
    arrays = states((9, 3))
    expected = planar.inverse_dynamics(*arrays)
    for out in (
        np.empty((9, 3)),
        np.empty((3, 9)).T,
        np.empty((9, 6))[:, ::2],
        np.empty((18, 3))[::-2],
    ):
        assert planar.inverse_dynamics(*arrays, out=out) is out
        assert_array_equal(out, expected)
    out = np.empty(3)
    planar.inverse_dynamics(*(x[0] for x in arrays), out=out)
    assert_array_equal(out, expected[0])
    parts = tuple(np.empty(s) for s in [(9, 3, 3), (9, 3), (9, 3)])
    planar.manipulator_equation(arrays[0], arrays[1], out=parts)
    for part, expected in zip(parts, planar.manipulator_equation(arrays[0], arrays[1])):
        assert_array_equal(part, expected)


def test_out_may_be_an_argument(planar):
    for change in (lambda x: x, lambda x: x[:, ::-1], lambda x: x[::-1]):
        arrays = states((9, 3))
        expected = planar.inverse_dynamics(*arrays)
        out = change(arrays[0])
        planar.inverse_dynamics(*arrays, out=out)
        assert_array_equal(out, expected)
    q = states(3)[0]
    expected = planar.gravity(q)
    planar.gravity(q, out=q)
    assert_array_equal(q, expected)
    same, q = np.empty(3), states(3)[0]
    planar.manipulator_equation(q, q, out=(np.empty((3, 3)), same, same))
    # The last one written is what stays.
    assert_array_equal(same, planar.manipulator_equation(q, q).c)


def test_arrays_that_no_memory_holds(planar):
    """NumPy's own error, and no panic."""
    q = np.broadcast_to(np.zeros(3), (2**40, 3))
    with pytest.raises(MemoryError):
        planar.gravity(q)
    with pytest.raises(MemoryError):
        planar.manipulator_equation(q, np.zeros(3))
    with pytest.raises((MemoryError, ValueError)):
        planar.inverse_dynamics(q[:, None], q, q)


def test_threads_change_no_bit(planar):
    arrays = states((20_001, 3))
    expected = planar.inverse_dynamics(*arrays)
    assert_array_equal(planar.inverse_dynamics(*arrays, threads=3), expected)


def test_other_threads_run_meanwhile(planar):
    arrays = states((50_000, 3))
    expected = planar.inverse_dynamics(*arrays)
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(planar.inverse_dynamics(*arrays)))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for tau in found:
        assert_array_equal(tau, expected)


def test_no_number_propagates(planar):
    q, qd, qdd = states((3, 3))
    q[1, 2] = np.nan
    tau = planar.inverse_dynamics(q, qd, qdd)
    assert np.isnan(tau[1]).any() and np.isfinite(tau[[0, 2]]).all()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([np.zeros(2)] * 3, "argument `q` has shape (2,), expected (3,) or (N, 3)"),
        ([np.zeros(3), np.zeros((2, 4)), 0], "argument `qd` has shape (2, 4), expected (3,)"),
        ([np.zeros((5, 3)), np.zeros((4, 3)), np.zeros(3)], "`qd` has shape (4, 3)"),
        ([np.zeros(3), np.zeros(3), 0.0], "argument `qdd` has shape (), expected (3,)"),
    ],
)
def test_wrong_shapes_are_named(planar, arguments, words):
    with pytest.raises(ValueError) as error:
        planar.inverse_dynamics(*arguments)
    assert words in str(error.value)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([np.zeros(3, complex), np.zeros(3), np.zeros(3)], "`q` is of dtype complex128"),
        ([np.zeros(3), "abc", np.zeros(3)], "argument `qd`"),
        ([np.zeros(3)] * 2, "argument `qdd` is missing"),
        ([np.zeros(3)] * 4, "expected 3 arguments, 4 were given"),
        ([np.zeros(3, np.longdouble), np.zeros(3), np.zeros(3)], "expected numbers that are float64"),
    ],
)
def test_wrong_types_are_named(planar, arguments, words):
    with pytest.raises(TypeError) as error:
        planar.inverse_dynamics(*arguments)
    assert words in str(error.value)


def test_wrong_names_and_outs(planar):
    q = np.zeros(3)
    with pytest.raises(TypeError, match="no argument `tau`"):
        planar.gravity(tau=q)
    with pytest.raises(TypeError, match="given twice"):
        planar.gravity(q, q=q)
    with pytest.raises(ValueError, match=r"`out` for `c` has shape \(4,\), expected \(3,\)"):
        planar.gravity(q, out=np.zeros(4))
    with pytest.raises(TypeError, match="must be an array of float64"):
        planar.gravity(q, out=np.zeros(3, np.float32))
    with pytest.raises(ValueError, match="`threads` is 0, expected 1 or more"):
        planar.gravity(q, threads=0)
    with pytest.raises(ValueError, match="`out` has 1 arrays, expected 3"):
        planar.manipulator_equation(q, q, out=(q,))
    frozen = np.zeros(3)
    frozen.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        planar.gravity(q, out=frozen)
