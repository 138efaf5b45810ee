"""A satellite on an orbit about a planet: it swings in the gradient of gravity. SO(3) x R^3, units of the orbit."""

import lgvi
import numpy as np

INERTIA = np.diag([1.0, 1.2, 0.4]) * 1e-4  # about the mass centre, in parts of mass times radius squared
HALF_TRACE = 0.5 * np.trace(INERTIA)


def lagrangian(t, g, xi):
    """A unit mass about a planet with GM = 1: the potential to second order in size over distance."""
    (attitude, x), (omega, v) = g, xi
    distance = np.sqrt(x @ x)
    down = attitude.T @ x / distance  # in the body's frame
    gradient = HALF_TRACE - 1.5 * down @ INERTIA @ down
    return 0.5 * (omega @ INERTIA @ omega + v @ v) + 1 / distance + gradient / distance**3


def main():
    satellite = lgvi.System(lagrangian, lgvi.SO3 * lgvi.Rn(3))
    # The long axis, of least inertia, is 0.2 rad off the direction down; both turn once in an orbit.
    attitude = lgvi.SO3.exp([0, np.pi / 2, 0]) @ lgvi.SO3.exp([0.2, 0, 0])
    g, xi = (attitude, [1.0, 0, 0]), (attitude.T @ [0, 0, 1.0], [0, 1.0, 0])
    assert satellite.check(g, xi, step=0.02)
    motion = satellite.simulate(20 * 2 * np.pi, g, xi, "gauss-6", step=0.2)
    R, x = motion.g
    spin, push = motion.mu
    momentum = np.cross(x, push) + np.einsum("tij,tj->ti", R, spin)
    off = np.degrees(np.arccos(np.abs(np.einsum("ti,ti->t", R[:, :, 2], x / np.linalg.norm(x, axis=1)[:, None])).clip(0, 1)))
    print(f"it swings by up to {off.max():.1f} degrees over 20 orbits; angular momentum within {np.ptp(momentum, axis=0).max():.1e}")
    assert np.ptp(momentum, axis=0).max() < 1e-12 and np.ptp(motion.energy) < 1e-9
    return motion


if __name__ == "__main__":
    main()
