"""Runs: the numbers of the command, arrays, threads, signals."""

import _thread
import html
import pickle
import re
import subprocess
import sys
import threading
import time

import lgvi
import numpy as np
import pytest


def csv_of(command, scene, tmp_path, *arguments):
    path = tmp_path / "run.csv"
    done = subprocess.run(
        [command, "run", scene, *arguments, "--all-columns", "--out", path], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    header, *rows = path.read_text().splitlines()
    return header.split(","), np.array([[float(number) for number in row.split(",")] for row in rows])


@pytest.mark.parametrize("file", ["fish-chain", "planar-fish", "swim/eel", "loads/arm", "loads/vehicle"])
@pytest.mark.parametrize("method, step", [("gauss-4", 0.05), ("composition-2", 0.01)])
def test_the_numbers_are_those_of_the_command_bit_for_bit(command, scenes, tmp_path, file, method, step):
    path = scenes / f"{file}.toml"
    names, table = csv_of(
        command, path, tmp_path, "--until", "2", "--method", method, "--step", str(step), "--every", "3"
    )
    run = lgvi.Scene.load(path).simulate(2, method, step, every=3)
    assert list(run.names) == names
    assert np.array_equal(run.table, table, equal_nan=True)


def test_frames_inside_steps_are_those_of_the_command(command, scenes, tmp_path):
    path = scenes / "fish-chain.toml"
    _, table = csv_of(
        command, path, tmp_path, "--until", "3", "--method", "gauss-8", "--every-seconds", "0.1"
    )
    times = np.append(np.arange(30) * 0.1, 3.0)
    scene = lgvi.Scene.load(path)
    assert np.array_equal(scene.simulate(times, exact=True).table, table)
    # Interpolated between eight stages; twice as near as it was found to be.
    near = scene.simulate(times)
    print(np.abs(near.position - scene.simulate(times, exact=True).position).max())
    assert np.abs(near.attitude - scene.simulate(times, exact=True).attitude).max() < 1e-5


def test_the_accuracy_is_that_of_the_command(command, scenes, tmp_path):
    path = scenes / "fish-chain.toml"
    _, table = csv_of(command, path, tmp_path, "--until", "2", "--accuracy", "1e-6", "--every", "1")
    run = lgvi.Scene.load(path).simulate(2, accuracy=1e-6)
    assert np.array_equal(run.table, table)
    assert run.report["accuracy_estimate"] <= 1e-6


def test_arrays_have_their_shapes_and_mean_what_they_say(scene):
    run = scene.simulate(np.linspace(0, 1, 11))
    frames, bodies = 11, 3
    shapes = {
        "t": (), "attitude": (bodies, 3, 3), "quaternion": (bodies, 4), "position": (bodies, 3), "velocity": (3,),
        "angular_velocity": (bodies, 3), "momentum": (3,), "angular_momentum": (3,), "energy": (), "work": (),
    }
    for name, shape in shapes.items():
        array = getattr(run, name)
        assert array.shape == (frames, *shape) and array.dtype == np.float64, name
    w, x, y, z = np.moveaxis(run.quaternion, -1, 0)
    first_row = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1)
    assert np.abs(run.attitude[:, :, 0] - first_row).max() < 1e-14
    assert np.array_equal(run.column("x"), run.position[:, 0, 0])
    assert run.report["steps"] > 0 and run.report["method"] == "gauss-8"
    assert np.abs(run.energy / run.energy[0] - 1).max() < 1e-9
    # What moves is the attitude, by the angular velocity in the body's own frame.
    h = 1e-4
    near = scene.simulate([0.5 - h, 0.5, 0.5 + h])
    rate = np.einsum("bji,bjk->bik", near.attitude[1], (near.attitude[2] - near.attitude[0]) / (2 * h))
    assert np.abs(rate[:, 2, 1] - near.angular_velocity[1, :, 0]).max() < 1e-6


def test_hinges_and_drives_have_names(scenes):
    run = lgvi.Scene.load(scenes / "swim/eel.toml").simulate(1.0)
    assert run.drives and all(drive.torque.shape == (len(run), 3) for drive in run.drives.values())
    assert np.array_equal(run.work, sum(drive.work for drive in run.drives.values()))
    balance = run.energy - run.work
    assert np.abs(balance - balance[0]).max() < 1e-6 * np.abs(run.work).max()
    arm = lgvi.Scene.load(scenes / "loads/arm.toml").simulate(0.5)
    assert arm.joints and all(hinge.angle.shape == (len(arm),) for hinge in arm.joints.values())


