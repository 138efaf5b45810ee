"""What help() and the page say is there, and true."""

import inspect
import re
from pathlib import Path

import lgvi
import pytest

README = Path(__file__).resolve().parents[1] / "README.md"
REPOSITORY = README.parents[1]


@pytest.mark.parametrize("name", lgvi.__all__)
def test_everything_public_has_help(name):
    thing = getattr(lgvi, name)
    assert inspect.getdoc(thing)
    if inspect.isclass(thing):
        for member, value in vars(thing).items():
            if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod, staticmethod))):
                assert inspect.getdoc(getattr(thing, member)), f"{name}.{member}"


@pytest.mark.parametrize(
    "function", [lgvi.Scene.simulate, lgvi.Scene.from_urdf, lgvi.ensemble, lgvi.System.simulate, lgvi.System.__init__], ids=lambda f: f.__qualname__
)
def test_every_argument_is_told(function):
    told = inspect.getdoc(function) or ""
    if function is lgvi.System.__init__:
        told = inspect.getdoc(lgvi.System)
    for argument in list(inspect.signature(function).parameters)[1:]:
        assert re.search(rf"\b{argument}\b", told), argument


def test_the_package_is_typed():
    assert (Path(lgvi.__file__).parent / "py.typed").exists()
    assert (Path(lgvi.__file__).parent / "_lgvi.pyi").exists()


def test_the_page_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = [block for block in re.findall(r"```python\n(.*?)```", README.read_text(), re.S) if "Client" not in block]
    assert len(code) == 3
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        code[0] = re.sub(r"run\.plot.*", "", code[0])
    # Fewer scenes, for the time.
    names: dict[str, object] = {}
    for block in code:
        exec(block.replace("1000)]", "20)]"), names)
    assert names["batch"].stack("position").shape == (20, 3, 3, 3)


@pytest.mark.parametrize("page", ["README.md", "docs/python.md", "docs/urdf.md"])
def test_the_blocks_of_a_page_run(page, tmp_path, monkeypatch):
    (tmp_path / "scenes").symlink_to(REPOSITORY / "scenes")
    monkeypatch.chdir(tmp_path)
    code = re.findall(r"```python\n(.*?)```", (REPOSITORY / page).read_text(encoding="utf-8"), re.S)
    assert code
    for block in code:
        exec(block.replace("1000)]", "20)]"), {})
