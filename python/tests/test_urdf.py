"""Robots as scenes."""

import subprocess

import lgvi
import numpy as np
import pytest


@pytest.fixture
def turtle(scenes):
    return scenes / "urdf" / "turtle.urdf"


@pytest.mark.filterwarnings("ignore")
def test_a_robot_is_the_scene_that_the_command_writes(turtle, command):
    text = subprocess.run([command, "import", turtle, "--fluid", "1000"], capture_output=True, check=True, text=True).stdout
    scene = lgvi.Scene.from_urdf(turtle, fluid=1000)
    assert scene.text == text
    assert scene.bodies[0] == "hull" and "left/flap" in scene.joints
    assert scene.file == turtle.with_suffix(".toml")
    run = scene.replace({"gravity": None, "joint.left/flap.rate": 1.0}).simulate(0.1)
    assert np.isfinite(run.position).all()


def test_what_is_left_out_is_told(turtle):
    with pytest.warns(UserWarning, match="limits are not enforced, of joints"):
        lgvi.Scene.from_urdf(turtle)


@pytest.mark.filterwarnings("ignore")
def test_the_base_and_the_shapes_are_chosen(turtle):
    assert "added_mass" not in lgvi.Scene.from_urdf(turtle).text
    assert 'parent = "world"' in lgvi.Scene.from_urdf(turtle, base="world").text
    by_inertia = lgvi.Scene.from_urdf(turtle, fluid=1000, shape_from="inertia").text
    assert "of its inertia" in by_inertia and "of its collision" not in by_inertia


def test_what_is_no_robot_is_refused(turtle, tmp_path):
    sliding = tmp_path / "s.urdf"
    sliding.write_text(turtle.read_text().replace("revolute", "prismatic", 1))
    with pytest.raises(lgvi.SceneError, match='"left/flap" is prismatic') as error:
        lgvi.Scene.from_urdf(sliding)
    assert error.value.file == str(sliding)
    with pytest.raises(FileNotFoundError):
        lgvi.Scene.from_urdf(tmp_path / "none.urdf")
    with pytest.raises(ValueError, match='base is "sea"'):
        lgvi.Scene.from_urdf(turtle, base="sea")
    with pytest.raises(ValueError, match="shape_from"):
        lgvi.Scene.from_urdf(turtle, shape_from="visual")
