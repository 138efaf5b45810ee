import os
import shutil
import signal
from pathlib import Path

import lgvi
import pytest

# A shell has its background jobs ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)

SCENES = Path(__file__).resolve().parents[2] / "scenes"


@pytest.fixture
def scene():
    """Three ellipsoids on ball joints."""
    return lgvi.Scene.example()


@pytest.fixture
def scenes():
    """The folder of the project's scenes."""
    return SCENES


@pytest.fixture(scope="session")
def command():
    """The command `lgvi`, which `cargo test` has built."""
    found = os.environ.get("LGVI_COMMAND") or shutil.which("lgvi")
    if not found or not Path(found).exists():
        pytest.fail("no command lgvi: `cargo build --bin lgvi`, or name it in LGVI_COMMAND")
    return found