def test_a_run_can_be_pickled(scene):
    run = scene.simulate(1)
    thawed = pickle.loads(pickle.dumps(run))
    assert np.array_equal(thawed.table, run.table) and thawed.report == run.report and thawed.scene == scene


def test_other_threads_go_on_meanwhile(scene):
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.01)

    ticker = threading.Thread(target=tick)
    ticker.start()
    begin = time.monotonic()
    scene.simulate(40, "lgvi", every=1000)
    spent = time.monotonic() - begin
    done.set()
    ticker.join()
    # A held interpreter would let it tick once or twice; other work on the machine slows it down by less than this.
    assert len(ticks) > max(3, spent / 0.01 / 10)


def test_runs_in_several_threads_are_equal(scene):
    runs = [None] * 4

    def go(i):
        runs[i] = scene.simulate(5)

    threads = [threading.Thread(target=go, args=[i]) for i in range(len(runs))]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(run.table, runs[0].table) for run in runs)


@pytest.mark.parametrize("arguments", [{"method": "lgvi", "every": 10**6}, {"accuracy": 1e-3}])
def test_ctrl_c_stops_a_run(scene, arguments):
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        scene.simulate(1e5, **arguments)
    assert time.monotonic() - begin < 5
    if "accuracy" not in arguments:
        # No thread goes on, but a rehearsal to its end.
        time.sleep(0.2)
        begin = time.process_time()
        time.sleep(0.5)
        assert time.process_time() - begin < 0.1
    assert scene.simulate(0.1) is not None


def test_progress_is_told_and_may_stop_a_run(scene):
    seen = []
    scene.simulate(30, "lgvi", every=1000, progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == 30

    def stop(t):
        raise RuntimeError(f"enough at {t > 0}")

    with pytest.raises(RuntimeError, match="enough"):
        scene.simulate(1e5, "lgvi", every=10**6, progress=stop)


def test_a_line_of_progress_goes_to_stderr(scene, capsys):
    scene.simulate(1, progress=True)
    assert capsys.readouterr().err.endswith("spent\n")


def test_memory_stays_flat_over_a_thousand_runs(scene):
    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096

    for _ in range(100):
        scene.simulate(1, step=0.25)
    before = resident()
    for _ in range(1000):
        scene.simulate(1, step=0.25)
    # A run keeps 10 kB of numbers: a leak of them would be 10 MB.
    assert resident() - before < 2e6


@pytest.mark.parametrize("to, package", [("to_pandas", "pandas"), ("to_xarray", "xarray"), ("plot", "matplotlib")])
def test_optional_packages(scene, to, package):
    pytest.importorskip(package)
    run = scene.simulate(1)
    made = getattr(run, to)()
    if package == "pandas":
        assert np.array_equal(made["energy"].to_numpy(), run.energy)
    if package == "xarray":
        assert made.position.sel(body=scene.bodies[0]).shape == (len(run), 3)


def test_parquet_keeps_all_digits(scene, tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    run = scene.simulate(1)
    run.to_parquet(tmp_path / "run.parquet")
    assert pandas.read_parquet(tmp_path / "run.parquet").equals(run.to_pandas())


def test_a_run_is_shown_in_the_browser(scene, tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    run = scene.simulate(np.linspace(0, 1, 11))
    picture = run.show(tmp_path / "run.html")
    assert opened == [(tmp_path / "run.html").as_uri()]
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    assert page == picture.page == run.page()
    assert page.startswith("<!doctype html>") and '"frames":11' in page and "order 16" in page


def test_a_run_is_shown_below_a_notebooks_cell(scene, monkeypatch):
    class Shell:
        kernel = object()

    class Notebook:
        get_ipython = Shell

    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setitem(sys.modules, "IPython", Notebook)
    frame = scene.simulate(0.5, step=0.25).show()._repr_html_()
    assert not opened
    # As a browser reads the attribute, it is the page.
    document = re.fullmatch(r'<iframe srcdoc="([^"]*)".*></iframe>', frame, re.DOTALL).group(1)
    assert html.unescape(document) == scene.simulate(0.5, step=0.25).page()
