"""The engines that furiko knows, as data, and the functions that look one up and load it."""

from __future__ import annotations

import importlib
import re
from collections import ChainMap
from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

from ..models import EngineMissing, InvalidInput, System, TreeSystem
from ..models.errors import installing, nearest
from ..models.trees.own import OWN
from . import elsewhere
from .info import EngineInfo, TreeInfo
from .known.on_request import ON_REQUEST
from .known.usual import ENGINES
from .places.names import Place, place_of
from .releases import FACTS, facts_of, too_old

if TYPE_CHECKING:
    from .places.connection import Connection
    from .shapes import AnyShape
    from .trees.shapes import TreeShape

_SHARED = re.compile(r"(\S+\.so[.\d]*): cannot open shared object file")

# Takes part like an engine where a scene has a user's own equations; its answers are theirs, without rounding.
OWN_EQUATIONS = EngineInfo(
    name=OWN,
    formulation="the equations of the scene file, in ball arithmetic",
    adapter="",
    module="",
    package="",
    homepage="",
    coordinates="relative",
    tree=TreeInfo(
        "",
        {
            "energy": "equations of motion give no energies",
            "trajectory": "equations of motion have no integrator of their own",
        },
        lacks={"joint_forces": "equations of motion have no forces that joints hold"},
    ),
)


_KNOWN = ChainMap(ENGINES, ON_REQUEST)
_RELEASES_MATTER = {fact.name for fact in FACTS}


def engine_names() -> list[str]:
    """The engines that run where none is named, whether they are installed or not."""
    return list(ENGINES)


def names_on_request() -> list[str]:
    """The engines that furiko has as well, and that run only where they are named."""
    return list(ON_REQUEST)


def plugin_names() -> list[str]:
    """The engines that other installed packages bring (:mod:`.elsewhere`), less those that furiko has by that name."""
    return [name for name in elsewhere.plugin_names() if name not in _KNOWN]


def all_of(names: Iterable[str]) -> list[str]:
    """The engines that these names mean, each once: a package's name means all its formulations.

    ``pin@3.9`` means ``pinocchio-aba@3.9`` and so on. Other names are passed on, known or not.
    """
    found: list[str] = []
    for name in names:
        package, at, rest = name.partition("@")
        folder, colon, last = name.rpartition(":")
        if name in _KNOWN or package in _KNOWN or last in _KNOWN:
            found.append(name)
        elif colon and (several := formulations_of(last)):
            found += [f"{folder}:{one}" for one in several]
        else:
            found += [f"{one}{at}{rest}" for one in formulations_of(package)] or [name]
    return list(dict.fromkeys(found))


def formulations_of(package: str) -> list[str]:
    """The engines that a package to install brings."""
    return [info.name for info in _KNOWN.values() if info.package == package and info.name != package]


def engine_info(name: str) -> EngineInfo:
    """An engine's name and capabilities, without importing the engine.

    ``name``: one of :func:`engine_names` or :func:`names_on_request`, or of an adapter from elsewhere, a class with an
    :class:`EngineInfo` as its attribute ``info``: one of :func:`plugin_names`, ``package.module:Class``,
    ``path/to/file.py`` or ``path/to/file.py:Class``; or of a place of its own (:mod:`.places`): ``name@version``,
    ``path/to/environment:name``, ``path/to/program``, which is started. Raises :class:`InvalidInput` where there is
    none such, :class:`EngineMissing` where a program does not answer.
    """
    if name in _KNOWN:
        return replace(_KNOWN[name], **_facts_here(name)) if name in _RELEASES_MATTER else _KNOWN[name]
    if name == OWN_EQUATIONS.name:
        return OWN_EQUATIONS
    place = place_of(name)
    if place is not None:
        return _info_at(place)
    if not elsewhere.is_elsewhere(name) and name not in plugin_names():
        known = [*_KNOWN, *plugin_names()]
        hint = nearest(name, known) or (
            f"; there are {', '.join(known)}, name@version, package.module:Class, or a file, ./adapter.py"
        )
        raise InvalidInput(f"engine: no engine is called {name!r}{hint}")
    return elsewhere.info_of(name)


