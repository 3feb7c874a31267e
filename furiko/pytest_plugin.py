"""``pytest --furiko``: engines against the documents' equations, one test a scene and engine, in any project.

Known to pytest by its entry point. Without ``--furiko`` it adds options, a marker and a fixture, and imports nothing.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from .engines import AnyShape
    from .models import System
    from .records.check import Result
    from .reports import Report
    from .reports.known import Entry, Known

MARKER = "furiko: compares an engine with the documents' equations of motion"


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options; ``--furiko`` alone changes anything."""
    group = parser.getgroup("furiko", "engines against hand-derived equations of motion")
    group.addoption("--furiko", action="store_true", help="add a test for each scene and engine")
    group.addoption("--furiko-scene", action="append", default=[], metavar="GLOB|FILE.toml", help="only these scenes")
    group.addoption(
        "--furiko-engine", action="append", default=[], metavar="NAME|FILE.py|module:Class", help="only these engines"
    )
    group.addoption("--furiko-profile", default="quick", metavar="smoke|quick|full", help="how much is checked")
    group.addoption(
        "--furiko-known", metavar="FILE", help="a TOML file of known differences: they are expected to fail"
    )


def pytest_configure(config: pytest.Config) -> None:
    """Declare the marker; read what the options name, so that a mistake is told before anything runs."""
    config.addinivalue_line("markers", MARKER)
    if config.getoption("furiko"):
        config.stash[RUNS] = _told(lambda: _runs(config))


def pytest_unconfigure(config: pytest.Config) -> None:
    """End the workers."""
    runs = config.stash.get(RUNS, None)
    if runs is not None:
        runs.close()


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test that takes ``furiko_engine`` runs once for each engine."""
    if "furiko_engine" in metafunc.fixturenames:
        runs = metafunc.config.stash.get(RUNS, None)
        names = runs.engines if runs is not None else (None,)
        marked = [pytest.param(name, marks=pytest.mark.furiko, id=name or "no-engine") for name in names]
        metafunc.parametrize("furiko_engine", marked, indirect=True)


@dataclass(frozen=True)
class FurikoEngine:
    """An engine by name: ``furiko_engine(system)`` builds its model of a system, as :func:`furiko.load_engine`."""

    name: str

    def __call__(self, system: System) -> AnyShape:
        """The engine's model of a system; accelerations, energy and so on in absolute angles."""
        from .engines import load_engine

        return load_engine(self.name, system)


@pytest.fixture
def furiko_engine(request: pytest.FixtureRequest) -> FurikoEngine:
    """Each engine in turn, as a function of the system; skipped without ``--furiko``."""
    if request.param is None:
        pytest.skip("needs --furiko")
    return FurikoEngine(request.param)


@pytest.hookimpl(tryfirst=True)  # before -k and -m choose
def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config, items: list[pytest.Item]) -> None:
    """Add a test for each scene and engine."""
    runs = config.stash.get(RUNS, None)
    if runs is None:
        return
    collector = FurikoCollector.from_parent(session, name="furiko", nodeid="furiko")
    items += [
        FurikoItem.from_parent(collector, name=f"{_stem(scene)}-{engine}", scene=scene, engine=engine)
        for scene in runs.scenes
        for engine in runs.engines
    ]


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """A known difference that is none any more is an unexpected pass."""
    report = yield
    if report.when == "call" and report.passed and isinstance(item, FurikoItem) and item.agrees_now:
        report.wasxfail = item.agrees_now
    return report


class FurikoCollector(pytest.Collector):
    """The parent of all of furiko's tests."""

    def collect(self) -> list[pytest.Item]:
        """Nothing: they are added to those collected."""
        return []


class FurikoItem(pytest.Item):
    """One scene on one engine."""

    def __init__(self, *, scene: str, engine: str, **of_pytest: Any) -> None:
        super().__init__(**of_pytest)
        self.scene, self.engine = scene, engine
        self.agrees_now = ""
        self.add_marker("furiko")

    def runtest(self) -> None:
        """Pass where all that was compared agrees; skip where nothing was."""
        runs = self.config.stash[RUNS]
        wanted = [
            item.engine for item in self.session.items if isinstance(item, FurikoItem) and item.scene == self.scene
        ]
        known = runs.known(self.scene, wanted, self.engine)
        name = next(iter(known.report.scenes))
        results = [result for result in known.report.results if result.engine == self.engine]
        differs = [result for result in results if result.outcome == "differs"]
        accounted = [known.by_result[_key(result)] for result in differs if _key(result) in known.by_result]
        failed = [result for result in results if result.outcome == "error"]
        if len(differs) > len(accounted) or failed:
            raise FurikoDiffers(_message(known, name, self.engine))
        if accounted:
            pytest.xfail("; ".join(dict.fromkeys(" ".join([entry.reason, entry.link]).strip() for entry in accounted)))
        if all(result.outcome == "skipped" for result in results):
            pytest.skip("; ".join(dict.fromkeys(result.reason for result in results)) or "nothing to compare")
        self.agrees_now = "; ".join(entry.reason for entry in known.differences if entry.state == "agrees")
        if self.agrees_now and self.config.getini("xfail_strict"):
            raise FurikoDiffers(f"[XPASS(strict)] it agrees now; take the entry out: {self.agrees_now}")

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], *_: Any, **__: Any) -> Any:
        """The message alone where results differ."""
        if isinstance(excinfo.value, FurikoDiffers):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self) -> tuple[Path, None, str]:
        """Where it is: in no file."""
        return self.config.rootpath, None, f"furiko: {self.name}"


