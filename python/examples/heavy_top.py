"""A heavy top by its Lagrangian alone: order 8 from one function, and the laws that it is checked by."""

import lgvi
import numpy as np

INERTIA = np.diag([1.0, 1.0, 0.5])  # about the fixed point, kg m^2, in the body's frame
LEVER = np.array([0.0, 0.0, 1.0])  # weight times the mass centre, N m, in the body's frame


def lagrangian(t, R, omega):
    """Kinetic less potential energy, J: R turns the body's frame into that of the ground."""
    return 0.5 * omega @ INERTIA @ omega - (R @ LEVER)[2]


def main():
    top = lgvi.System(lagrangian, group=lgvi.SO3)
    leaning, spin = lgvi.SO3.exp([0.3, 0, 0]), [0, 0, 10]
    assert top.check(leaning, spin)
    motion = top.simulate(100, leaning, spin, "gauss-4", step=0.1)
    vertical = np.einsum("ti,ti->t", motion.g[:, 2], motion.mu)
    print(f"{motion.report['time_per_step_us']:.1f} us a step of order 8, {motion.report['derivatives']}")
    print(f"energy {np.ptp(motion.energy):.1e} J, vertical momentum {np.ptp(vertical):.1e} kg m^2/s over 100 s")
    assert np.ptp(motion.energy) < 1e-6 and np.ptp(vertical) < 1e-11
    return motion


if __name__ == "__main__":
    main()
