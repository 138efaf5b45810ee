"""A double pendulum by its angles: SO(2) x SO(2), two masses of 1 kg on rods of 1 m."""

import lgvi
import numpy as np

G = 9.81  # m/s^2


def lagrangian(t, turns, rates):
    """Each angle is from the vertical down, in the ground's frame."""
    tips = turns @ np.array([0.0, -1.0])  # (2, 2): of each rod from its own start, m
    across = turns @ np.array([1.0, 0.0])  # where they go, for a rate of 1 rad/s
    first = across[0] * rates[0]
    second = first + across[1] * rates[1]
    kinetic = 0.5 * (first @ first + second @ second)
    return kinetic - G * (2 * tips[0, 1] + tips[1, 1])


def main():
    pendulum = lgvi.System(lagrangian, lgvi.SO2**2)
    angles, rates = [2.0, 2.5], [0.0, 0.0]
    assert pendulum.check(angles, rates, step=0.001)
    motion = pendulum.simulate(100, angles, rates, "gauss-6", step=0.02)
    print(f"energy within {np.ptp(motion.energy):.1e} J of {motion.energy[0]:.3f} J over 100 s of chaos")
    assert np.ptp(motion.energy) < 1e-7
    return motion


if __name__ == "__main__":
    main()
