"""The threads on which compiled code runs."""

from __future__ import annotations

import os
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache

from ...models.errors import InvalidInput


def processors(threads: int | None) -> int:
    """The number of threads that may run: at most those asked for and the processors of this process.

    Raises InvalidInput below one thread.
    """
    if threads is not None and threads < 1:
        raise InvalidInput(f"threads: at least 1 is needed, got {threads}")
    if threads == 1:
        return 1
    available = len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
    return min(threads or available, available)


@cache
def thread_pool() -> ThreadPoolExecutor:
    """The threads that compiled code runs on; started once."""
    return ThreadPoolExecutor(processors(None), thread_name_prefix="furiko")


if sys.platform != "win32":
    os.register_at_fork(after_in_child=thread_pool.cache_clear)  # a child has the pool, but none of its threads
