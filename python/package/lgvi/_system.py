"""Systems of one's own, by their Lagrangians."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TextIO

import numpy as np

from ._arguments import Progress, count, positive, reporter, times
from ._groups import Group, _Layout
from ._lgvi import NativeSystem
from ._run import Array
from ._tracing import record, single


class Motion:
    """A motion of a ``System``: T frames.

    t       (T,)   time, s
    g       the configuration, as its group has it, every array with a first axis of length T
    xi      the velocity likewise
    mu      the momentum dL/dxi likewise
    energy  (T,)   <mu, xi> - L, J
    report  cost of the steps; "derivatives" tells whether the recording is used, or dual numbers and why
    """

    def __init__(self, t: Array, g: Any, xi: Any, mu: Any, energy: Array, report: dict[str, Any]) -> None:
        self.t, self.g, self.xi, self.mu, self.energy, self.report = t, g, xi, mu, energy, report

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<lgvi.Motion: {len(self)} frames from {self.t[0]} s to {self.t[-1]} s>"


class Sensitivity:
    """How the state of a ``System`` at the end depends on that at the start, and on the parameters.

    The state varies as (eta, mu): the configuration as g exp(eta), the momentum by addition. With d the dimension
    of the group, coordinates are those of xi, one array after the other.

    state       (2d, 2d)  of (eta, mu) at the end by (eta, mu) at the start. Without a force it is symplectic in the form
                          w(a, b) = mu_b.eta_a - mu_a.eta_b + mu.[eta_a, eta_b], with mu of the state where it is
    parameters  (2d, P)   of (eta, mu) at the end by the parameters, at a fixed momentum at the start. At a fixed
                          velocity add state[:, d:] @ dmu/dp, with mu = dL/dxi at the start
    names       of the parameters
    g, mu       the state at the end
    """

    def __init__(self, state: Array, parameters: Array, names: tuple[str, ...], g: Any, mu: Any) -> None:
        self.state, self.parameters, self.names, self.g, self.mu = state, parameters, names, g, mu

    def __repr__(self) -> str:
        return f"<lgvi.Sensitivity: {self.state.shape} by the state, {self.parameters.shape} by the parameters>"


class System:
    """A mechanical system by its Lagrangian, written with numpy's operators.

    L           a function L(t, g, xi), or L(t, g, xi, p) where parameters are given, of one number: kinetic less
                potential energy, J. It is called once, over numbers without a value; what it does with them is
                recorded, differentiated and run by compiled code. So it may not branch on a value: use lgvi.where.
                What it reads from elsewhere stays as it was.
    group       where the configuration g lives: lgvi.SO2, SO3, SE2, SE3, Rn(n), their products and powers.
                ``help(lgvi.Group)`` tells what g and xi are for each.
    force       a function force(t, g, xi), or force(t, g, xi, p): what is no gradient, such as drag, in the shape
                of xi: a torque in the body's frame on SO3, N m; a force on Rn, N
    parameters  a dictionary, then p is one of its names; or a sequence, then p is an array

    >>> inertia = np.diag([1.0, 1.0, 0.5])                       # kg m^2, in the body's frame
    >>> def L(t, R, omega):
    ...     return 0.5 * omega @ inertia @ omega - R[2, 2]       # weight times lever: 1 N m
    >>> top = lgvi.System(L, group=lgvi.SO3)
    >>> motion = top.simulate(10, lgvi.SO3.exp([0.3, 0, 0]), [0, 0, 10], "gauss-4", step=0.1)
    >>> motion.energy - motion.energy[0]

    A system takes a method and its step; accuracy and ensembles are for scenes. A sweep is a loop over ``replace``.

    Raises ``lgvi.TraceError`` (a ``TypeError``) with the line of the function that cannot be recorded.
    A system can be pickled.
    """

    def __init__(
        self,
        L: Callable[..., Any],
        group: Group,
        force: Callable[..., Any] | None = None,
        parameters: Mapping[str, float] | Sequence[float] | None = None,
    ) -> None:
        if not isinstance(group, Group):
            raise TypeError(f"group is {group!r}; expected lgvi.SO3, lgvi.Rn(2), lgvi.SE3**10 or the like")
        layout = _Layout(group)
        names, values = _named(parameters)
        is_mapping = isinstance(parameters, Mapping)

        def arguments(numbers: Any) -> tuple[Any, ...]:
            at = 1 + len(values)
            p = _Parameters(zip(names, numbers[1:at])) if is_mapping else numbers[1:at]
            g, xi = layout.element(numbers[at : at + layout.numbers]), layout.velocity(numbers[at + layout.numbers :])
            return (numbers[0], g, xi) if parameters is None else (numbers[0], g, xi, p)

        inputs = 1 + len(values) + layout.numbers + layout.dim
        recording, value = record(L, "L", arguments, inputs)
        formula = recording.end([single(value, "L")])
        force_formula = None
        if force is not None:
            recording, value = record(force, "force", arguments, inputs)
            force_formula = recording.end(layout.velocity_of(value, "the force", object).tolist())
        self._set(group, (formula, force_formula), names, values, is_mapping)

    def _set(self, group: Group, formulas: tuple[Any, Any], names: list[str], values: list[float], named: bool) -> None:
        self._group, self._formulas, self._names, self._values, self._named = group, formulas, names, values, named
        self._layout = _Layout(group)
        self._native = NativeSystem(self._layout.counts, *formulas, values)

    @property
    def group(self) -> Group:
        """Where the configuration lives."""
        return self._group

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters by their names; by "p[0]" and so on, where a sequence was given."""
        return dict(zip(self._names, self._values))

    @property
    def instructions(self) -> int:
        """How many instructions the recorded value of L has."""
        return int(self._formulas[0].instructions)

    def replace(self, parameters: Mapping[str, float]) -> System:
        """The same system with other values of some parameters; nothing is recorded anew.

        >>> heavier = top.replace({"mass": 2.0})
        """
        unknown = [name for name in parameters if name not in self._names]
        if unknown:
            raise ValueError(f"no parameter is called {unknown[0]!r}; expected one of {', '.join(self._names) or 'none'}")
        other: System = object.__new__(System)
        changed = {**self.parameters, **parameters}
        values = [_number(name, changed[name]) for name in self._names]
        other._set(self._group, self._formulas, self._names, values, self._named)
        return other

    def simulate(
        self,
        t: Any,
        g: Any,
        xi: Any,
        method: str = "gauss-4",
        *,
        step: float,
        t0: float = 0.0,
        every: int = 1,
        progress: Progress = None,
    ) -> Motion:
        """Move the system from the configuration g with the velocity xi.

        t         a number: the time to run for, s, with a frame at every step.
                  An array: the times of the frames since the start, s, increasing.
        g, xi     configuration and velocity, as ``help(lgvi.Group)`` tells for each group
        method    "midpoint" of order 2; "composition-P" of the order P = 2, 4, 6, 8, made of such steps;
                  "gauss-S", collocation with S = 1 to 8 stages, of order 2S. All stay on the group, are symplectic,
                  and keep the momenta of symmetries.
        step      the longest step to take, s
        t0        the time at the start, s, where L depends on it
        every     steps between frames
        progress  True for a line on stderr, or a function that is called with the time reached, s

        Returns an ``lgvi.Motion``. Raises ``lgvi.StepError`` where a step is refused, ``ValueError`` of a
        configuration or a velocity of another shape, or of a matrix that is no rotation.
        """
        until, at = times(t)
        if at is not None and every != 1:
            raise ValueError("every counts steps between frames, and t gives their times already; give one of them")
        frames = (until, at, count(every, "every, the steps between frames,"))
        parts = self._native.simulate(
            self._start(t0, g, xi), frames, self._steps(method, step), reporter(progress, until, "s")
        )
        layout = self._layout
        return Motion(
            parts["t"],
            layout.element(parts["numbers"]),
            layout.velocity(parts["velocity"]),
            layout.velocity(parts["momentum"]),
            parts["energy"],
            parts["report"],
        )

    def sensitivity(
        self, t: float, g: Any, xi: Any, method: str = "gauss-4", *, step: float, t0: float = 0.0, progress: Progress = None
    ) -> Sensitivity:
        """The derivative of the state after t seconds by the state at the start, and by the parameters.

        It is the derivative of the method's own steps, exact to rounding. Arguments are those of ``simulate``.
        """
        until = positive(t, "t, the time to run for in seconds,")
        start, steps = self._start(t0, g, xi), self._steps(method, step)
        numbers, momentum, columns = self._native.vary(start, until, steps, reporter(progress, until, "s"))
        layout, d = self._layout, self._layout.dim
        order = layout.order()
        both = np.concatenate([order, d + order])
        matrix = np.array(columns).reshape(-1, 2 * d).T[both]
        return Sensitivity(
            matrix[:, both],
            matrix[:, 2 * d :],
            tuple(self._names),
            layout.element(np.array(numbers)),
            layout.velocity(np.array(momentum)),
        )

    def check(self, g: Any, xi: Any, step: float = 0.01, *, t0: float = 0.0, file: TextIO | None = None) -> bool:
        """Try the laws that the recorded system and its methods must keep, at one state, and print what was found.

        Derivatives against dual numbers and differences, an inertia in every direction, symplecticity,
        reversibility, and the order of the steps by the midpoint rule; symplecticity by gauss-4 too. The force takes
        part in the order only. ``step`` is in seconds.

        Returns whether all hold. A law that fails tells formula, numbers and tolerance.
        """
        laws = self._native.check([self._start(t0, g, xi)], positive(step, "step, in seconds,"))
        for law, holds, found in laws:
            print(f"{'holds' if holds else 'FAILS'}  {law}\n       {found}", file=file or sys.stdout)
        return all(holds for _, holds, _ in laws)

    def value(self, t: float, g: Any, xi: Any) -> float:
        """L at a time, a configuration and a velocity, J: to compare with a known number."""
        return self._native.value(self._start(t, g, xi))

    def _start(self, t0: float, g: Any, xi: Any) -> tuple[float, list[float], list[float]]:
        layout = self._layout
        return float(t0), layout.numbers_of(g).tolist(), layout.velocity_of(xi, "xi").tolist()

    @staticmethod
    def _steps(method: str, step: float) -> tuple[str, float]:
        if not isinstance(method, str):
            raise TypeError(f"method is {method!r}; expected midpoint, composition-P or gauss-S")
        return method, positive(step, "step, in seconds,")

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._group, self._formulas, self._names, self._values, self._named)

    def __repr__(self) -> str:
        return f"<lgvi.System on {self._group!r}: {self.instructions} instructions>"


class _Parameters(dict[str, Any]):
    """The parameters by their names."""

    def __missing__(self, name: str) -> Any:
        raise KeyError(f"no parameter is called {name!r}; expected one of {', '.join(self)}")


def _restored(group: Group, formulas: tuple[Any, Any], names: list[str], values: list[float], named: bool) -> System:
    system: System = object.__new__(System)
    system._set(group, formulas, names, values, named)
    return system


def _named(parameters: Any) -> tuple[list[str], list[float]]:
    if parameters is None:
        return [], []
    if isinstance(parameters, Mapping):
        names = [str(name) for name in parameters]
        return names, [_number(name, value) for name, value in parameters.items()]
    values = np.atleast_1d(np.asarray(parameters, dtype=float))
    if values.ndim != 1:
        raise ValueError(f"parameters have the shape {values.shape}; expected a sequence, or a dictionary, of numbers")
    names = [f"p[{k}]" for k in range(len(values))]
    return names, [_number(name, value) for name, value in zip(names, values)]


def _number(name: str, value: Any) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"the parameter {name} is {type(value).__name__}; expected a number") from None
    if not np.isfinite(number):
        raise ValueError(f"the parameter {name} is {number}; expected a finite number")
    return number
