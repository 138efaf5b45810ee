"""Lie group variational integrators: scenes, ensembles, and Lagrangians of your own.

>>> import lgvi
>>> run = lgvi.Scene.example().simulate(10)
>>> run.position[-1, 0]            # of the head, m
>>> run.report["energy_error_max_relative"]

``Scene``     bodies, joints and fluid, as a TOML file tells them; ``Scene.simulate`` runs one
``Run``       what a run gives: arrays by name, and a report
``ensemble``  many scenes on all cores
``methods``   the integrators by name
"""

from ._ensemble import Ensemble, ensemble
from ._errors import SceneError, StepError
from ._run import Drive, Hinge, Run
from ._scene import Scene, methods

__all__ = [
    "Drive",
    "Ensemble",
    "Hinge",
    "Run",
    "Scene",
    "SceneError",
    "StepError",
    "ensemble",
    "methods",
]