@cache
def _facts_here(name: str) -> dict[str, Any]:
    """What is otherwise in the release that is installed beside furiko."""
    return facts_of(name, engine_version(name))


def _info_at(place: Place) -> EngineInfo:
    from .places import engines

    if place.kind == "program":
        return engines.program_info(place)
    base = base_of(place)
    version = place.version if place.kind == "version" else engines.installed_version(place, base)
    return replace(base, name=place.name, module="", **facts_of(base.name, version))


def base_of(place: Place) -> EngineInfo:
    """furiko's own engine of which a place has another version."""
    if place.engine in _KNOWN:
        return _KNOWN[place.engine]
    several = formulations_of(place.engine)
    if several:
        made = ", ".join(place.name.replace(place.engine, one) for one in several)
        raise InvalidInput(f"engine: {place.name}: {place.engine} is a package of several engines: name one, {made}")
    raise InvalidInput(
        f"engine: {place.name}: no engine is called {place.engine!r}{nearest(place.engine, _KNOWN)}; furiko engines "
        "lists them"
    )


def engine_adapter(name: str) -> Any:
    """The class that ``name``, as for :func:`engine_info`, names; it and its engine are imported.

    Raises :class:`InvalidInput` where it cannot be, and for a user's own equations, which are a scene file's;
    :class:`EngineMissing` where an engine in a place of its own cannot be started.
    """
    if name == OWN_EQUATIONS.name:
        raise InvalidInput(
            f"engine: {name} are no engine of their own: a scene file has them, and furiko check runs it"
        )
    place = _place(name)
    if place is not None:
        from .places.remote import adapter_class

        return adapter_class(_connection(place))
    return elsewhere.adapter(_KNOWN[name].adapter if name in _KNOWN else name)


def _place(name: str) -> Place | None:
    return None if name in _KNOWN else place_of(name)


def _connection(place: Place) -> Connection:
    from .places import engines

    return engines.program(place) if place.kind == "program" else engines.connection(place, base_of(place))


def engine_version(name: str) -> str:
    """The installed version of an engine's package, without importing it; empty where it is not installed.

    Of an engine in a place of its own: the version there. An environment that has not been made is not made here.
    """
    place = _place(name)
    if place is not None:
        from .places import engines

        if place.kind == "program":
            return engines.program_version(place)
        return engines.installed_version(place, base_of(place))
    return _installed(_KNOWN[name].package if name in _KNOWN else engine_info(name).package)


def _installed(package: str) -> str:
    from ..records.provenance import installed_version  # takes 5 ms, and workers never ask

    return installed_version(package)


def runs_elsewhere(name: str) -> bool:
    """Whether a name is that of an engine in a place of its own."""
    return _place(name) is not None


def engine_place(name: str) -> str:
    """A phrase on where an engine runs, other than beside furiko; empty for one that runs there."""
    place = _place(name)
    if place is None:
        return ""
    from .places import engines

    return engines.says_where(place, base_of(place) if place.kind != "program" else OWN_EQUATIONS)


def environment_of(name: str) -> tuple[str, tuple[str, ...], str, str] | None:
    """Of an engine in an environment of its own: its Python, that one's search path, its package, and its module.

    None for any other engine. Raises :class:`EngineMissing` where the environment cannot be made.
    """
    place = _place(name)
    if place is None or place.kind == "program":
        return None
    from .places import engines

    return engines.environment(place, base_of(place))


def why_missing(name: str) -> str:
    """Why an engine cannot run, in a sentence; empty where it can. The environment of a version is made if need be."""
    place = _place(name)
    if place is not None:
        from .places import engines

        why = engines.why_missing(place, None if place.kind == "program" else base_of(place))
    else:
        package = engine_info(name).package
        why = "" if not package or engine_version(name) else f"not installed: {installing(package)}"
    return why or too_old(engine_info(name).package, engine_version(name))


def untested(info: EngineInfo) -> str:
    """A sentence where the installed version of an engine is none that furiko was tested with; else empty."""
    version = engine_version(info.name)
    if not version or not info.tested or version in info.tested:
        return ""
    return f"{info.package} {version} is none of the versions that furiko was tested with ({', '.join(info.tested)})"


