"""The group of all commands, their errors as one line each, and the exit status."""

from __future__ import annotations

import contextlib
import difflib
import os
import sys
from importlib import import_module

import click

from .. import __version__
from ..records.exit_status import AGREES, CLOSED_PIPE
from .failures import Failure, failure_of
from .output import documents_printed, print_failure, print_json
from .process import OutputFailed, flush, open_standard_streams, stopped

COMPLETION = "_FURIKO_COMPLETE"  # set by a shell that asks for completions

# The command NAME is the function NAME in the file NAME.py, with _ for -. Its line in `furiko --help` is the first line
# of its own help (a test compares them); it is repeated here so that `furiko --help` imports no command.
COMMANDS = {
    "advise": "Say which engine, integrator and step to use for a scene.",
    "audit": "Check the documents' 57 equations against first principles.",
    "bench": "Measure time against error, for engines and for furiko itself.",
    "cache": "Show or clear the results kept from earlier runs.",
    "check": "Check engines against the documents' equations.",
    "diagnose": "Check how engines read an MJCF or URDF file; say why they differ.",
    "diff": "Compare two runs of check.",
    "enclose": "Prove where a scene's motion is: intervals that contain it.",
    "engine-test": "Test an adapter, step by step, before its engine is judged.",
    "engines": "List the engines, their versions, and what they cannot compute.",
    "environments": "List or remove the environments made for versions of engines.",
    "export": "Write a scene's mechanism as an MJCF or URDF file.",
    "grade": "Grade a derivation: correct, or which term is wrong and why.",
    "history": "Show a folder of runs as one page, with badges.",
    "lesson": "Write a web page for teaching: thirty mistakes in derivations.",
    "map": "Draw flip times, stretching or chaos over a square of starts.",
    "scenes": "List the scenes of the catalogue.",
    "stress": "Find where engines, integrators and formulas break.",
    "sweep": "Run a grid of scenes, engines and seeds; resumable, on all cores.",
    "versions": "Find which release of an engine changed what, by the theory.",
}


class _Commands(click.Group):
    """Commands that are imported one at a time: the registered ones are placeholders with a name and a help line."""

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command itself; None where no command has this name."""
        if cmd_name not in self.commands:
            return None
        name = cmd_name.replace("-", "_")
        command: click.Command = getattr(import_module(f".{name}", __package__), name)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that the first word names. A word that is none is answered with the nearest one."""
        word = args[0]
        if word not in self.commands and not word.startswith("-"):
            close = difflib.get_close_matches(word, self.commands, n=1)
            hint = f" (did you mean {close[0]!r}?)" if close else ""
            raise click.UsageError(
                f"{word[:100]!r}: no such command{hint}; commands are {', '.join(self.commands)}", ctx
            )
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The list of commands in the help, from the placeholders."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, self.commands[name].short_help or "") for name in self.list_commands(ctx)])


@click.group(
    cls=_Commands,
    commands=[click.Command(name, short_help=line) for name, line in COMMANDS.items()],
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, package_name="furiko")
def cli() -> None:
    """Cross-check hand-derived equations of motion of multi-pendulums and physics engines."""


def main() -> int:
    """Run the command line of this process; returns its exit status."""
    open_standard_streams()
    return run(sys.argv[1:])


def run(arguments: list[str]) -> int:
    """Run one command line; returns its exit status. A failure is one line on stderr, and a document with --json."""
    before = documents_printed()
    try:
        status = cli.main(arguments or ["--help"], prog_name="furiko", standalone_mode=False)
        flush()
        if signalled := stopped():  # an engine's own code swallowed it, and what it then gave is worth nothing
            raise signalled
    except BaseException as error:
        if isinstance(error, SystemExit) and COMPLETION in os.environ:
            return error.code if isinstance(error.code, int) else AGREES
        # click turns a signal's exception into its own, and so do some engines
        cause = stopped() or error
        with_document = "--json" in arguments and documents_printed() == before
        return _fail(failure_of(cause), with_document=with_document)
    return status if isinstance(status, int) else AGREES


def _fail(failure: Failure, *, with_document: bool) -> int:
    """Say it: whatever standard output and error take. The status stays that of the failure."""
    if failure.message:
        print_failure(failure.message)
    if with_document and failure.status != CLOSED_PIPE:
        from ..records.errors import ErrorDocument

        with contextlib.suppress(OutputFailed):
            print_json(ErrorDocument(error=failure.record()))
            flush()
    return failure.status
