"""Lagrangians written in Python: recorded once, on every group, against scenes and known solutions."""

import pickle

import lgvi
import numpy as np
import pytest
from lgvi._groups import _Layout

INERTIA = np.diag([1.0, 1.0, 0.5])
START = lgvi.SO3.exp([0.3, 0, 0]), [0.0, 0.0, 10.0]


def top(t, R, omega):
    return 0.5 * omega @ INERTIA @ omega - R[2, 2]


def test_a_lagrangian_is_called_once_and_never_again():
    calls = []

    def counted(t, R, omega):
        calls.append(t)
        return top(t, R, omega)

    system = lgvi.System(counted, group=lgvi.SO3)
    for method in ["midpoint", "composition-4", "gauss-4"]:
        motion = system.simulate(1, *START, method, step=0.01)
        assert motion.report["derivatives"] == "derivatives of a recorded value"
    assert system.check(*START) and len(calls) == 1
    # For each axis two products and a sum, one half, and the height; no zero of the matrix.
    assert system.instructions <= 10


@pytest.mark.parametrize(
    "method, step, energy", [("midpoint", 1e-3, 1e-5), ("composition-4", 0.02, 1e-5), ("gauss-2", 0.02, 1e-6), ("gauss-8", 0.1, 1e-12)]
)
def test_a_top_keeps_what_it_must(method, step, energy):
    motion = lgvi.System(top, group=lgvi.SO3).simulate(2, *START, method, step=step)
    vertical = np.einsum("ti,ti->t", motion.g[:, 2], motion.mu)
    assert np.abs(motion.mu[:, 2] - motion.mu[0, 2]).max() < 1e-12
    assert np.abs(vertical - vertical[0]).max() < 1e-12
    assert np.abs(motion.energy - motion.energy[0]).max() < energy
    assert np.abs(np.einsum("tij,tkj->tik", motion.g, motion.g) - np.eye(3)).max() < 1e-13
    assert np.allclose(motion.mu, motion.xi @ INERTIA, atol=1e-13)


@pytest.mark.parametrize("method, order", [("midpoint", 2), ("composition-4", 4), ("composition-6", 6), ("gauss-1", 2), ("gauss-2", 4), ("gauss-3", 6)])
def test_methods_have_their_order(method, order):
    system = lgvi.System(top, group=lgvi.SO3)
    exact = system.simulate([1.0], *START, "gauss-8", step=0.02).g[0]
    steps = np.array([0.025, 0.0125]) if order > 4 else np.array([0.02, 0.01])
    errors = [np.abs(system.simulate([1.0], *START, method, step=h).g[0] - exact).max() for h in steps]
    assert abs(np.log2(errors[0] / errors[1]) - order) < 0.35, errors


def body_of_scene(kind):
    """A free body of the scene below, on SE(3) or on SO(3) x R^3; the potential is that of its weight."""
    mass, inertia, gravity = 2.0, np.array([0.3, 0.5, 0.7]), np.array([0.0, 0.0, -9.81])
    if kind == "SE3":
        def L(t, g, xi):
            omega, v = xi[:3], xi[3:]
            return 0.5 * (omega @ (inertia * omega) + mass * v @ v) + mass * g.translation @ gravity

        start = lgvi.Pose(np.eye(3), np.zeros(3)), [1.0, 2.0, -0.5, 0.4, 0.0, 0.1]
        return lgvi.System(L, lgvi.SE3), start

    def L(t, g, xi):
        (_, x), (omega, v) = g, xi
        return 0.5 * (omega @ (inertia * omega) + mass * v @ v) + mass * x @ gravity

    return lgvi.System(L, lgvi.SO3 * lgvi.Rn(3)), ((np.eye(3), np.zeros(3)), ([1.0, 2.0, -0.5], [0.4, 0.0, 0.1]))


