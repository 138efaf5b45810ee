"""A thousand stiffnesses of a tail, on all cores: how far the fish is from where it began, and a picture of it."""

import sys
import time

import lgvi
import numpy as np


def main(count=1000, picture=None):
    fish = lgvi.Scene.example()
    joint = fish.joints[0]
    stiffness = np.geomspace(0.01, 100, count)
    scenes = [fish.replace({f"joint.{joint}.stiffness": k}) for k in stiffness]
    times = np.linspace(0, 10, 41)
    begin = time.perf_counter()
    batch = lgvi.ensemble(scenes, times, "gauss-6", step=0.1)
    print(f"{batch} in {time.perf_counter() - begin:.2f} s")
    head = batch.stack("position")[:, :, 0]
    away = np.linalg.norm(head - head[:, :1], axis=-1)
    print(f"after 10 s the head is {np.nanmin(away[:, -1]):.3f} to {np.nanmax(away[:, -1]):.3f} m from its start")
    if picture is not None:
        from matplotlib.figure import Figure

        figure = Figure(layout="constrained")
        axes = figure.subplots()
        colours = axes.pcolormesh(times, stiffness, away, shading="nearest")
        axes.set(yscale="log", xlabel="t, s", ylabel=f"stiffness of {joint}, N m")
        figure.colorbar(colours, label="distance of the head from its start, m")
        figure.savefig(picture)
    assert not batch.failures
    return batch


if __name__ == "__main__":
    main(picture=sys.argv[1] if len(sys.argv) > 1 else "sweep.png")
