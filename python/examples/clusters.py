"""A sweep shared among processes or machines by joblib, Dask or Ray: each maps `lgvi.ensemble` over parts of it, unchanged.

    python clusters.py joblib|dask|ray

Scenes and results can be pickled, so there is nothing else to do. On one machine `lgvi.ensemble` alone is faster.
"""

import sys
from pathlib import Path

import lgvi
import numpy as np

TIMES = [0.0, 5.0, 10.0]


def sweep(count):
    fish = lgvi.Scene.example()
    return [fish.replace({f"joint.{fish.joints[0]}.stiffness": k}) for k in np.linspace(1, 10, count)]


def parts(scenes, size):
    return [scenes[i : i + size] for i in range(0, len(scenes), size)]


def run(scenes):
    """A part, on one thread: the processes share the cores. It gives numbers, which travel fast."""
    return lgvi.ensemble(scenes, TIMES, "gauss-8", step=0.25, workers=1).stack("position")


def by_joblib(scenes, size):
    from joblib import Parallel, delayed

    return np.concatenate(Parallel(n_jobs=2)(delayed(run)(part) for part in parts(scenes, size)))


def by_dask(scenes, size):
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        return np.concatenate(client.gather(client.map(run, parts(scenes, size))))


def by_ray(scenes, size):
    import ray

    # Its workers import this module too.
    beside = {"env_vars": {"PYTHONPATH": str(Path(__file__).parent)}}
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, runtime_env=beside)
    try:
        remote = ray.remote(run)
        return np.concatenate(ray.get([remote.remote(part) for part in parts(scenes, size)]))
    finally:
        ray.shutdown()


def main(kind="joblib", count=40, size=10):
    scenes = sweep(count)
    here = lgvi.ensemble(scenes, TIMES, "gauss-8", step=0.25).stack("position")
    there = {"joblib": by_joblib, "dask": by_dask, "ray": by_ray}[kind](scenes, size)
    assert np.array_equal(here, there)
    print(f"{kind}: {count} runs in parts of {size}, equal to those of one process bit for bit")
    return there


if __name__ == "__main__":
    main(*sys.argv[1:2])
