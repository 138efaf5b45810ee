"""What runs from Python cost: `python bench.py [--command LGVI] [--wheel WHEEL] [--clusters]` prints the table.

With --command the same runs are timed by the command too; with --wheel it is installed in a clean environment first.
Times are the best of several, in one process, on this machine as it is.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

import lgvi
import numpy as np

sys.path.insert(0, str(Path(__file__).parent / "examples"))
import beam  # noqa: E402
import clusters  # noqa: E402
import heavy_top  # noqa: E402

FISH = lgvi.Scene.example()


def best(work, times=5):
    spent = []
    for _ in range(times):
        begin = time.perf_counter()
        work()
        spent.append(time.perf_counter() - begin)
    return min(spent)


def row(what, value, unit):
    print(f"{what:68}  {value:10.4g} {unit}", flush=True)


def clean_environment(wheel):
    """From nothing to the first numbers."""
    row("size of the wheel", Path(wheel).stat().st_size / 1e6, "MB")
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = f"{folder}/bin/python"
        row("pip install, with numpy", best(lambda: subprocess.run([python, "-m", "pip", "install", "-q", wheel], check=True), 1), "s")
        lines = "import lgvi\nfish = lgvi.Scene.example()\nrun = fish.simulate(10)\nprint(run.position[-1, 0])\nprint(run.energy[-1])"
        row("five lines: a process that runs 10 s of the fish", best(lambda: subprocess.run([python, "-c", lines], check=True, capture_output=True)), "s")


def fish(command):
    arguments = {"method": "gauss-8", "step": 0.25}
    plain = best(lambda: FISH.simulate(100, **arguments))
    row("fish, 100 s by gauss-8, h = 0.25 s, 401 frames", plain * 1e3, "ms")
    run = FISH.simulate(100, **arguments)
    row("  its steps alone", run.report["time_per_step_us"] * run.report["steps"] / 1e3, "ms")
    times = np.linspace(0, 100, 2501)
    row("  2501 frames, interpolated", best(lambda: FISH.simulate(times, **arguments)) * 1e3, "ms")
    row("  2501 frames, exact", best(lambda: FISH.simulate(times, exact=True, **arguments)) * 1e3, "ms")
    short, exact = FISH.simulate(times[:251], **arguments), FISH.simulate(times[:251], exact=True, **arguments)
    row("  largest difference of the two over 10 s", np.abs(short.attitude - exact.attitude).max(), "rad")
    row("  with a step of its own choice", best(lambda: FISH.simulate(100, "gauss-8")) * 1e3, "ms")
    if command:
        line = [command, "run", "--until", "100", "--method", "gauss-8", "--step", "0.25", "--json"]
        seen = [json.loads(subprocess.run(line, check=True, capture_output=True).stdout) for _ in range(5)]
        row("  by the command: its steps alone", min(s["time_per_step_us"] * s["steps"] for s in seen) / 1e3, "ms")
        row("  by the command: the process", best(lambda: subprocess.run(line, check=True, capture_output=True)) * 1e3, "ms")


def ensembles(with_clusters):
    scenes = clusters.sweep(1000)
    for workers in (1, 2):
        spent = best(lambda: lgvi.ensemble(scenes, [0, 5, 10], "gauss-8", step=0.25, workers=workers), 3)
        row(f"1000 scenes of 10 s, {workers} thread{'s' * (workers > 1)}", spent, "s")
    if with_clusters:
        for name in ("joblib", "dask", "ray"):
            try:
                by = getattr(clusters, f"by_{name}")
                row(f"  by {name}, two processes, with their start", best(lambda: by(scenes, 125), 1), "s")
            except ImportError:
                print(f"  {name} is not installed")


def systems():
    top = lgvi.System(heavy_top.lagrangian, lgvi.SO3)
    start = lgvi.SO3.exp([0.3, 0, 0]), [0, 0, 10]
    row("heavy top: recording", best(lambda: lgvi.System(heavy_top.lagrangian, lgvi.SO3)) * 1e6, "us")
    for method, h in (("midpoint", 0.01), ("gauss-4", 0.1), ("gauss-8", 0.25)):
        us = min(top.simulate(400, *start, method, step=h, every=10**6).report["time_per_step_us"] for _ in range(5))
        row(f"heavy top: a step of {method}, h = {h} s", us, "us")
    for nodes in (5, 20):
        row(f"beam of {nodes} nodes: recording", best(lambda: lgvi.System(beam.lagrangian, lgvi.SE3**nodes), 3) * 1e3, "ms")
        system = lgvi.System(beam.lagrangian, lgvi.SE3**nodes)
        for method in ("midpoint", "gauss-4", "gauss-8"):
            us = min(
                system.simulate(0.2, *beam.start(nodes), method, step=5e-4, every=10**6).report["time_per_step_us"]
                for _ in range(3)
            )
            row(f"beam of {nodes} nodes: a step of {method}, h = 0.5 ms", us, "us")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--command")
    parser.add_argument("--wheel")
    parser.add_argument("--clusters", action="store_true")
    options = parser.parse_args()
    if options.wheel:
        clean_environment(options.wheel)
    fish(options.command)
    ensembles(options.clusters)
    systems()


if __name__ == "__main__":
    main()
