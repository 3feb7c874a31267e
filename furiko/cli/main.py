"""The group of all commands, their errors as one line each, and the exit status."""

from __future__ import annotations

import os
import sys
from importlib import import_module

import click

from .. import __version__
from ..records.exit_status import AGREES, BAD_INPUT, INCOMPLETE, INTERRUPTED

# The command NAME is the function NAME in the file NAME.py. Its line in `furiko --help` is the first line of its own
# help (a test compares them); it is repeated here so that `furiko --help` imports no command.
COMMANDS = {
    "audit": "Check the documents' 57 equations against first principles.",
    "bench": "Measure time against error, for engines and for furiko itself.",
    "cache": "Show or clear the results kept from earlier runs.",
    "check": "Check engines against the documents' equations.",
    "diagnose": "Check how engines read an MJCF or URDF file; say why they differ.",
    "diff": "Compare two runs of check.",
    "engines": "List the engines, their versions, and what they cannot compute.",
    "export": "Write a scene's mechanism as an MJCF or URDF file.",
    "grade": "Grade a derivation: correct, or which term is wrong and why.",
    "lesson": "Write a web page for teaching: thirty mistakes in derivations.",
    "scenes": "List the scenes of the catalogue.",
    "stress": "Find where engines, integrators and formulas break.",
}


class _Commands(click.Group):
    """Commands that are imported one at a time: the registered ones are placeholders with a name and a help line."""

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command itself; None where no command has this name."""
        if cmd_name not in self.commands:
            return None
        command: click.Command = getattr(import_module(f".{cmd_name}", __package__), cmd_name)
        return command

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


def main() -> None:
    """Run the command line of this process, and end the process with its exit status."""
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """Run one command line; returns its exit status. An error that the user can correct is one line on stderr."""
    try:
        status = cli.main(arguments, prog_name="furiko", standalone_mode=False)
        sys.stdout.flush()
    except click.ClickException as error:
        return _fail(error.format_message(), BAD_INPUT)
    except (KeyboardInterrupt, click.Abort):
        return _fail("interrupted; a stream of results that was being written has no footer: incomplete", INTERRUPTED)
    except BrokenPipeError:
        # The reader of standard output has closed it, so nothing more can be printed there.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return INTERRUPTED
    except (ValueError, RuntimeError) as error:
        # Imported here, not above: a check starts its workers before it imports numpy.
        from ..models import EngineMissing, InvalidInput

        if isinstance(error, InvalidInput):
            return _fail(str(error), BAD_INPUT)
        if isinstance(error, EngineMissing):
            return _fail(str(error), INCOMPLETE)
        raise
    return status if isinstance(status, int) else AGREES


def _fail(message: str, status: int) -> int:
    from ..reports.words import one_line  # a path or a name in the message may hold escape sequences

    print(f"furiko: {one_line(message)}", file=sys.stderr)
    return status
