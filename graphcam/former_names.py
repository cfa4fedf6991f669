"""Names that have been replaced: who uses a former one is told the present one."""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, TypeVar, cast

Named = TypeVar("Named", bound=Callable[..., Any])
FORMER_NAMES: Mapping[str, str] = {"least_preload": "spring_preload"}
"""Public names of graphcam by their former ones."""


def renamed(**present: str) -> Callable[[Named], Named]:
    """Decorate a function whose arguments, or a class whose arguments and attributes, had other names.

    A former argument raises TypeError, a former attribute AttributeError, with the present name.

    >>> @renamed(axes="ax")
    ... def plot(ax=None): ...
    >>> plot(axes=3)
    Traceback (most recent call last):
    TypeError: plot() has no argument 'axes' any more: write 'ax'
    >>> @renamed(greatest="max_force")
    ... class Contact: ...
    >>> Contact().greatest
    Traceback (most recent call last):
    AttributeError: Contact has no 'greatest' any more: write 'max_force'
    """

    def decorated(named: Named) -> Named:
        if not isinstance(named, type):
            return cast(Named, _told(named, named.__name__, present))
        kind: Any = named

        def missing(self: object, name: str) -> object:
            if name in present:
                raise AttributeError(f"{kind.__name__} has no {name!r} any more: write {present[name]!r}", name=name)
            raise AttributeError(f"{kind.__name__!r} object has no attribute {name!r}", name=name, obj=self)

        kind.__init__ = _told(kind.__init__, kind.__name__, present)
        kind.__getattr__ = missing
        return cast(Named, kind)

    return decorated


def _told(function: Callable[..., Any], called: str, present: Mapping[str, str]) -> Callable[..., Any]:
    @wraps(function)
    def told(*args: Any, **given: Any) -> Any:
        for name in present.keys() & given.keys():
            raise TypeError(f"{called}() has no argument {name!r} any more: write {present[name]!r}")
        return function(*args, **given)

    return told
