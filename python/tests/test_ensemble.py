"""Ensembles: equal to single runs whatever the cores, failures as rows, shared among processes."""

import _thread
import multiprocessing
import pickle
import threading
import time
from concurrent.futures import ProcessPoolExecutor

import lgvi
import numpy as np
import pytest

TIMES = [0.0, 0.5, 1.0]


def sweep(scene, count):
    joint = scene.joints[0]
    return [scene.replace({f"joint.{joint}.stiffness": 0.1 * k}) for k in range(count)]


def run_part(scenes):
    return lgvi.ensemble(scenes, TIMES, workers=1)


@pytest.mark.parametrize("workers", [None, 1, 2, 7])
def test_rows_are_single_runs_whatever_the_cores(scene, workers):
    scenes = sweep(scene, 20)
    batch = lgvi.ensemble(scenes, TIMES, workers=workers)
    assert len(batch) == 20 and not batch.failures
    for row, one in zip(batch, scenes):
        assert np.array_equal(row.table, one.simulate(TIMES).table)
    assert batch.stack("position").shape == (20, 3, 3, 3)


def test_a_failure_is_a_row(scene):
    scenes = [scene, scene.replace({"body.%s.angular_velocity" % scene.bodies[0]: [40, 50, 60]}), scene]
    batch = lgvi.ensemble(scenes, TIMES, "gauss-8", step=0.25)
    assert list(batch.failures) == [1] and isinstance(batch.failures[1], lgvi.StepError)
    assert np.array_equal(batch[0].table, batch[2].table)
    with pytest.raises(lgvi.StepError, match="try a smaller step"):
        batch[1]
    energy = batch.stack("energy")
    assert np.isnan(energy[1]).all() and np.isfinite(energy[[0, 2]]).all()
    assert batch.report("steps")[1] is None
    thawed = pickle.loads(pickle.dumps(batch))
    assert np.array_equal(thawed.stack("energy"), energy, equal_nan=True)
    assert thawed.failures[1].suggested_step == batch.failures[1].suggested_step


def test_scenes_of_different_shapes_go_together(scene, scenes):
    other = lgvi.Scene.load(scenes / "one-ellipsoid.toml")
    batch = lgvi.ensemble([scene, other], TIMES)
    assert [len(row.scene.bodies) for row in batch] == [3, 1]
    with pytest.raises(ValueError, match="shapes differ"):
        batch.stack("position")
    assert len(lgvi.ensemble([], TIMES)) == 0


def test_ctrl_c_stops_an_ensemble(scene):
    threading.Timer(0.3, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        lgvi.ensemble(sweep(scene, 50), 1e5, "lgvi", every=10**6)
    # No thread goes on.
    time.sleep(0.5)
    begin = time.process_time()
    time.sleep(0.5)
    assert time.process_time() - begin < 0.1


def test_progress_counts_runs(scene):
    seen = []
    lgvi.ensemble(sweep(scene, 10), TIMES, progress=seen.append)
    assert seen[-1] == 10


@pytest.mark.parametrize("start", ["spawn", "fork"])
def test_a_pool_of_processes_gives_the_same(scene, start):
    scenes = sweep(scene, 8)
    here = lgvi.ensemble(scenes, TIMES)
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start)) as pool:
        parts = list(pool.map(run_part, [scenes[:4], scenes[4:]]))
    there = np.concatenate([part.stack("energy") for part in parts])
    assert np.array_equal(there, here.stack("energy"))