@pytest.mark.parametrize("kind", ["SE3", "SO3 * Rn(3)"])
def test_a_body_moves_as_that_of_a_scene(kind):
    scene = lgvi.Scene.parse(
        "gravity = [0, 0, -9.81]\nfluid.density = 0\nstart.velocity = [0.4, 0, 0.1]\n[[body]]\nname = 'brick'\nmass = 2\n"
        "inertia = [0.3, 0.5, 0.7]\nangular_velocity = [1, 2, -0.5]"
    )
    times = np.linspace(0.1, 2, 20)
    run = scene.simulate(times, "gauss-8", step=0.1)
    system, (g, xi) = body_of_scene(kind)
    motion = system.simulate(times, g, xi, "gauss-8", step=0.1)
    rotation, position = motion.g
    assert np.abs(rotation - run.attitude[:, 0]).max() < 1e-12
    assert np.abs(position - run.position[:, 0]).max() < 1e-11
    assert np.abs(motion.energy - run.energy).max() < 1e-11


def test_planar_groups_agree_with_space():
    mass, inertia = 2.0, 0.7
    spring = 3.0

    def planar(t, g, xi):
        corner = g.rotation @ np.array([0.5, 0.0]) + g.translation
        return 0.5 * (inertia * xi[0] ** 2 + mass * xi[1:] @ xi[1:]) - 0.5 * spring * corner @ corner

    def apart(t, g, xi):
        (turn, x), (rate, v) = g, xi
        corner = turn @ np.array([0.5, 0.0]) + x
        return 0.5 * (inertia * rate**2 + mass * v @ v) - 0.5 * spring * corner @ corner

    times = np.linspace(0.5, 5, 10)
    one = lgvi.System(planar, lgvi.SE2).simulate(times, lgvi.Pose(0.4, [1.0, 0.0]), [0.3, 0.1, 0.2], "gauss-6", step=0.05)
    turn = np.array([[np.cos(0.4), -np.sin(0.4)], [np.sin(0.4), np.cos(0.4)]])
    two = lgvi.System(apart, lgvi.SO2 * lgvi.Rn(2)).simulate(
        times, (0.4, [1.0, 0.0]), (0.3, turn @ [0.1, 0.2]), "gauss-6", step=0.05
    )
    assert np.abs(one.g.rotation - two.g[0]).max() < 1e-10 and np.abs(one.g.translation - two.g[1]).max() < 1e-10
    assert np.abs(one.energy - two.energy).max() < 1e-10


def chain(n, stiffness=5.0):
    def L(t, R, omega):
        # Neighbours' axes are pulled together.
        bend = np.einsum("nij,nij->", R[:-1], R[1:]) if n > 1 else 0.0
        return 0.5 * np.sum(omega**2 * [1.0, 2.0, 2.5]) + stiffness * bend - np.sum(R[:, 2, 0])

    return lgvi.System(L, lgvi.SO3**n)


def test_powers_have_a_first_axis():
    system = chain(4)
    R = lgvi.SO3.exp([0.3, -0.2, 0.1])[None].repeat(4, axis=0)
    xi = np.arange(12.0).reshape(4, 3) / 10
    motion = system.simulate(1, R, xi, "gauss-4", step=0.02)
    assert motion.g.shape == (51, 4, 3, 3) and motion.xi.shape == (51, 4, 3)
    assert np.array_equal(motion.xi[0], xi) or np.abs(motion.xi[0] - xi).max() < 1e-14
    assert np.abs(motion.energy - motion.energy[0]).max() < 1e-9
    # Without springs each is alone.
    loose, single = chain(4, 0.0), chain(1)
    motion = loose.simulate(1, R, xi, "gauss-4", step=0.02)
    alone = single.simulate(1, R[2:3], xi[2:3], "gauss-4", step=0.02)
    assert np.abs(motion.g[:, 2] - alone.g[:, 0]).max() < 1e-10


