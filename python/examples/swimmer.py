"""A swimmer in a perfect fluid: three links on hinges that beat as told. It swims without momentum."""

import lgvi
import numpy as np

SWIMMER = """
title = "three links"
fluid.density = 1000                    # kg/m^3
start.momentum = "zero"

[[body]]
name = "middle"
semi_axes = [0.5, 0.1, 0.3]             # m; without a mass it is neutrally buoyant

[[body]]
name = "front"
semi_axes = [0.5, 0.1, 0.3]

[[body]]
name = "back"
semi_axes = [0.5, 0.1, 0.3]

[[joint]]
parent = "middle"
child = "front"
at_parent = [0.55, 0, 0]                # m, from the mass centre of each
at_child = [-0.55, 0, 0]
type = "hinge"
axis = [0, 0, 1]
motion = { amplitude = 0.8, frequency = 0.5, ramp = 2 }   # rad, Hz, s

[[joint]]
parent = "middle"
child = "back"
at_parent = [-0.55, 0, 0]
at_child = [0.55, 0, 0]
type = "hinge"
axis = [0, 0, 1]
motion = { amplitude = 0.8, frequency = 0.5, phase = 1.5707963, ramp = 2 }
"""


def main():
    swimmer = lgvi.Scene.parse(SWIMMER)
    run = swimmer.simulate(np.linspace(0, 20, 401), "gauss-4")
    way = run.position[-1, 0] - run.position[0, 0]
    print(f"it has come {np.linalg.norm(way):.2f} m far in 20 s, with a momentum of at most {np.abs(run.momentum).max():.1e} kg m/s")
    balance = run.energy - run.work
    print(f"energy less work within {np.ptp(balance):.1e} J, at a work of up to {np.abs(run.work).max():.0f} J")
    assert np.linalg.norm(way) > 0.2 and np.abs(run.momentum).max() < 1e-9
    return run


if __name__ == "__main__":
    main()
