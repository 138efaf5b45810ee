"""What a stroke of the joints does, and which one does it best."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._lgvi import NativeScene, objectives
from ._lgvi import best_gait as _best_gait
from ._lgvi import gait_report as gait_report
from ._lgvi import height_maps as _height_maps

if TYPE_CHECKING:
    from ._arguments import Progress
    from ._scene import Scene


class Best(NamedTuple):
    """The best stroke that a search found: what ``Scene.best_gait`` gives."""

    scene: Scene
    """The scene with the best stroke, each joint by a ``motion`` with ``harmonics``."""
    own: float
    """What the scene's own stroke has, as far as the harmonics tell it."""
    value: float
    """What the best stroke has."""
    starts: list[float | None]
    """What the search came to from each start, the scene's own stroke first; None where no stroke was within the limits."""
    evaluations: int
    """How many strokes were evaluated."""


class HeightMaps(NamedTuple):
    """Height functions around a stroke of two shape coordinates: what ``Scene.height_maps`` gives."""

    first: NDArray[np.float64]
    """The first coordinates of the points, rad, (N,)."""
    second: NDArray[np.float64]
    """The second ones, (N,)."""
    heights: NDArray[np.float64]
    """(6, N, N), row by row in the second coordinate: turns about x, y, z, 1/rad, and advances along them, m/rad^2."""
    stroke: NDArray[np.float64]
    """The stroke, rad, (M, 2)."""
    by_area: NDArray[np.float64]
    """The net motion by the areas, as an exponent: turn, rad, and advance, m, (6,)."""
    exact: NDArray[np.float64]
    """The exponent of the net motion itself, (6,)."""


def search(
    native: NativeScene, objective: str, order: int, angle: float, rate: float | None, starts: int, progress: Progress
) -> tuple[str, Best]:
    """The text of the scene with the best stroke, and the rest of what was found; its scene is yet to be made."""
    from ._arguments import reporter

    known = objectives()
    if objective not in known:
        raise ValueError(f"objective is {objective!r}; expected one of {', '.join(known)}")
    for name, count in (("order", order), ("starts", starts)):
        if isinstance(count, bool) or not isinstance(count, int) or count < 1:
            raise ValueError(f"{name} is {count!r}; expected a whole number >= 1")
    limits = [float(angle), math.inf if rate is None else float(rate)]
    text, own, value, found, evaluations = _best_gait(
        native, objective, order, limits, starts, reporter(progress, float(starts), "starts")
    )
    return text, Best(None, own, value, found, evaluations)  # type: ignore[arg-type]


def maps(native: NativeScene) -> HeightMaps:
    """The arrays in their shapes."""
    arrays = _height_maps(native)
    count = len(arrays["first"])
    arrays["heights"] = arrays["heights"].reshape(6, count, count)
    arrays["stroke"] = arrays["stroke"].reshape(-1, 2)
    return HeightMaps(**arrays)
