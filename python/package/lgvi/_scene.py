"""Scenes, and runs of them."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _gait
from ._arguments import Progress, plan, reporter
from ._lgvi import NativeScene
from ._lgvi import methods as _methods
from ._run import Run


class Scene:
    """Rigid bodies on joints, in a perfect fluid or in a vacuum: what ``lgvi run`` reads from a TOML file.

    Made by ``Scene.load``, ``Scene.parse``, ``Scene.from_urdf`` or ``Scene.example``, it never changes; ``replace`` gives another one.
    ``print(Scene.keys())`` tells every key of such a file with its unit.

    A scene can be pickled, and then has with it the tables that it reads, such as measured strokes.
    Two scenes are equal where their texts and tables are.
    """

    __slots__ = ("_native",)
    _native: NativeScene

    def __init__(self) -> None:
        raise TypeError("a scene is made by Scene.load(path), Scene.parse(text), Scene.from_urdf(path) or Scene.example()")

    @classmethod
    def _of(cls, native: NativeScene) -> Scene:
        scene = object.__new__(cls)
        scene._native = native
        return scene

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read the scene in a TOML file.

        Raises ``OSError`` where the file cannot be read, and ``lgvi.SceneError`` (a ``ValueError``) where it is
        wrong: ``FILE:LINE:COLUMN: KEY: what is wrong; expected ...``.
        """
        file = os.fspath(path)
        if "\n" in file:
            raise ValueError("path is a text of several lines; expected the name of a file, or use Scene.parse(text)")
        return cls._of(NativeScene.load(file))

    @classmethod
    def parse(cls, text: str, folder: str | os.PathLike[str] = ".") -> Scene:
        """Read a scene from its text; tables that it names are looked for in ``folder``.

        >>> lgvi.Scene.parse('''
        ... fluid.density = 1000                  # kg/m^3
        ... [[body]]
        ... name = "hull"
        ... semi_axes = [2, 0.5, 0.5]             # m
        ... angular_velocity = [0, 0.1, 1]        # rad/s, in the body's frame
        ... ''')
        """
        if not isinstance(text, str):
            raise TypeError(f"text is {type(text).__name__}; expected the text of a scene, or use Scene.load(path)")
        if text.endswith(".toml"):
            raise ValueError(f"text is {text!r}; expected the text of a scene, or use Scene.load(path)")
        return cls._of(NativeScene.parse(text, os.fspath(Path(folder) / "scene.toml")))

    @classmethod
    def example(cls) -> Scene:
        """The three ellipsoids of Lee, Leok & McClamroch (2009), which ``lgvi run`` has built in."""
        return cls._of(NativeScene.example())

    @classmethod
    def from_urdf(
        cls,
        path: str | os.PathLike[str],
        *,
        fluid: float = 0.0,
        base: str | None = None,
        shape_from: str = "collision",
    ) -> Scene:
        """The scene of a robot that a URDF file describes, in its zero pose and at rest, as ``lgvi import`` writes it.

        path        the file.
        fluid       density of the fluid, kg/m^3: 1000 of water, 0 of a vacuum.
        base        what holds the root link: "free" or "world". None: the world where the link is named world or
                    has, with what is fixed to it, no mass; else it is free.
        shape_from  what the ellipsoids are made from that stand for the links in the fluid: "collision", the
                    boxes, cylinders, spheres and capsules, or "inertia". A link without such a shape has that
                    of its inertia; meshes are not read.

        What of the robot is not in the scene, such as limits of joints, is told by a ``UserWarning`` for each
        kind. Raises ``OSError`` where the file cannot be read, and ``lgvi.SceneError`` where the robot has what
        a scene has not: prismatic, planar and mimicking joints, loops, links that move without a mass.

        >>> turtle = lgvi.Scene.from_urdf("turtle.urdf", fluid=1000)
        """
        native, notes = NativeScene.from_urdf(os.fspath(path), float(fluid), base, shape_from)
        for note in notes:
            warnings.warn(note, stacklevel=2)
        return cls._of(native)

    def replace(self, changes: Mapping[str, Any]) -> Scene:
        """The same scene with other values: by the path of a key, with bodies and joints by their names.

        >>> stiff = scene.replace({"joint.tail.stiffness": 3.0, "gravity": [0, 0, -9.81]})
        >>> calm = scene.replace({"body.head.angular_velocity": None})      # takes the key away

        A joint without a name has that of its child. Values are numbers, strings, booleans, lists, arrays and
        dictionaries. Raises ``ValueError`` where nothing has such a name, and ``lgvi.SceneError`` where what
        comes of it is no scene.
        """
        if not isinstance(changes, Mapping):
            raise TypeError(f"changes are {type(changes).__name__}; expected a dictionary of paths and values")
        return self._of(self._native.replace({path: _plain(value) for path, value in changes.items()}))

    def simulate(
        self,
        t: Any,
        method: str | None = None,
        step: float | None = None,
        accuracy: float | None = None,
        *,
        every: int = 1,
        full: bool = False,
        estimate: bool = False,
        exact: bool = False,
        progress: Progress = None,
    ) -> Run:
        """Run the scene from t = 0, and give what was seen as arrays.

        t         a number: the time to run to, s, with a frame at every step.
                  An array: the times of the frames, s, increasing; the last one is the end. Frames inside a
                  step of gauss-S are interpolated between its stages, to O(h^(S+1)) in the step h: see ``exact``.
        method    a name of ``lgvi.methods()``; "gauss-8", of order 16, unless given.
                  gauss-S has S stages and order 2S, composition-P the order P, lgvi the order 1.
        step      the longest step to take, s. Unless given, that of the method, doubled or halved as a rough run
                  finds the scene slower or faster than the example: give one where you run many scenes, as that run
                  may take longer than yours. Such a step is halved where it is refused.
        accuracy  the error to keep until the end, in radians and metres, instead of method and step: a rehearsal
                  of the whole run chooses both. The report has what it estimates.
        every     steps between frames; t = 0 and the end are always there.
        full      takes no reduction: all coordinates are unknowns. The motion is the same.
        estimate  lets two runs in longer steps go along, which estimate the trajectory's error in the report.
        exact     frames inside a step are computed by a shorter step of the method, so that they are as exact as
                  the run; each costs as much as a step. So are those of other methods, and of scenes with drives.
        progress  True for a line on stderr, or a function that is called with the time reached, s.

        Returns an ``lgvi.Run``. Other threads run meanwhile, and Ctrl-C stops the run.

        Raises ``lgvi.StepError`` where a step is refused, with its time, its size and what to try;
        ``ValueError`` and ``TypeError`` of arguments that make no run.

        >>> run = scene.simulate(np.linspace(0, 10, 251), "gauss-8")
        >>> run.quaternion.shape                                          # times, bodies, w x y z
        (251, 3, 4)
        """
        arguments = plan(t, method, step, accuracy, every, full, estimate, exact)
        parts = self._native.simulate(arguments, reporter(progress, arguments[0], "s"))
        return Run._of(parts, self, arguments)

    def gait(self, strokes: int = 10) -> dict[str, Any]:
        """What a stroke of the joints does, as ``lgvi gait --json`` tells it, and where ``strokes`` of them lead.

        The joints repeat a motion: that is the stroke. Without loads and momentum the shape alone leads. With drag, thrust or
        free joints it is the steady stroke, a motion that after a period is as it was, but elsewhere.

        ``net`` has the turn about an axis and the advance along it; ``positive_work_joules`` sums max(0, power) over
        drives and time; ``cost_of_transport`` is that over m g d; ``multipliers`` of a steady stroke tell how a small
        disturbance is after it; ``path_metres`` is where the first body is after each stroke.
        The bodies' coupling through the fluid is left out: 4 to 23 % of the net motion of three links.

        Raises ``ValueError`` where nothing repeats itself, the first body is held, or no steady stroke is found, and
        ``lgvi.StepError`` where a step is refused.

        >>> swimmer.gait()["net"]["advance_metres"]
        """
        if isinstance(strokes, bool) or not isinstance(strokes, int) or not 0 <= strokes < 2**32:
            raise ValueError(f"strokes is {strokes!r}; expected a whole number >= 0")
        return json.loads(_gait.gait_report(self._native, strokes))

    def best_gait(
        self,
        objective: str = "advance-per-length",
        *,
        order: int = 2,
        angle: float = 1.0,
        rate: float | None = None,
        starts: int = 10,
        progress: Progress = None,
    ) -> _gait.Best:
        """The stroke that has most of an objective, from the scene's own stroke and from random ones.

        objective  "advance": the distance in a stroke, m, on a way of about ten body lengths; "advance-per-length": that over the
                   length of the stroke in the metric of the kinetic energy, kg^-1/2; "advance-per-work": that over the
                   positive work, m/J; "turn": the turn of a stroke, rad.
        order      harmonics of each shape coordinate; the period stays the scene's.
        angle      the largest angle of a hinge, or turn of a ball from rest, rad.
        rate       the largest rate of a joint, rad/s; None: any.
        starts     how many strokes the search starts from; the same ones each time.
        progress   True, or a function of the starts done.

        Bodies with semi-axes do not overlap, at several times of the stroke. Angles and rates are within their limits at
        all times. The gradients are exact, and the optimiser is SLSQP. All joints are told. With drag or thrust
        it is the best steady stroke. Raises ``ValueError`` where no stroke within the limits is found.

        >>> best = swimmer.best_gait("advance-per-work")
        >>> best.scene.simulate(10)
        """
        text, best = _gait.search(self._native, objective, order, angle, rate, starts, progress)
        file, files = self._native.state()
        return best._replace(scene=self._of(NativeScene.restore(file, files | {file: text.encode()})))

    def height_maps(self) -> _gait.HeightMaps:
        """The height functions of two shape coordinates around the scene's stroke.

        A small loop in their plane moves the swimmer by its height times its area, and a larger one nearly so, in body
        coordinates whose connection is least over the map. Raises ``ValueError`` of another number of coordinates.
        """
        return _gait.maps(self._native)

    @property
    def title(self) -> str | None:
        """What the scene shows, for people."""
        return self._native.title

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of the bodies, in the order of all arrays; the first is the root of the tree."""
        return tuple(self._native.bodies)

    @property
    def joints(self) -> tuple[str, ...]:
        """The names of the joints."""
        return tuple(self._native.joints)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was corrected in the text, such as a quaternion of few digits."""
        return tuple(self._native.notes)

    @property
    def text(self) -> str:
        """The TOML text."""
        return self._native.text

    @property
    def file(self) -> Path:
        """Where it is from, as messages name it."""
        return Path(self._native.file)

    @staticmethod
    def keys() -> str:
        """The documentation of all keys of a scene's text."""
        return NativeScene.keys()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self._native.state() == other._native.state()

    def __hash__(self) -> int:
        return hash(self.text)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, self._native.state()

    def __repr__(self) -> str:
        title = "" if self.title is None else f" {self.title!r}"
        return f"<lgvi.Scene{title}: bodies {', '.join(self.bodies)}>"


def _restored(file: Path, files: dict[Path, bytes]) -> Scene:
    return Scene._of(NativeScene.restore(file, files))


def _plain(value: Any) -> Any:
    """Arrays as lists, at any depth."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    return value


def methods() -> dict[str, dict[str, Any]]:
    """The integrators by their names: order, stages, default step, what they keep, what they cost.

    >>> lgvi.methods()["gauss-8"]["order"]
    16
    """
    return {method.pop("name"): method for method in json.loads(_methods())}