def cannot(info: EngineInfo, system: System | TreeSystem) -> str | None:
    """A sentence on why an engine cannot take a system; None where it can."""
    if system.n > info.largest_n:
        return f"{info.name} takes at most {info.largest_n} links, not {system.n}: {info.largest_n_reason}"
    if isinstance(system, TreeSystem):
        if info.tree is None:
            return f"{info.name} takes the documents' mechanisms alone: its adapter has none for other trees"
        missing = (why for feature, why in info.tree.cannot_hold.items() if feature in system.features)
        return next(missing, None) or _too_light(info, system)
    for number, link in enumerate(system.tree().links, start=1):
        inertia = link.inertia + link.mass * (link.com[0] ** 2 + link.com[1] ** 2)
        for value, least, what in (
            (link.mass, info.least_mass, "masses from {:g} kg"),
            (inertia, info.least_inertia, "inertias about the hinge from {:g} kg m²"),
        ):
            if value < least:
                return f"{info.name} takes {what.format(least)}, not {value:.2g} (link {number}): {info.least_reason}"
        if info.no_point_masses and not link.inertia:
            return f"{info.name} takes no point masses (link {number}): {info.no_point_masses}"
    return None


def _too_light(info: EngineInfo, system: TreeSystem) -> str | None:
    """Why an engine cannot take a tree's masses and moments of inertia; None where it can. What weighs nothing is a
    feature of its own."""
    if not (info.least_mass or info.least_inertia):
        return None
    from ..models.trees.weights import moved  # with arrays, which are needed for these engines alone

    for name, mass, inertia in moved(system.mechanism()):
        for value, least, what in (
            (mass, info.least_mass, "masses from {:g} kg"),
            (inertia, info.least_inertia, "inertias about a joint from {:g} kg m²"),
        ):
            if 0 < value < least:
                return f"{info.name} takes {what.format(least)}, not {value:.2g} (link {name!r}): {info.least_reason}"
    return None


def load_engine(name: str, system: System) -> AnyShape:
    """Import an engine and build its model of a system.

    ``name``: as for :func:`engine_info`.

    Raises :class:`InvalidInput` for an unknown engine or a system that it cannot take (before anything is imported or
    allocated), :class:`EngineMissing` where the engine cannot be imported.
    """
    from .shapes import AnyShape

    info = engine_info(name)
    why_not = cannot(info, system)
    if why_not is not None:
        raise InvalidInput(why_not)
    _require(info)
    return AnyShape(engine_adapter(name)(system), info, system.n)


def load_tree_engine(name: str, system: TreeSystem) -> TreeShape:
    """Import an engine and build its model of an open mechanism; the rest as for :func:`load_engine`."""
    from .trees.shapes import TreeShape

    info = engine_info(name)
    why_not = cannot(info, system)
    if why_not is not None or info.tree is None:
        raise InvalidInput(why_not or "")
    _require(info)
    mechanism = system.mechanism()
    return TreeShape(_tree_adapter(name, info.tree)(mechanism), info, mechanism)


def _tree_adapter(name: str, tree: TreeInfo) -> Any:
    place = _place(name)
    if place is None:
        return elsewhere.adapter(tree.adapter)
    from .places.remote import tree_class

    return tree_class(_connection(place))


def _require(info: EngineInfo) -> None:
    """Import the engine's own module. Raises :class:`EngineMissing` with how to install it."""
    if not info.module:
        return
    advice = f"{info.name} needs the package {info.package!r}: {installing(info.package)}"
    if info.package == "pin":
        advice += " (on PyPI Pinocchio is 'pin'; the package called 'pinocchio' there is an unrelated one)"
    try:
        module = importlib.import_module(info.module)
    except ImportError as error:
        version = _installed(info.package)
        if not version or isinstance(error, ModuleNotFoundError):
            raise EngineMissing(f"{advice} [{error}]") from error
        found = f"{info.name}: {info.package} {version} is installed and cannot be imported: {error}"
        if library := _SHARED.search(str(error)):
            found += f" (the system lacks the library {library[1]}; apt-file search {library[1]} tells its package)"
        raise EngineMissing(found) from error
    if info.package == "pin" and not hasattr(module, "buildModelFromXML"):
        raise EngineMissing(f"{advice}. It is that unrelated one which is installed here: pip uninstall pinocchio")
