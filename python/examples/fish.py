"""The three ellipsoids of Lee, Leok & McClamroch for 100 s: what the motion keeps, and where the head goes."""

import lgvi
import numpy as np


def main():
    fish = lgvi.Scene.example()
    run = fish.simulate(np.linspace(0, 100, 1001), "gauss-8", step=0.25)
    print(f"{run.report['steps']} steps of {run.report['time_per_step_us']:.1f} us")
    print(f"the head is at {run.position[-1, 0]} m, and turns at {run.angular_velocity[-1, 0]} rad/s")
    drift = np.abs(run.energy / run.energy[0] - 1).max()
    print(f"energy within {drift:.1e} of itself, rotations orthogonal to {run.report['orthogonality_error_max']:.1e}")
    assert drift < 1e-6 and run.report["orthogonality_error_max"] < 1e-13
    return run


if __name__ == "__main__":
    main()