def test_products_and_powers_of_products_keep_their_order():
    group = lgvi.Rn(2) * (lgvi.SO3 * lgvi.Rn(1)) ** 3 * lgvi.SO2

    def L(t, g, xi):
        (x, (R, y), turn), (v, (omega, w), rate) = g, xi
        kinetic = v @ v + np.sum(omega**2 * [1.0, 2.0, 3.0]) + np.sum(w**2) + 2 * rate**2
        return 0.5 * kinetic - np.sum(R[:, 2, 2]) - 0.5 * (x @ x) * (1 + y[1, 0] ** 2) - turn[0, 0]

    system = lgvi.System(L, group)
    x, y = np.array([0.1, 0.2]), np.array([[0.3], [0.4], [0.5]])
    R = np.stack([lgvi.SO3.exp([0.1 * k, 0.2, 0]) for k in range(3)])
    g, xi = (x, (R, y), 0.6), ([0.1, 0], (np.ones((3, 3)), np.zeros((3, 1))), 0.7)
    turn = np.array([[np.cos(0.6), -np.sin(0.6)], [np.sin(0.6), np.cos(0.6)]])
    xi_arrays = tuple([np.array(xi[0]), tuple(map(np.array, xi[1])), np.array(xi[2])])
    assert abs(system.value(0, g, xi) - L(0, (x, (R, y), turn), xi_arrays)) < 1e-14
    motion = system.simulate(0.5, g, xi, "gauss-4", step=0.05)
    assert [a.shape for a in (motion.g[0], *motion.g[1], motion.g[2])] == [(11, 2), (11, 3, 3, 3), (11, 3, 1), (11, 2, 2)]
    assert np.abs(motion.energy - motion.energy[0]).max() < 1e-9
    assert system.group == pickle.loads(pickle.dumps(system.group)) and system.group.dim == 2 + 3 * 4 + 1


@pytest.mark.parametrize("method, step", [("midpoint", 0.02), ("gauss-4", 0.1), ("composition-4", 0.05)])
def test_sensitivities_are_differences_of_runs(method, step):
    def L(t, g, xi, p):
        (R, x), (omega, v) = g, xi
        swing = p["lever"] * R[2, 2] * x[0]
        return 0.5 * (omega @ (np.array([1.0, 1.5, 2.0]) * omega) + p["mass"] * v @ v) - swing - x @ x

    system = lgvi.System(L, lgvi.SO3 * lgvi.Rn(2), parameters={"mass": 1.5, "lever": 0.7})
    R, xi = lgvi.SO3.exp([0.3, 0.2, 0.1]), (np.array([0.5, -0.3, 0.2]), np.array([0.1, 0.4]))
    g = (R, np.array([0.3, -0.2]))
    found = system.sensitivity(1.0, g, xi, method, step=step)
    assert found.state.shape == (10, 10) and found.parameters.shape == (10, 2) and found.names == ("mass", "lever")

    def end(R, x, xi, system=system):
        motion = system.simulate([1.0], (R, x), xi, method, step=step)
        return np.concatenate([motion.mu[0][0], motion.mu[1][0]]), motion.g[0][0], motion.g[1][0]

    h = 1e-5
    # By the turn of the start; its momentum stays as it was, as the inertia does not depend on it.
    for axis in range(3):
        turn = np.eye(3)[axis] * h
        ahead, behind = (end(R @ lgvi.SO3.exp(s * turn), g[1], xi) for s in (1, -1))
        assert np.abs(found.state[5:, axis] - (ahead[0] - behind[0]) / (2 * h)).max() < 1e-8
        assert np.abs(found.state[3:5, axis] - (ahead[2] - behind[2]) / (2 * h)).max() < 1e-8
        hat = found.g[0].T @ (ahead[1] - behind[1]) / (2 * h)
        assert np.abs(found.state[:3, axis] - [hat[2, 1], hat[0, 2], hat[1, 0]]).max() < 1e-8
    # By the mass, at a fixed momentum.
    ahead, behind = (
        end(R, g[1], (xi[0], xi[1] * 1.5 / m), system.replace({"mass": m})) for m in (1.5 + h, 1.5 - h)
    )
    assert np.abs(found.parameters[5:, 0] - (ahead[0] - behind[0]) / (2 * h)).max() < 1e-8


def test_a_force_does_work():
    system = lgvi.System(lambda t, x, v: 0.5 * v @ v, lgvi.Rn(1), force=lambda t, x, v: -0.2 * v)
    for method, tolerance in [("midpoint", 1e-5), ("gauss-4", 1e-12), ("composition-4", 1e-9)]:
        motion = system.simulate(10, [0.0], [1.0], method, step=0.05)
        assert np.abs(motion.xi[:, 0] - np.exp(-0.2 * motion.t)).max() < tolerance, method


