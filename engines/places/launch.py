"""Starts a program under limits, and has it end with its parent: ``python launch.py PARENT MEMORY PROGRAM …``.

The limits are set here, between two processes, because there they hold for whatever is started: an interpreter of
another version or a program in another language. ``MEMORY``: bytes that it may allocate, 0 for any number.
"""

from __future__ import annotations

import os
import signal
import sys

PR_SET_PDEATHSIG = 1


def main() -> None:
    """Set the limits and become the program; ends with status 127 where there is no such program."""
    parent, memory = int(sys.argv[1]), int(sys.argv[2])
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it ended before the system was told
        os._exit(0)
    if sys.platform != "win32":
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if memory:
            resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
    try:
        os.execv(sys.argv[3], sys.argv[3:])
    except OSError as error:
        sys.stderr.write(f"{sys.argv[3]} cannot be started: {error.strerror}\n")
        os._exit(127)


if __name__ == "__main__":
    main()