class FurikoDiffers(Exception):
    """Results that differ or failed."""


class Runs:
    """The scenes and engines that were asked for, and the runs so far: one a scene, for all engines that are left."""

    def __init__(self, scenes: Sequence[str], engines: Sequence[str], profile: str, known: Sequence[Entry]) -> None:
        self.scenes, self.engines, self._profile, self._known = tuple(scenes), tuple(engines), profile, tuple(known)
        self._open = contextlib.ExitStack()
        self._source: Any = None
        self._reports: dict[str, Report] = {}

    def known(self, scene: str, engines: Sequence[str], engine: str) -> Known:
        """One scene on one engine, against the known differences."""
        from dataclasses import replace

        import msgspec

        from .reports import footer_of, known_in

        if scene not in self._reports:
            self._reports[scene] = self._run(scene, engines)
        report = self._reports[scene]
        own = [result for result in report.results if result.engine == engine]
        told = [diagnosis for diagnosis in report.diagnoses if diagnosis.engine == engine]
        engines_of_it = [entry for entry in report.header.engines if entry.name == engine]
        header = msgspec.structs.replace(report.header, engines=engines_of_it)
        footer = footer_of(own, told) if report.footer is not None else None  # of this part: it is whole
        part = replace(report, header=header, results=tuple(own), footer=footer, diagnoses=tuple(told))
        return known_in(part, self._known)

    def _run(self, scene: str, engines: Sequence[str]) -> Report:
        from .checks.imported_ahead import MODULES
        from .engines.workers.processes import worker_processes
        from .run import check

        if self._source is None:
            self._source = self._open.enter_context(worker_processes(modules=MODULES))
        return check([scene], list(engines), profile=self._profile, source=self._source)

    def close(self) -> None:
        """End the workers."""
        self._open.close()


RUNS = pytest.StashKey[Runs]()


def _runs(config: pytest.Config) -> Runs:
    from .checks.plan import make_plan
    from .engines import all_of, engine_names, engine_version
    from .engines.elsewhere import look_in_current_folder
    from .reports import read_known

    profile: str = config.getoption("furiko_profile") or "quick"
    engines = config.getoption("furiko_engine") or [name for name in engine_names() if engine_version(name)]
    look_in_current_folder(engines)
    engines = all_of(engines)
    if not engines:
        raise pytest.UsageError("--furiko: no engine is installed: pip install 'furiko[mujoco]'")
    given: list[str] = config.getoption("furiko_scene") or []
    plan = make_plan(_chosen(given) if given else None, engines, profile)
    known = config.getoption("furiko_known")
    files = {Path(name).stem: str(Path(name).absolute()) for name in given if name.endswith(".toml")}
    scenes = [files.get(scene.name, scene.name) for scene in plan.scenes]
    return Runs(scenes, list(dict.fromkeys(engines)), profile, read_known(Path(known)) if known else ())


def _chosen(given: Sequence[str]) -> list[str]:
    """The names of the catalogue that patterns fit, and files as they are."""
    from .models import catalogue

    found: list[str] = []
    for pattern in given:
        names = [pattern] if pattern.endswith(".toml") else [n for n in catalogue() if fnmatchcase(n, pattern)]
        if not names:
            raise pytest.UsageError(f"--furiko-scene: no scene fits {pattern!r}; 'furiko scenes' lists them")
        found += names
    return list(dict.fromkeys(found))


def _told(make: Callable[[], Runs]) -> Runs:
    """What ``make`` gives; bad input as pytest tells a mistake of its user."""
    from .models import EngineMissing, InvalidInput

    try:
        return make()
    except (InvalidInput, EngineMissing) as error:
        raise pytest.UsageError(f"--furiko: {error}") from None


def _message(known: Known, scene: str, engine: str) -> str:
    """The cause first, then each check that differs or failed and is not known."""
    from .reports.report import against

    report = known.report
    lines = [f"{scene} × {engine}: {report.verdict}"]
    for diagnosis in report.diagnoses:
        lines += [f"  cause: {finding.says} [{finding.cause}]" for finding in diagnosis.findings]
        lines += [f"  or: {finding.says} [{finding.cause}]" for finding in diagnosis.alternatives]
    for result in report.having("differs", "error"):
        entry = known.by_result.get(_key(result))
        if entry is None:
            measured = against(result)
            lines.append(
                f"  {result.check}: {result.outcome}" + f": {measured}" * bool(measured) + f": {result.reason}"
            )
        else:
            lines.append(f"  {result.check}: known: {entry.reason}")
    return "\n".join(lines)


def _key(result: Result) -> tuple[str, str, str]:
    return result.scene, result.engine, result.check


def _stem(scene: str) -> str:
    return Path(scene).stem if scene.endswith(".toml") else scene
