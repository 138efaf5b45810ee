"""What goes wrong, with fields that a program can act on."""

from __future__ import annotations

from typing import Any


class _WithFields(Exception):
    def __init__(self, message: str, **fields: Any) -> None:
        super().__init__(message)
        self.__dict__.update(fields)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), str(self), dict(self.__dict__))


def _restored(kind: type[_WithFields], message: str, fields: dict[str, Any]) -> _WithFields:
    return kind(message, **fields)


class SceneError(_WithFields, ValueError):
    """A scene's text is wrong. The message is ``FILE:LINE:COLUMN: KEY: what is wrong; expected ...``.

    ``file``, ``line``, ``column``, ``key`` tell the place; all are None where the text is too large to be read.
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None
    key: str | None = None


class TraceError(_WithFields, TypeError):
    """A function does with the numbers that it is recorded over what has no value yet: it branches, or asks for a float.

    ``file`` and ``line`` tell where.
    """

    file: str = "?"
    line: int = 0


class StepError(_WithFields, RuntimeError):
    """A step was refused: what is asked for has no solution that the solver finds.

    step                 steps taken before
    t, h                 time at the start of the step, and its size, s
    cause                "not-converged", "not-finite", "degenerate", "invalid-step", "misfit" or "shape"
    residual             the smallest residual, relative to the momentum (not-converged)
    iterations           how many were done (not-converged)
    suggested_step       a step size to try, s, or None
    suggested_tolerance  a tolerance to try, or None
    coordinate           of the velocity without inertia (degenerate)
    """

    step: int = 0
    t: float = float("nan")
    h: float = float("nan")
    cause: str = ""
    residual: float | None = None
    iterations: int | None = None
    suggested_step: float | None = None
    suggested_tolerance: float | None = None
    coordinate: int | None = None
