"""What each misuse is told: the message names what is wrong, and what to do."""

import math
import re

import lgvi
import numpy as np
import pytest
from conftest import SCENES


def top(t, R, omega):
    return 0.5 * omega @ omega - R[2, 2]


def branching(t, R, omega):
    height = R[2, 2]
    if height > 0:  # the line that is told
        height = 0.0
    return 0.5 * omega @ omega - height


def with_math(t, R, omega):
    return 0.5 * omega @ omega - math.sin(R[2, 2])


def with_an_inverse(t, R, omega):
    return 0.5 * omega @ np.linalg.inv(R) @ omega


def mixed(t, R, omega):
    return 0.5 * omega @ omega - np.sin(np.array([R[0, 0], 1.0]))[0]


def into_floats(t, R, omega):
    moment = np.zeros(3)
    moment[0] = omega[0]
    return moment @ moment


kept = []


def with_a_foreign_number(t, R, omega):
    kept.append(omega[0])
    return 0.5 * omega @ omega + kept[0]


SCENE = lgvi.Scene.example()
TOP = lgvi.System(top, lgvi.SO3)
EYE = np.eye(3)

MISUSES = [
    # Runs of scenes.
    (lambda: SCENE.simulate(10, "gauss-9"), ValueError, r"no method is called `gauss-9`; expected one of lgvi, .*gauss-8"),
    (lambda: SCENE.simulate(math.nan), ValueError, r"t, the time to run to in seconds, is nan; expected a finite number > 0"),
    (lambda: SCENE.simulate([0, math.nan, 1]), ValueError, r"t\[1\] is nan; expected finite times"),
    (lambda: SCENE.simulate([0, 2, 1]), ValueError, r"t\[2\] is 1\.0, after 2\.0; expected increasing times: sort them"),
    (lambda: SCENE.simulate([-1, 2]), ValueError, r"t\[0\] is -1\.0; expected times from 0 on"),
    (lambda: SCENE.simulate(np.eye(2)), ValueError, r"t has the shape \(2, 2\); expected a time, or a one-dimensional array"),
    (lambda: SCENE.simulate("10"), TypeError, r"t, the time to run to in seconds, is '10'; expected a number"),
    (lambda: SCENE.simulate(10, step=-1), ValueError, r"step, in seconds, is -1\.0; expected a finite number > 0"),
    (lambda: SCENE.simulate(10, "gauss-8", accuracy=1e-6), ValueError, r"accuracy chooses method and step itself"),
    (lambda: SCENE.simulate(10, every=0), ValueError, r"every, the steps between frames, is 0; expected at least 1"),
    (lambda: SCENE.simulate([1, 2], every=5), ValueError, r"every counts steps .* t gives their times already"),
    (lambda: SCENE.simulate(1e9, step=1e-9), ValueError, r"are 1\.0e18 steps, more than 1e11"),
    (lambda: SCENE.simulate(10, "gauss-8", step=5), lgvi.StepError, r"no solution found for h = 5 s .* try a smaller step"),
    (lambda: SCENE.simulate(1, progress=3), TypeError, r"progress is 3; expected True, or a function"),
    (lambda: lgvi.Scene.load(SCENES / "loads/arm.toml").simulate(1, "composition-8", step=0.5), ValueError, r"its step is at most .* take a shorter step"),
    # Scenes.
    (lambda: SCENE.replace({"joint.fin.stiffness": 1.0}), ValueError, r"joint\.fin\.stiffness: no joint has this name; .* one of: tail-1, tail-2"),
    (lambda: SCENE.replace({"joint.tail-1.stiffnes": 1.0}), lgvi.SceneError, r"joint\.stiffnes: unknown key; expected one of"),
    (lambda: SCENE.replace({"joint.tail-1.stiffness": -1.0}), lgvi.SceneError, r"joint\.stiffness: .*expected"),
    (lambda: SCENE.replace({"fluid.density": 1j}), TypeError, r"fluid\.density: a scene has no value of type complex"),
    (lambda: lgvi.Scene(), TypeError, r"made by Scene\.load\(path\), Scene\.parse\(text\), Scene\.from_urdf\(path\) or Scene\.example\(\)"),
    (lambda: lgvi.Scene.load("[[body]]\nname = 'hull'"), ValueError, r"several lines; .* use Scene\.parse\(text\)"),
    (lambda: lgvi.Scene.parse("fish.toml"), ValueError, r"expected the text of a scene, or use Scene\.load\(path\)"),
    (lambda: lgvi.ensemble(SCENE, 1), TypeError, r"scenes is one lgvi\.Scene; expected several"),
    (lambda: lgvi.ensemble([SCENE], 1, "lgvi", 0.1).stack("positon"), KeyError, r"no column is called 'positon'; expected one of t, "),
    (lambda: lgvi.ensemble([SCENE], 1, "lgvi", 0.1).report("acuracy"), KeyError, r"no entry of a report is called 'acuracy'; expected one of .*method"),
    (lambda: lgvi.ensemble([SCENE, "fish.toml"], 1), TypeError, r"scenes\[1\] is str; expected a lgvi\.Scene"),
    # Lagrangians.
    (lambda: lgvi.System(branching, lgvi.SO3), lgvi.TraceError, r"test_misuse\.py:%d: a branch asks how numbers compare.*lgvi\.where" % (branching.__code__.co_firstlineno + 2)),
    (lambda: lgvi.System(with_math, lgvi.SO3), lgvi.TraceError, r"test_misuse\.py:%d: float\(\) asks for a value: use np\.sin" % (with_math.__code__.co_firstlineno + 1)),
    (lambda: lgvi.System(with_an_inverse, lgvi.SO3), lgvi.TraceError, r"test_misuse\.py:%d: this function of numpy takes floats alone" % (with_an_inverse.__code__.co_firstlineno + 1)),
    (lambda: lgvi.System(mixed, lgvi.SO3), lgvi.TraceError, r"test_misuse\.py:%d: numpy asks a plain number .*apply the function to traced numbers alone" % (mixed.__code__.co_firstlineno + 1)),
    (lambda: lgvi.System(into_floats, lgvi.SO3), lgvi.TraceError, r"test_misuse\.py:%d: .*dtype=object" % (into_floats.__code__.co_firstlineno + 2)),
    (lambda: (lgvi.System(with_a_foreign_number, lgvi.SO3), lgvi.System(with_a_foreign_number, lgvi.SO3)), lgvi.TraceError, r"a number of another recording is used"),
    (lambda: lgvi.System(lambda t, R, omega: omega, lgvi.SO3), TypeError, r"L gives an array of the shape \(3,\); expected one number"),
    (lambda: lgvi.System(lambda t, R, omega: None, lgvi.SO3), TypeError, r"L gives None; expected one number: is there a return\?"),
    (lambda: lgvi.System(lambda R, omega: 0.0, lgvi.SO3), TypeError, r"L does not take 3 arguments; expected L\(t, g, xi\)"),
    (lambda: lgvi.System(top, lgvi.SO3, parameters={"mass": 1.0}), TypeError, r"expected L\(t, g, xi, p\), as parameters are given"),
    (lambda: lgvi.System(top, "SO3"), TypeError, r"group is 'SO3'; expected lgvi\.SO3"),
    (lambda: lgvi.System(top, lgvi.SO3, force=lambda t, R, omega: 1.0), ValueError, r"the force has the shape \(\); expected \(3,\)"),
    (lambda: lgvi.System(top, lgvi.SO3, parameters=[math.inf]), ValueError, r"the parameter p\[0\] is inf; expected a finite number"),
    # Runs of them.
    (lambda: TOP.simulate(1, EYE, [0, 1], step=0.1), ValueError, r"xi has the shape \(2,\); expected \(3,\)"),
    (lambda: TOP.simulate(1, 2 * EYE, [0, 0, 1], step=0.1), ValueError, r"rotation|orthogonal"),
    (lambda: TOP.simulate(1, EYE, [0, math.nan, 1], step=0.1), ValueError, r"the velocity has the number NaN; expected finite numbers"),
    (lambda: TOP.simulate(1, EYE, [0, 0, 1], "lgvi", step=0.1), ValueError, r"no method of a system is called `lgvi`; expected midpoint, composition-P"),
    (lambda: TOP.simulate(1, EYE, [0, 0, 1]), TypeError, r"step"),
    (lambda: lgvi.System(lambda t, x, v: 0.5 * v[0] ** 2, lgvi.Rn(2)).simulate(1, [0, 0], [1, 0], step=0.1), lgvi.StepError, r"step 0 at t = 0 s: the kinetic energy has no inertia along coordinate 1"),
    (lambda: TOP.replace({"mass": 2}), ValueError, r"no parameter is called 'mass'; expected one of none"),
    (lambda: lgvi.SO3 * 3, TypeError, r"SO3 \* 3 is no product of groups; a power is SO3\*\*n"),
    (lambda: TOP.simulate(1, [0, 0, 1], [0, 0, 1], step=0.1), ValueError, r"g has the shape \(3,\); expected \(3, 3\), a rotation matrix: SO3\.exp"),
    (lambda: lgvi.System(lambda t, x, v, p: p["J"] * v[0] ** 2, lgvi.Rn(1), parameters={"mass": 1.0}), KeyError, r"no parameter is called 'J'; expected one of mass"),
    (lambda: lgvi.SO3**0, ValueError, r"the power is 0; expected a whole number of at least 1"),
]


@pytest.mark.parametrize("misuse, kind, message", MISUSES, ids=range(len(MISUSES)))
def test_a_misuse_is_told(misuse, kind, message):
    with pytest.raises(kind) as caught:
        misuse()
    print(f"{type(caught.value).__name__}: {caught.value}")
    assert re.search(message, str(caught.value), re.S), str(caught.value)


def test_a_refused_step_has_fields():
    with pytest.raises(lgvi.StepError) as caught:
        SCENE.simulate(10, "gauss-8", step=5)
    error = caught.value
    assert (error.step, error.t, error.h, error.cause) == (0, 0.0, 5.0, "not-converged")
    assert error.iterations > 0 and error.residual > 0 and 0 < error.suggested_step < 5
