"""Many scenes on all cores."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ._arguments import Progress, count, needed, plan, reporter
from ._lgvi import ensemble as _ensemble
from ._run import Array, Run
from ._scene import Scene


class Ensemble:
    """The runs of an ensemble, in the order of its scenes. A run that failed is there as its exception.

    ``batch[i]``        the ``Run`` of scene i; raises what it met, where it failed
    ``for row in batch``  each ``Run``, or the exception in its place
    ``batch.failures``  i -> exception

    It can be pickled.
    """

    def __init__(self, scenes: list[Scene], rows: list[Run | Exception]) -> None:
        self.scenes = scenes
        self._rows = rows

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[Run | Exception]:
        return iter(self._rows)

    def __getitem__(self, i: int) -> Run:
        row = self._rows[i]
        if isinstance(row, Exception):
            raise row
        return row

    @property
    def failures(self) -> dict[int, Exception]:
        """The exceptions by the numbers of their scenes."""
        return {i: row for i, row in enumerate(self._rows) if isinstance(row, Exception)}

    def stack(self, name: str) -> Array:
        """An array of all runs, such as ``batch.stack("energy")``: (M, T, ...), NaN throughout where a run failed.

        name  an array of ``lgvi.Run``, or a column of its table such as ``"tail.work"``

        The runs must have frames at equal times: give ``t`` as an array.
        """

        def array_of(run: Run) -> Array:
            array = getattr(run, name, None) if name.isidentifier() else None
            return array if isinstance(array, np.ndarray) else run.column(name)

        arrays = [None if isinstance(row, Exception) else array_of(row) for row in self._rows]
        shapes = {array.shape for array in arrays if array is not None}
        if len(shapes) != 1:
            found = "no run succeeded" if not shapes else f"the shapes differ: {sorted(shapes)}"
            raise ValueError(f"{name} cannot be stacked, as {found}; give t as an array of times")
        shape = shapes.pop()
        return np.stack([np.full(shape, np.nan) if array is None else array for array in arrays])

    def report(self, name: str) -> list[Any]:
        """An entry of all reports, such as ``"energy_error_max_relative"``; None where a run failed."""

        def entry(report: dict[str, Any]) -> Any:
            if name not in report:
                raise KeyError(f"no entry of a report is called {name!r}; expected one of {', '.join(report)}")
            return report[name]

        return [None if isinstance(row, Exception) else entry(row.report) for row in self._rows]

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each scene: its report, and its error, if it failed. Takes pandas."""
        pandas = needed("pandas")
        rows = [
            {"error": str(row)} if isinstance(row, Exception) else {**row.report, "error": None} for row in self._rows
        ]
        return pandas.DataFrame(rows)

    def __repr__(self) -> str:
        return f"<lgvi.Ensemble of {len(self)} runs, {len(self.failures)} failed>"


def ensemble(
    scenes: Iterable[Scene],
    t: Any,
    method: str | None = None,
    step: float | None = None,
    accuracy: float | None = None,
    *,
    every: int = 1,
    full: bool = False,
    exact: bool = False,
    workers: int | None = None,
    progress: Progress = None,
) -> Ensemble:
    """Run many scenes on all cores: the results are those of ``scene.simulate`` for each, bit for bit.

    scenes    any number of scenes, of equal or different shape
    t, method, step, accuracy, every, full, exact
              as in ``Scene.simulate``. An array for t keeps only these frames, and so saves memory.
    workers   threads; as many as there are cores unless given. The results do not depend on it.
    progress  True for a line on stderr, or a function that is called with how many runs are done.

    Returns an ``lgvi.Ensemble``. A run that fails is a row with its exception, and the others go on. Ctrl-C stops all.

    >>> soft = [scene.replace({"joint.tail.stiffness": k}) for k in np.linspace(1, 10, 1000)]
    >>> batch = lgvi.ensemble(soft, t=[0, 10], method="gauss-8")
    >>> batch.stack("position")[:, -1]                  # (1000, N, 3): where all bodies end, m

    To share it among processes or machines, map this function over parts of the list: scenes and results can be
    pickled.
    """
    if isinstance(scenes, Scene):
        raise TypeError("scenes is one lgvi.Scene; expected several, such as [scene.replace(changes) for changes in ...]")
    scenes = list(scenes)
    for i, scene in enumerate(scenes):
        if not isinstance(scene, Scene):
            raise TypeError(f"scenes[{i}] is {type(scene).__name__}; expected a lgvi.Scene")
    arguments = plan(t, method, step, accuracy, every, full, False, exact)
    threads = _cores() if workers is None else count(workers, "workers, a number of threads,")
    natives = [scene._native for scene in scenes]
    rows = _ensemble(natives, arguments, threads, reporter(progress, len(scenes), "runs"))
    runs = [row if isinstance(row, Exception) else Run._of(row, scene, arguments) for row, scene in zip(rows, scenes)]
    return Ensemble(scenes, runs)


def _cores() -> int:
    """The cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