def test_time_and_parameters_enter():
    def L(t, x, v, p):
        return 0.5 * v @ v + p[0] * np.cos(t) * x[0]

    system = lgvi.System(L, lgvi.Rn(1), parameters=[2.0])
    motion = system.simulate(3, [0.0], [0.0], "gauss-4", step=0.1)
    assert np.abs(motion.g[:, 0] - 2 * (1 - np.cos(motion.t))).max() < 1e-11
    later = system.simulate(3, [0.0], [0.0], "gauss-4", step=0.1, t0=np.pi)
    assert np.abs(later.g + motion.g).max() < 1e-11
    double = system.replace({"p[0]": 4.0}).simulate(3, [0.0], [0.0], "gauss-4", step=0.1)
    assert np.abs(double.g - 2 * motion.g).max() < 1e-11


def test_numpy_works_on_tracers():
    functions = [
        np.sin, np.cos, np.tan, np.arcsin, np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.exp, np.log, np.sqrt,
        np.square, np.abs, np.fabs, np.negative, np.reciprocal,
        lambda x: np.arctan2(x, 0.3), lambda x: np.hypot(x, 2.0), lambda x: x**3, lambda x: x**-2, lambda x: x**0.5,
        lambda x: x**1.7, lambda x: 2.0**x, lambda x: 1 / x, lambda x: 3 - x, lambda x: np.float64(2) * x, lambda x: np.sum(np.array([x, x**2])),
        lambda x: np.cross([x, 1, 2], [3, x, 4])[2], lambda x: np.trace(np.array([[x, 1], [2, x]])), lambda x: np.array([x, 1.0]) @ np.array([2.0, x]),
        lambda x: lgvi.where(x < 0.5, x, 2 * x), lambda x: lgvi.where(x >= 0.5, x, 2 * x), lambda x: np.einsum("i,i->", [x, 2.0], [3.0, x]),
    ]
    for k, function in enumerate(functions):
        system = lgvi.System(lambda t, x, v: 0.5 * v @ v + function(x[0]), lgvi.Rn(1))
        for x in (0.3, 0.7):
            expected = function(np.float64(x))
            assert abs(system.value(0, [x], [0.0]) - expected) < 1e-14 * max(1, abs(expected)), k


def test_a_system_can_be_pickled():
    system = lgvi.System(top, group=lgvi.SO3)
    thawed = pickle.loads(pickle.dumps(system))
    assert np.array_equal(thawed.simulate(1, *START, step=0.1).g, system.simulate(1, *START, step=0.1).g)


def test_a_law_that_fails_is_told(capsys):
    degenerate = lgvi.System(lambda t, x, v: 0.5 * v[0] ** 2 - x @ x, lgvi.Rn(2))
    assert not degenerate.check([0.1, 0.2], [1.0, 0.0])
    assert "no inertia" in capsys.readouterr().out


@pytest.mark.parametrize("group", [lgvi.SO2, lgvi.SO2 * lgvi.SO3, lgvi.SO2**2 * lgvi.Rn(1), lgvi.SE2 * lgvi.SO2, lgvi.SE3])
def test_a_drag_slows_every_group_down(group):
    def squared(xi):
        return sum(map(squared, xi)) if isinstance(xi, tuple) else np.sum(np.square(xi))

    def times(c, xi):
        return tuple(times(c, part) for part in xi) if isinstance(xi, tuple) else c * np.asarray(xi)

    # Every coordinate has an inertia of one: what the drag leaves of the energy is known.
    system = lgvi.System(lambda t, g, xi: 0.5 * squared(xi), group, force=lambda t, g, xi: times(-0.5, xi))
    first = _Layout(group).velocity(np.ones(group.dim))
    motion = system.simulate(1.0, group.identity(), first, "gauss-4", step=0.05)
    assert abs(motion.energy[-1] / motion.energy[0] - np.exp(-1.0)) < 1e-12
