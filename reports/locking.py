"""A lock on an open file, so that no two runs write one stream."""

from __future__ import annotations

import sys

if sys.platform == "win32":

    def lock(descriptor: int) -> None:
        """No lock: Windows has none that leaves the file readable. Lines of two runs are told by the digest."""

else:
    import fcntl

    def lock(descriptor: int) -> None:
        """Keep every other run from writing the open file. Raises BlockingIOError where one does so already."""
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
