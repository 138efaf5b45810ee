"""Lie group variational integrators: scenes, ensembles, and Lagrangians of your own.

>>> import lgvi
>>> run = lgvi.Scene.example().simulate(10)
>>> run.position[-1, 0]            # of the head, m
>>> run.report["energy_error_max_relative"]

``Scene``     bodies, joints and fluid, as a TOML file tells them; ``Scene.simulate`` runs one
``Run``       what a run gives: arrays by name, and a report
``ensemble``  many scenes on all cores
``methods``   the integrators by name
``Scene.gait``  what a stroke of the joints does; ``Scene.best_gait`` finds the best one
``System``    a system of your own, by its Lagrangian on a group: ``SO2, SO3, SE2, SE3, Rn(n)``, products and powers
``where``     a choice inside of such a Lagrangian
"""

from ._ensemble import Ensemble, ensemble
from ._errors import SceneError, StepError, TraceError
from ._groups import SE2, SE3, SO2, SO3, Group, Pose, Rn
from ._run import Drive, Hinge, Run
from ._scene import Scene, methods
from ._system import Motion, Sensitivity, System
from ._tracing import where

__all__ = [
    "Drive",
    "Ensemble",
    "Group",
    "Hinge",
    "Motion",
    "Pose",
    "Rn",
    "Run",
    "SE2",
    "SE3",
    "SO2",
    "SO3",
    "Scene",
    "SceneError",
    "Sensitivity",
    "StepError",
    "System",
    "TraceError",
    "ensemble",
    "methods",
    "where",
]
