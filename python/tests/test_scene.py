"""Scenes: reading, changing, pickling."""

import pickle

import lgvi
import numpy as np
import pytest

STROKE = """
fluid.density = 1000
[[body]]
name = "head"
semi_axes = [0.8, 0.15, 0.2]
[[body]]
name = "tail.fin"
semi_axes = [0.5, 0.08, 0.15]
[[joint]]
parent = "head"
child = "tail.fin"
at_parent = [-0.9, 0, 0]
at_child = [0.55, 0, 0]
type = "hinge"
axis = [0, 0, 1]
motion = { file = "stroke.csv", repeat = true } # measured
"""


def test_the_example_is_the_papers_scene():
    scene = lgvi.Scene.example()
    assert scene.bodies == ("head", "left-tail", "right-tail") or len(scene.bodies) == 3
    assert len(scene.joints) == 2
    assert "lgvi.Scene" in repr(scene) and scene.bodies[0] in repr(scene)


def test_replace_changes_the_values_and_nothing_else(scene):
    joint = scene.joints[0]
    other = scene.replace({f"joint.{joint}.stiffness": 3.0, "fluid.density": 900})
    assert f"stiffness = 3.0" in other.text and "900" in other.text
    assert other != scene and other.replace({f"joint.{joint}.stiffness": None, "fluid.density": 1000}) is not None
    # Comments stay.
    assert [line for line in other.text.splitlines() if line.startswith("#")] == [
        line for line in scene.text.splitlines() if line.startswith("#")
    ]


def test_replace_takes_arrays_and_dictionaries_and_names_with_dots(tmp_path):
    (tmp_path / "stroke.csv").write_text("t,angle\n0,0\n0.25,0.2\n0.5,0.3\n1,0\n")
    scene = lgvi.Scene.parse(STROKE, tmp_path)
    moved = scene.replace({
        "start.position": np.array([1.0, 2.0, 3.0]),
        "joint.tail.fin.motion": {"amplitude": 0.5, "frequency": 1},
        "body.tail.fin.semi_axes": (0.5, 0.1, np.float64(0.1)),
    })
    assert moved.simulate(0.1).position[0, 0].tolist() == [1, 2, 3]
    assert "# measured" in moved.text


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickled_scene_has_its_tables_with_it(tmp_path, protocol):
    table = tmp_path / "stroke.csv"
    table.write_text("t,angle\n0,0\n0.25,0.2\n0.5,0.3\n1,0\n")
    scene = lgvi.Scene.parse(STROKE, tmp_path)
    before = scene.simulate([0.5, 1.0])
    frozen = pickle.dumps(scene, protocol)
    table.unlink()
    thawed = pickle.loads(frozen)
    assert thawed == scene and hash(thawed) == hash(scene)
    assert np.array_equal(thawed.simulate([0.5, 1.0]).table, before.table)
    # Another value needs no table on the disk either.
    assert thawed.replace({"fluid.density": 900}).simulate(1.0) is not None
    with pytest.raises(ValueError, match="cannot be read"):
        lgvi.Scene.parse(STROKE, tmp_path)


def test_load_names_the_file_in_its_messages(tmp_path):
    path = tmp_path / "boat.toml"
    path.write_text("[fluid]\ndensity = 1000\n[[body]]\nname = 'hull'\nsemi_axes = [2, 0, 0.5]\n")
    with pytest.raises(lgvi.SceneError, match=r"boat\.toml:5:1: body\.semi_axes: .*expected a finite number > 0") as caught:
        lgvi.Scene.load(path)
    assert (caught.value.line, caught.value.column, caught.value.key) == (5, 1, "body.semi_axes")
    thawed = pickle.loads(pickle.dumps(caught.value))
    assert (str(thawed), thawed.key) == (str(caught.value), "body.semi_axes")
    with pytest.raises(FileNotFoundError):
        lgvi.Scene.load(tmp_path / "none.toml")


def test_keys_and_methods_are_told():
    assert "semi_axes" in lgvi.Scene.keys()
    assert lgvi.methods()["gauss-8"]["order"] == 16
