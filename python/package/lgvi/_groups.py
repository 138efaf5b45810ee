"""Groups that a system may live on, and their elements as arrays."""

from __future__ import annotations

import operator
from typing import Any, NamedTuple

import numpy as np

from ._lgvi import exp as _exp

#: By kind, as the native half sorts them: SO2, SO3, SE2, SE3, R. Numbers of an element, and its dimension.
_NUMBERS = (2, 9, 4, 12, 1)
_DIMENSIONS = (1, 3, 3, 6, 1)


class Pose(NamedTuple):
    """An element of SE(2) or SE(3): y -> rotation @ y + translation."""

    rotation: Any
    """(..., 2, 2) or (..., 3, 3)."""
    translation: Any
    """(..., 2) or (..., 3), m."""


class _Leaf(NamedTuple):
    """Where the factors of one kind are in the native order."""

    kind: int
    numbers: Any
    velocity: Any


class Group:
    """A Lie group: ``SO2``, ``SO3``, ``SE2``, ``SE3``, ``Rn(n)``, products ``SO3 * Rn(3)`` and powers ``SE3**20``.

    An element is, as an array of numpy,

    SO2       (2, 2)   a rotation matrix; an angle, rad, is taken for one too
    SO3       (3, 3)   a rotation matrix, from body to reference frame
    SE2, SE3  Pose(rotation, translation)
    Rn(n)     (n,)     a vector
    G * H     (g, h)   a tuple of both
    G**n      an element of G whose arrays have a first axis of length n

    A velocity xi is left-trivialised, dg/dt = g xi: in the body's own frame.

    SO2   ()    angular velocity, rad/s
    SO3   (3,)  angular velocity in the body's frame, rad/s
    SE2   (3,)  angular velocity, rad/s, then linear velocity in the body's frame, m/s
    SE3   (6,)  angular velocity, rad/s, then linear velocity in the body's frame, m/s
    Rn    (n,)
    products and powers as above

    A momentum mu = dL/dxi, and a force, have the shape of a velocity.

    A step solves a rotation in Cayley's chart, tan(angle / 2): keep the turn in a step well below 1 rad. A rotor that
    does nothing but spin fast is exact on Rn(1), whose steps may be long.
    """

    def __mul__(self, other: Group) -> Group:
        if not isinstance(other, Group):
            raise TypeError(f"{self!r} * {other!r} is no product of groups; a power is {self!r}**n")
        return _Product([*_factors(self), *_factors(other)])

    def __pow__(self, n: int) -> Group:
        if isinstance(n, bool) or not hasattr(n, "__index__") or operator.index(n) < 1:
            raise ValueError(f"the power is {n!r}; expected a whole number of at least 1")
        return _Power(self, operator.index(n))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Group) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (repr(self),)

    @property
    def dim(self) -> int:
        """The number of coordinates of a velocity."""
        return _Layout(self).dim

    def exp(self, xi: Any) -> Any:
        """The element that a constant velocity leads to from the identity in one second.

        >>> lgvi.SO3.exp([0.3, 0, 0])           # a turn of 0.3 rad about x
        """
        layout = _Layout(self)
        numbers = np.array(_exp(layout.counts, layout.velocity_of(xi, "xi").tolist()))
        return layout.element(numbers)

    def identity(self) -> Any:
        """The element that changes nothing."""
        layout = _Layout(self)
        return layout.element(np.array(_exp(layout.counts, [0.0] * layout.dim)))

    def _assign(self, lead: tuple[int, ...], taken: list[int]) -> Any:
        raise NotImplementedError


class _Kind(Group):
    """A factor that is no product."""

    def __init__(self, name: str, kind: int, trail: tuple[int, ...] = ()) -> None:
        self._name, self._kind, self._trail = name, kind, trail

    def __repr__(self) -> str:
        return self._name

    def _assign(self, lead: tuple[int, ...], taken: list[int]) -> Any:
        shape = lead + self._trail
        count = int(np.prod(shape, dtype=int))
        places = taken[self._kind] + np.arange(count).reshape(shape)
        taken[self._kind] += count
        return self._kind, places


class _Product(Group):
    def __init__(self, parts: list[Group]) -> None:
        self._parts = parts

    def __repr__(self) -> str:
        return " * ".join(map(repr, self._parts))

    def _assign(self, lead: tuple[int, ...], taken: list[int]) -> Any:
        return [part._assign(lead, taken) for part in self._parts]


class _Power(Group):
    def __init__(self, base: Group, n: int) -> None:
        self._base, self._n = base, n

    def __repr__(self) -> str:
        base = repr(self._base)
        return f"{base}**{self._n}" if isinstance(self._base, _Kind) else f"({base})**{self._n}"

    def _assign(self, lead: tuple[int, ...], taken: list[int]) -> Any:
        return self._base._assign((*lead, self._n), taken)


def _factors(group: Group) -> list[Group]:
    return group._parts if isinstance(group, _Product) else [group]


SO2: Group = _Kind("SO2", 0)
SO3: Group = _Kind("SO3", 1)
SE2: Group = _Kind("SE2", 2)
SE3: Group = _Kind("SE3", 3)


def Rn(n: int) -> Group:
    """Vectors of n numbers, which share a unit."""
    if isinstance(n, bool) or not hasattr(n, "__index__") or operator.index(n) < 1:
        raise ValueError(f"n is {n!r}; expected a whole number of at least 1")
    return _Kind(f"Rn({operator.index(n)})", 4, (operator.index(n),))


def _restored(text: str) -> Group:
    names = {"SO2": SO2, "SO3": SO3, "SE2": SE2, "SE3": SE3, "Rn": Rn, "__builtins__": {}}
    group = eval(text, names)  # Of the text that `repr` gives.
    assert isinstance(group, Group)
    return group


