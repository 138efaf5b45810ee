"""Strokes: what they do, the best ones, and maps."""

import numpy as np
import pytest

import lgvi

LINKS = """
fluid.density = 1000
start.momentum = "zero"
body = [
  { name = "middle", semi_axes = [0.5, 0.05, 0.05] },
  { name = "left",   semi_axes = [0.5, 0.05, 0.05] },
  { name = "right",  semi_axes = [0.5, 0.05, 0.05] },
]
[[joint]]
parent = "middle"
child = "left"
at_parent = [-0.55, 0, 0]
at_child = [0.55, 0, 0]
type = "hinge"
axis = [0, 0, -1]
motion = { amplitude = 0.5, frequency = 0.5, phase = 1.5707963267948966 }
[[joint]]
parent = "middle"
child = "right"
at_parent = [0.55, 0, 0]
at_child = [-0.55, 0, 0]
type = "hinge"
axis = [0, 0, 1]
motion = { amplitude = 0.5, frequency = 0.5 }
"""


@pytest.fixture(scope="module")
def links():
    return lgvi.Scene.parse(LINKS)


def test_a_stroke_moves_as_the_run_does(links):
    told = links.gait(strokes=3)
    assert told["swims"] == "without-momentum"
    run = links.simulate(np.arange(0.0, 6.5, 2.0), "gauss-8", step=0.05)
    # Both err by less than 1e-9: the one by its quadrature, the other by its order 16.
    assert np.allclose(run.position[:, 0], told["path_metres"], atol=1e-8)


def test_the_best_stroke_is_better_and_swims_so(links):
    best = links.best_gait("advance-per-length", order=1, angle=1.5, starts=2)
    assert best.value > best.own > 0
    assert max(value for value in best.starts if value is not None) == best.value
    told = best.scene.gait(strokes=200)
    # What turns comes less far: the distance counts on a way between one stroke and 200. Quadratures are a part in a million off at most.
    one, many = (np.linalg.norm(told["path_metres"][n]) / n / told["length"] for n in (1, 200))
    assert many * (1 - 3e-6) < best.value < one * (1 + 3e-6)
    assert many > 0.99 * one


def test_height_maps_are_arrays(links):
    maps = links.height_maps()
    assert maps.heights.shape == (6, len(maps.second), len(maps.first))
    assert maps.by_area == pytest.approx(maps.exact, abs=0.05)


@pytest.mark.parametrize(
    ("misuse", "message"),
    [
        (lambda scene: scene.gait(strokes=-1), "strokes is -1"),
        (lambda scene: scene.best_gait("speed"), "objective is 'speed'; expected one of advance"),
        (lambda scene: scene.best_gait(order=0), "order is 0"),
        (lambda scene: scene.best_gait(angle=-1.0), "expected an angle > 0"),
        (lambda scene: lgvi.Scene.example().gait(), "nothing|free|stay|never"),
    ],
)
def test_misuses_are_told(links, misuse, message):
    with pytest.raises(ValueError, match=message):
        misuse(links)
