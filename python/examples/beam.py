"""A geometrically exact beam of rigid nodes on SE(3), by its Lagrangian alone.

The strain between neighbours is their relative displacement in the chart of Cayley, over the length of a piece.
"""

import lgvi
import numpy as np

PIECE = 0.1  # m
MASS = 0.044  # kg
INERTIA = np.array([2.9e-6, 3.8e-5, 3.8e-5])  # kg m^2; the first axis is along the beam
STIFFNESS = np.array([8.9e-3, 1.3e-2, 1.3e-2, 400.0, 133.0, 133.0])  # torsion, bending, N m^2; extension, shear, N


def strain(rotation, translation):
    """Of neighbours, (n - 1, 6): torsion and bending, extension and shear; zero of a straight beam."""
    before, after = rotation[:-1], rotation[1:]
    turn = np.einsum("nji,njk->nik", before, after)
    along = np.einsum("nji,nj->ni", before, translation[1:] - translation[:-1])
    share = 2 / (1 + turn[:, 0, 0] + turn[:, 1, 1] + turn[:, 2, 2])
    skew = [turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]]
    omega = np.stack(skew, axis=1) * share[:, None]
    # v such that cay(omega, v) moves by `along`: (1 - hat(omega) / 2) along.
    v = along - 0.5 * np.cross(omega, along)
    straight = np.array([0, 0, 0, 1, 0, 0])
    return np.concatenate([omega, v], axis=1) / PIECE - straight


def lagrangian(t, g, xi):
    kinetic = np.sum(xi**2 * np.concatenate([INERTIA, [MASS] * 3]))
    elastic = PIECE * np.sum(strain(g.rotation, g.translation) ** 2 * STIFFNESS)
    return 0.5 * (kinetic - elastic)


def start(nodes):
    """Bent by one radian along its length, and turning."""
    bend = lgvi.SO3.exp([0, 0, 1 / nodes])
    rotation, translation = [np.eye(3)], [np.zeros(3)]
    for _ in range(nodes - 1):
        translation.append(translation[-1] + rotation[-1] @ [PIECE, 0, 0])
        rotation.append(rotation[-1] @ bend)
    xi = np.zeros((nodes, 6))
    xi[:, 4] = 0.2 * np.cos(0.3 * np.arange(nodes))
    return lgvi.Pose(np.array(rotation), np.array(translation)), xi


def main(nodes=20, method="gauss-4"):
    beam = lgvi.System(lagrangian, lgvi.SE3**nodes)
    print(f"{beam}")
    motion = beam.simulate(0.1, *start(nodes), method, step=5e-4, every=20)
    print(f"{motion.report['time_per_step_us']:.0f} us a step, {motion.report['derivatives']}")
    drift = np.abs(motion.energy / motion.energy[0] - 1).max()
    print(f"energy within {drift:.1e} of itself")
    assert drift < 1e-6
    return motion


if __name__ == "__main__":
    main()