class _Layout:
    """How elements and velocities of a group lie in the native order."""

    def __init__(self, group: Group) -> None:
        self.group = group
        counts = [0] * 5
        tree = group._assign((), counts)
        self.counts = counts
        numbers = np.cumsum([0, *np.multiply(counts, _NUMBERS)])
        velocity = np.cumsum([0, *np.multiply(counts, _DIMENSIONS)])
        self.numbers, self.dim = int(numbers[-1]), int(velocity[-1])

        def placed(tree: Any) -> Any:
            if isinstance(tree, list):
                return [placed(part) for part in tree]
            kind, places = tree
            each = places[..., None]
            return _Leaf(
                kind,
                numbers[kind] + each * _NUMBERS[kind] + np.arange(_NUMBERS[kind]),
                velocity[kind] + each * _DIMENSIONS[kind] + np.arange(_DIMENSIONS[kind]),
            )

        self.tree = placed(tree)

    def element(self, numbers: Any) -> Any:
        """The element of native numbers, (..., numbers)."""

        def of(leaf: Any) -> Any:
            if isinstance(leaf, list):
                return tuple(of(part) for part in leaf)
            x = numbers[..., leaf.numbers]
            if leaf.kind == 0:
                return _planar(x)
            if leaf.kind == 1:
                return x.reshape(*x.shape[:-1], 3, 3)
            if leaf.kind == 2:
                return Pose(_planar(x[..., :2]), x[..., 2:])
            if leaf.kind == 3:
                return Pose(x[..., :9].reshape(*x.shape[:-1], 3, 3), x[..., 9:])
            return x[..., 0]

        return of(self.tree)

    def velocity(self, coordinates: Any) -> Any:
        """The velocity of native coordinates, (..., dim)."""

        def of(leaf: Any) -> Any:
            if isinstance(leaf, list):
                return tuple(of(part) for part in leaf)
            x = coordinates[..., leaf.velocity]
            return x[..., 0] if leaf.kind in (0, 4) else x

        return of(self.tree)

    def numbers_of(self, g: Any) -> Any:
        """The native numbers of an element."""
        out = np.zeros(self.numbers)

        def put(leaf: Any, g: Any, name: str) -> None:
            if isinstance(leaf, list):
                for k, part in enumerate(_parts(g, len(leaf), name)):
                    put(leaf[k], part, f"{name}[{k}]")
                return
            lead = leaf.numbers.shape[:-1]
            if leaf.kind == 0:
                out[leaf.numbers] = _cosines(g, lead, name)
            elif leaf.kind == 1:
                out[leaf.numbers] = _array(g, (*lead, 3, 3), name).reshape(*lead, 9)
            elif leaf.kind in (2, 3):
                rotation, translation = _parts(g, 2, name, "Pose(rotation, translation)")
                size = leaf.kind
                out[leaf.numbers[..., -size:]] = _array(translation, (*lead, size), f"{name}.translation")
                if size == 2:
                    out[leaf.numbers[..., :2]] = _cosines(rotation, lead, f"{name}.rotation")
                else:
                    out[leaf.numbers[..., :9]] = _array(rotation, (*lead, 3, 3), f"{name}.rotation").reshape(*lead, 9)
            else:
                out[leaf.numbers[..., 0]] = _array(g, lead, name)

        put(self.tree, g, "g")
        return out

    def velocity_of(self, xi: Any, name: str, dtype: Any = float) -> Any:
        """The native coordinates of a velocity, or of a force."""
        out = np.zeros(self.dim, dtype=dtype)

        def put(leaf: Any, xi: Any, name: str) -> None:
            if isinstance(leaf, list):
                for k, part in enumerate(_parts(xi, len(leaf), name)):
                    put(leaf[k], part, f"{name}[{k}]")
                return
            places = leaf.velocity[..., 0] if leaf.kind in (0, 4) else leaf.velocity
            # A number, not an array of one: that would be stored as it is among traced numbers.
            out[places] = _array(xi, places.shape, name, dtype)[()]

        put(self.tree, xi, name)
        return out

    def order(self) -> Any:
        """The native places of all coordinates, in the order of the user's arrays."""
        places: list[Any] = []

        def add(leaf: Any) -> None:
            if isinstance(leaf, list):
                for part in leaf:
                    add(part)
            else:
                places.append(leaf.velocity.ravel())

        add(self.tree)
        return np.concatenate(places)


def _planar(x: Any) -> Any:
    cos, sin = x[..., 0], x[..., 1]
    return np.stack([np.stack([cos, -sin], axis=-1), np.stack([sin, cos], axis=-1)], axis=-2)


def _cosines(g: Any, lead: tuple[int, ...], name: str) -> Any:
    if np.shape(g) == lead:
        angle = _array(g, lead, name)
        return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return _array(g, (*lead, 2, 2), name)[..., :, 0]


def _parts(x: Any, n: int, name: str, expected: str | None = None) -> Any:
    if not isinstance(x, (tuple, list)) or len(x) != n:
        found = f"{len(x)} parts" if isinstance(x, (tuple, list)) else f"of type {type(x).__name__}"
        raise ValueError(f"{name} is {found}; expected {expected or f'a tuple of {n}, a part for each factor'}")
    return x


def _array(x: Any, shape: tuple[int, ...], name: str, dtype: Any = float) -> Any:
    try:
        array = np.asarray(x, dtype=dtype)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{name} is no array of numbers: {error}") from None
    if array.shape != shape:
        hint = ", a rotation matrix: SO3.exp(xi) makes one" if shape[-2:] == (3, 3) else ""
        raise ValueError(f"{name} has the shape {array.shape}; expected {shape}{hint}")
    return array
