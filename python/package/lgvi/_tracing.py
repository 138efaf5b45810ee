"""Formulas written in Python, recorded once."""

from __future__ import annotations

import inspect
import re
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from ._errors import TraceError
from ._lgvi import Comparison, NativeRecording, Tracer

_OURS = str(Path(__file__).parent)
_NUMPY = str(Path(np.__file__).parent)


def refused(what: str, error: BaseException | None = None) -> TraceError:
    """The exception that a formula does what cannot be recorded, with the line that does, or that met `error`."""
    if error is None:
        places = [(frame.f_code.co_filename, line) for frame, line in traceback.walk_stack(sys._getframe(1))]
    else:
        places = [(frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(error.__traceback__)][::-1]
    theirs = (place for place in places if not place[0].startswith((_OURS, _NUMPY, "<")))
    file, line = next(theirs, ("?", 0))
    choice = "; choose between two by lgvi.where(a < b, x, y)" if "compare" in what else ""
    return TraceError(
        f"{file}:{line}: {what}. The function is recorded once, over numbers that have no value yet{choice}",
        file=file,
        line=line,
    )


def where(condition: Any, yes: Any, no: Any) -> Any:
    """``yes`` where the comparison holds, ``no`` elsewhere: single numbers, also inside of a recorded function.

    Both are computed. A formula with a kink has no derivative there: methods of high order lose theirs.

    >>> lgvi.where(x < 0, 0.5 * k * x**2, 0.0)          # a wall at x = 0
    """
    if isinstance(condition, Comparison):
        return condition.choose(yes, no)
    return yes if condition else no


def record(
    function: Callable[..., Any], name: str, arguments: Callable[[Any], tuple[Any, ...]], inputs: int
) -> tuple[NativeRecording, Any]:
    """Calls a function once on tracers; what it gives is not yet checked."""
    recording = NativeRecording(inputs)
    numbers = np.empty(inputs, dtype=object)
    numbers[:] = recording.inputs()
    given = arguments(numbers)
    _takes(function, name, len(given))
    try:
        return recording, function(*given)
    except TraceError:
        raise
    except (AttributeError, TypeError) as error:
        # Numpy looks for the methods of floats, or for floats, in an array of objects.
        if re.search(r"'(int|float|numpy\.\w+)' object has no attribute|no callable \w+ method", str(error)):
            raise refused(
                f"numpy asks a plain number for what traced ones do ({error}): apply the function to traced numbers alone",
                error,
            ) from error
        if "dtype('O')" in str(error):
            raise refused(f"this function of numpy takes floats alone ({error}): write it out in elements", error) from error
        raise


def _takes(function: Callable[..., Any], name: str, count: int) -> None:
    if not callable(function):
        raise TypeError(f"{name} is of type {type(function).__name__}; expected a function")
    try:
        inspect.signature(function).bind(*[None] * count)
    except TypeError:
        expected = "(t, g, xi)" if count == 3 else "(t, g, xi, p), as parameters are given"
        raise TypeError(f"{name} does not take {count} arguments; expected {name}{expected}") from None
    except ValueError:
        pass  # It has no signature to look at.


def single(value: Any, name: str) -> Any:
    """One number."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, Tracer) or (isinstance(value, (int, float, np.number)) and not isinstance(value, bool)):
        return value
    if value is None:
        raise TypeError(f"{name} gives None; expected one number: is there a return?")
    if isinstance(value, np.ndarray):
        raise TypeError(f"{name} gives an array of the shape {value.shape}; expected one number")
    raise TypeError(f"{name} gives a {type(value).__name__}; expected one number")
