"""What a run gives."""

from __future__ import annotations

import html
import json
import os
import sys
import tempfile
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._arguments import needed

if TYPE_CHECKING:
    from ._scene import Scene

Array = NDArray[np.float64]


class Hinge(NamedTuple):
    """A free hinge of a run.

    angle  (T,)  not wrapped, rad
    rate   (T,)  rad/s
    """

    angle: Array
    """Not wrapped, rad, (T,)."""
    rate: Array
    """rad/s, (T,)."""


class Drive(NamedTuple):
    """What moves a joint as told, its torque, damper or servo, in a run.

    work    (T,)    done on the bodies since the start, J
    power   (T,)    the mean since the frame before, W; zero in the first frame
    torque  (T, 3)  likewise a mean: on the child, in the reference frame, N m

    Means tell what happened between two frames. For the course in time give many frames.
    """

    work: Array
    """Since the start, J, (T,)."""
    power: Array
    """The mean since the frame before, W, (T,)."""
    torque: Array
    """The mean on the child since the frame before, in the reference frame, N m, (T, 3)."""


class Picture:
    """A moving picture of a run, as ``Run.show`` gives it; a notebook shows it below the cell."""

    def __init__(self, page: str) -> None:
        self.page = page

    def _repr_html_(self) -> str:
        page = html.escape(self.page, quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 640px; border: 0" title="a run"></iframe>'


def _is_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return hasattr(shell, "kernel")


class Run:
    """A run of a scene: T frames of N bodies.

    All arrays are of doubles. The reference frame is that of the scene; a body's frame has its origin in the mass
    centre. A run can be pickled.

    t                 (T,)          time, s
    attitude          (T, N, 3, 3)  rotation matrices, from body to reference frame
    quaternion        (T, N, 4)     the same as w, x, y, z, with a continuous sign
    position          (T, N, 3)     mass centres in the reference frame, m
    velocity          (T, 3)        of the first body's mass centre in the reference frame, m/s
    angular_velocity  (T, N, 3)     in each body's own frame, rad/s
    momentum          (T, 3)        linear, of bodies and fluid, kg m/s
    angular_momentum  (T, 3)        of bodies and fluid about the origin, kg m^2/s
    energy            (T,)          kinetic and potential, of bodies and fluid, J
    work              (T,)          of all drives, dampers, drag and thrust since the start, J
    joints            names -> Hinge: the free hinges; one that moves as told is where the scene tells it to be
    drives            names -> Drive: what moves as told, has a torque, a damper or a servo
    report            names -> values: cost of the steps, errors of what the motion keeps. The largest power and
                      torque of a drive are those of means over a step: they grow a little with shorter steps.
    names, table      (T, C)        all columns as the command's CSV has them, and their names

    The energy less the work is what a motion keeps.
    """

    def __init__(
        self,
        scene: Scene,
        names: list[str],
        table: Array,
        attitude: Array,
        report: dict[str, Any],
        arguments: tuple[Any, ...],
    ) -> None:
        self.scene = scene
        self._arguments = arguments
        self.names = tuple(names)
        self.table = table
        self.attitude = attitude
        self.report = report
        self._place = {name: k for k, name in enumerate(self.names)}

    @classmethod
    def _of(cls, parts: dict[str, Any], scene: Scene, arguments: tuple[Any, ...]) -> Run:
        report = json.loads(parts["report"])
        return cls(scene, parts["names"], parts["table"], parts["attitude"], report, arguments)

    def column(self, name: str) -> Array:
        """A column by its name, such as ``"tail.wx"``: (T,)."""
        try:
            return self.table[:, self._place[name]]
        except KeyError:
            raise KeyError(f"no column is called {name!r}; expected one of {', '.join(self.names)}") from None

    def _columns(self, names: str, of: str | None = None) -> Array:
        prefix = "" if of is None else f"{of}."
        return np.stack([self.column(prefix + name) for name in names.split()], axis=-1)

    def _of_bodies(self, names: str) -> Array:
        return np.stack([self._columns(names, body) for body in self.scene.bodies], axis=1)

    @property
    def t(self) -> Array:
        """Time, s, (T,)."""
        return self.column("t")

    @property
    def quaternion(self) -> Array:
        """Attitudes from body to reference frame as w, x, y, z, with a continuous sign, (T, N, 4)."""
        return self._of_bodies("qw qx qy qz")

    @property
    def position(self) -> Array:
        """Mass centres in the reference frame, m, (T, N, 3)."""
        return self._of_bodies("x y z")

    @property
    def velocity(self) -> Array:
        """Velocity of the first body's mass centre in the reference frame, m/s, (T, 3)."""
        return self._columns("vx vy vz")

    @property
    def angular_velocity(self) -> Array:
        """Angular velocities in each body's own frame, rad/s, (T, N, 3)."""
        return self._of_bodies("wx wy wz")

    @property
    def momentum(self) -> Array:
        """Linear momentum of bodies and fluid in the reference frame, kg m/s, (T, 3)."""
        return self._columns("px py pz")

    @property
    def angular_momentum(self) -> Array:
        """Angular momentum of bodies and fluid about the origin, kg m^2/s, (T, 3)."""
        return self._columns("lx ly lz")

    @property
    def energy(self) -> Array:
        """Kinetic and potential energy of bodies and fluid, J, (T,)."""
        return self.column("energy")

    @property
    def work(self) -> Array:
        """Work of all that does some since the start, J, (T,): the energy less this is what a motion keeps."""
        works = [drive.work for drive in self.drives.values()]
        works += [self.column(name) for name in self.names if name.endswith("_work")]
        return np.sum(works, axis=0) if works else np.zeros(len(self))

    @property
    def joints(self) -> dict[str, Hinge]:
        """The free hinges by their names: ``run.joints["tail"].angle``."""
        hinges = [name.removesuffix(".angle") for name in self.names if name.endswith(".angle")]
        return {name: Hinge(self.column(f"{name}.angle"), self.column(f"{name}.rate")) for name in hinges}

    @property
    def drives(self) -> dict[str, Drive]:
        """What moves joints as told, by the joints' names: ``run.drives["tail"].work``."""
        driven = [name.removesuffix(".work") for name in self.names if name.endswith(".work")]
        return {
            name: Drive(
                self.column(f"{name}.work"), self.column(f"{name}.power"), self._columns("tx ty tz", name)
            )
            for name in driven
        }

    def __len__(self) -> int:
        return len(self.table)

    def __repr__(self) -> str:
        report = self.report
        bodies = ", ".join(self.scene.bodies)
        return f"<lgvi.Run by {report['method']}: {len(self)} frames to {report['until_seconds']} s, bodies {bodies}>"

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of all columns, with the time as its index. Takes pandas."""
        pandas = needed("pandas")
        return pandas.DataFrame(self.table, columns=list(self.names)).set_index("t")

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Write that to a Parquet file. Takes pandas and pyarrow."""
        self.to_pandas().to_parquet(path)

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` of the arrays, by time, body and axis, with their units. Takes xarray."""
        xarray = needed("xarray")
        axis, frame = ("t", "axis"), ("t", "body", "axis")
        arrays: dict[str, tuple[tuple[str, ...], Array, str]] = {
            "attitude": (("t", "body", "row", "column"), self.attitude, "1"),
            "quaternion": (("t", "body", "wxyz"), self.quaternion, "1"),
            "position": (frame, self.position, "m"),
            "velocity": (axis, self.velocity, "m/s"),
            "angular_velocity": (frame, self.angular_velocity, "rad/s"),
            "momentum": (axis, self.momentum, "kg m/s"),
            "angular_momentum": (axis, self.angular_momentum, "kg m^2/s"),
            "energy": (("t",), self.energy, "J"),
            "work": (("t",), self.work, "J"),
        }
        coordinates = {
            "t": ("t", self.t, {"units": "s"}),
            "body": list(self.scene.bodies),
            "axis": list("xyz"),
            "wxyz": list("wxyz"),
        }
        data = {name: (dims, array, {"units": unit}) for name, (dims, array, unit) in arrays.items()}
        return xarray.Dataset(data, coordinates, {"report": json.dumps(self.report)})

    def page(self) -> str:
        """A page with a moving picture of the run, and what it keeps below: HTML in one piece, without network.

        The run is made once more for it, from the same scene in the same steps. At most 3000 frames are kept.
        """
        return self.scene._native.page(self._arguments)

    def show(self, path: str | os.PathLike[str] | None = None) -> Picture:
        """Show the run as a moving picture: in a notebook below the cell, elsewhere in the browser.

        path  where the page is written; unless given, to a file of the system's temporary folder, and in a notebook
              nowhere.
        """
        picture = Picture(self.page())
        in_notebook = _is_notebook()
        if path is None and not in_notebook:
            handle, path = tempfile.mkstemp(".html", "lgvi-")
            os.close(handle)
        if path is not None:
            Path(path).write_text(picture.page, encoding="utf-8")
        if path is not None and not in_notebook:
            webbrowser.open(Path(path).absolute().as_uri())
        return picture

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draw the sizes of angular velocities, and what the motion keeps, over time; to a file where a path is given.

        A point for each frame: give ``t`` as an array where steps are long.

        Returns the ``matplotlib`` figure. Takes matplotlib.
        """
        figure = needed("matplotlib.figure").Figure(figsize=(8, 6), layout="constrained")
        above, below = figure.subplots(2, 1, sharex=True)
        for k, body in enumerate(self.scene.bodies):
            above.plot(self.t, np.linalg.norm(self.angular_velocity[:, k], axis=-1), label=body)
        above.set_ylabel("size of angular velocity, rad/s")
        above.legend()
        balance = self.energy - self.work
        below.plot(self.t, balance - balance[0], label="energy less work, J")
        drift = np.linalg.norm(self.angular_momentum - self.angular_momentum[0], axis=-1)
        below.plot(self.t, drift, label="angular momentum, kg m²/s")
        below.set_ylabel("change since the start")
        below.set_xlabel("t, s")
        below.legend()
        if path is not None:
            figure.savefig(os.fspath(path))
        return figure
