"""Arguments that several functions share: checked here, with the messages that a caller meets."""

from __future__ import annotations

import importlib
import math
import sys
import time
from collections.abc import Callable
from typing import Any, TypeAlias, Union

import numpy as np

#: What is told of a run on its way: True for a line on stderr, or a function of the time reached, s.
Progress: TypeAlias = Union[bool, Callable[[float], object], None]


def positive(x: Any, what: str) -> float:
    """A finite number above zero."""
    if isinstance(x, (bool, str)):
        raise TypeError(f"{what} is {x!r}; expected a number")
    try:
        number = float(x)
    except (TypeError, ValueError):
        raise TypeError(f"{what} is {type(x).__name__}; expected a number") from None
    if not (math.isfinite(number) and number > 0):
        raise ValueError(f"{what} is {number}; expected a finite number > 0")
    return number


def count(x: Any, what: str) -> int:
    """A whole number above zero."""
    if isinstance(x, bool) or not hasattr(x, "__index__"):
        raise TypeError(f"{what} is {x!r}; expected a whole number")
    if x.__index__() < 1:
        raise ValueError(f"{what} is {x}; expected at least 1")
    return int(x.__index__())


def times(t: Any) -> tuple[float, list[float] | None]:
    """The time to run to, and the times to sample at, if they were given."""
    if np.ndim(t) == 0:
        return positive(t, "t, the time to run to in seconds,"), None
    array = np.asarray(t)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"t has the type {array.dtype}; expected numbers")
    array = array.astype(float)
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"t has the shape {array.shape}; expected a time, or a one-dimensional array of times")
    if not np.isfinite(array).all():
        where = int(np.flatnonzero(~np.isfinite(array))[0])
        raise ValueError(f"t[{where}] is {array[where]}; expected finite times")
    if array[0] < 0:
        raise ValueError(f"t[0] is {array[0]}; expected times from 0 on")
    if (np.diff(array) <= 0).any():
        where = int(np.flatnonzero(np.diff(array) <= 0)[0])
        raise ValueError(
            f"t[{where + 1}] is {array[where + 1]}, after {array[where]}; expected increasing times: sort them, and take np.unique"
        )
    return positive(array[-1], "t, the time to run to in seconds,"), array.tolist()


def plan(
    t: Any,
    method: str | None,
    step: float | None,
    accuracy: float | None,
    every: int,
    full: bool,
    estimate: bool,
    exact: bool,
) -> tuple[Any, ...]:
    """What the native half is given."""
    if accuracy is not None and (method is not None or step is not None):
        raise ValueError("accuracy chooses method and step itself; give it alone, or give method and step")
    if method is not None and not isinstance(method, str):
        raise TypeError(f"method is {method!r}; expected a name, one of lgvi.methods()")
    until, at = times(t)
    if at is not None and every != 1:
        raise ValueError("every counts steps between frames, and t gives their times already; give one of them")
    return (
        until,
        at,
        method,
        None if step is None else positive(step, "step, in seconds,"),
        None if accuracy is None else positive(accuracy, "accuracy, in radians and metres,"),
        count(every, "every, the steps between frames,"),
        bool(full),
        bool(estimate),
        bool(exact),
    )


def reporter(progress: Progress, end: float, unit: str) -> Callable[[float], object] | None:
    """What is called with how far the work is."""
    if progress is None or progress is False:
        return None
    if callable(progress):
        return progress
    if progress is not True:
        raise TypeError(f"progress is {progress!r}; expected True, or a function of how far the run is")
    begin = time.monotonic()

    def line(reached: float) -> None:
        spent = time.monotonic() - begin
        last = "\n" if reached >= end else ""
        print(f"\r{reached:.4g} of {end:.4g} {unit}, {spent:.1f} s spent", end=last, file=sys.stderr, flush=True)

    return line


def needed(module: str) -> Any:
    """A module of a package that this one can do without."""
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = module.partition(".")[0]
        raise ModuleNotFoundError(f"this takes {package}: pip install {package}", name=package) from error
