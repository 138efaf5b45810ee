"""The examples run, and keep what they say."""

import importlib.util
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["fish", "heavy_top", "beam", "double_pendulum", "satellite", "swimmer"])
def test_an_example_runs(name):
    assert example(name).main() is not None


def test_the_sweep_runs_with_its_picture(tmp_path):
    try:
        import matplotlib  # noqa: F401

        picture = tmp_path / "sweep.png"
    except ImportError:
        picture = None
    example("sweep").main(count=100, picture=picture)
    assert picture is None or picture.stat().st_size > 10_000


@pytest.mark.parametrize("kind", ["joblib", "dask", "ray"])
def test_a_cluster_gives_the_same(kind):
    pytest.importorskip(kind)
    example("clusters").main(kind)


def test_every_example_is_run_here():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == {
        "beam", "clusters", "double_pendulum", "fish", "heavy_top", "satellite", "swimmer", "sweep",
    }
