"""furiko: cross-checks hand-derived equations of motion and physics engines, and names the cause where they differ.

A name is imported when it is first used: ``import furiko`` alone imports neither an engine nor numpy.
May import everything else of the package; nothing else imports it.
"""

import sys


def _quiet_start() -> None:
    """In the command line's own process Ctrl-C ends it in silence, until furiko.cli answers with a sentence.

    First of all, since Python would print a traceback. The module ``signal`` takes longer to import than all else here.
    """
    name = sys.argv[0] if sys.argv else ""  # an embedded interpreter has none
    module = name == "-m" and "furiko" in sys.orig_argv  # python -m furiko: its name comes later
    ours = module or name.replace("\\", "/").rpartition("/")[2] in ("furiko", "furiko.exe")
    signals = sys.modules["_signal"]
    if ours and signals.getsignal(signals.SIGINT) is signals.default_int_handler:  # not where it is ignored
        signals.signal(signals.SIGINT, signals.SIG_DFL)


_quiet_start()

from importlib import import_module  # noqa: E402

TYPE_CHECKING = False  # typing is imported by nothing else of this file
if TYPE_CHECKING:
    from typing import Any

    from .derivations.audit.audit import audit
    from .derivations.classroom.assess import Assessment
    from .derivations.classroom.in_python import grade_text
    from .derivations.grading.grade import grade
    from .derivations.grading.grade_record import Grade
    from .diagnosis.model_files.diagnose import diagnose
    from .diagnosis.model_files.result import Diagnosis
    from .engines import engine_names, load_engine
    from .models import EngineMissing, InvalidInput, LibraryMissing, NLegPendulum, RodChain, to_mjcf, to_urdf
    from .reference.integration.flips import FlipTimes, flip_times
    from .reference.integration.tangents import Exponents, Stretching, lyapunov, stretching
    from .reference.integration.taylor import simulate
    from .reference.kernels.energy import energy
    from .reference.kernels.forward_dynamics import accelerations
    from .reference.proved.enclose import Enclosed, enclose
    from .reports import Report, read_stream
    from .run import check

__version__ = "0.1.0"

_HOMES = {
    "Assessment": "derivations.classroom.assess",
    "Diagnosis": "diagnosis.model_files.result",
    "Enclosed": "reference.proved.enclose",
    "EngineMissing": "models",
    "Exponents": "reference.integration.tangents",
    "FlipTimes": "reference.integration.flips",
    "Grade": "derivations.grading.grade_record",
    "InvalidInput": "models",
    "LibraryMissing": "models",
    "NLegPendulum": "models",
    "Report": "reports",
    "RodChain": "models",
    "Stretching": "reference.integration.tangents",
    "accelerations": "reference.kernels.forward_dynamics",
    "audit": "derivations.audit.audit",
    "check": "run",
    "diagnose": "diagnosis.model_files.diagnose",
    "enclose": "reference.proved.enclose",
    "energy": "reference.kernels.energy",
    "engine_names": "engines",
    "flip_times": "reference.integration.flips",
    "grade": "derivations.grading.grade",
    "grade_text": "derivations.classroom.in_python",
    "load_engine": "engines",
    "lyapunov": "reference.integration.tangents",
    "read_stream": "reports",
    "simulate": "reference.integration.taylor",
    "stretching": "reference.integration.tangents",
    "to_mjcf": "models",
    "to_urdf": "models",
}

__all__ = [
    "Assessment",
    "Diagnosis",
    "Enclosed",
    "EngineMissing",
    "Exponents",
    "FlipTimes",
    "Grade",
    "InvalidInput",
    "LibraryMissing",
    "NLegPendulum",
    "Report",
    "RodChain",
    "Stretching",
    "accelerations",
    "audit",
    "check",
    "diagnose",
    "enclose",
    "energy",
    "engine_names",
    "flip_times",
    "grade",
    "grade_text",
    "load_engine",
    "lyapunov",
    "read_stream",
    "simulate",
    "stretching",
    "to_mjcf",
    "to_urdf",
]


def __getattr__(name: str) -> "Any":
    if name not in _HOMES:
        raise AttributeError(f"module 'furiko' has no attribute {name!r}")
    value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
