"""Runs chunks on this machine: a thread for each core waits for a worker process of its own, which does the work."""

from __future__ import annotations

import threading
from collections.abc import Generator, Iterable, Iterator
from queue import Empty, SimpleQueue

from .chunk import Lane, Part, Stopped, Work, do
from .plan import Sweep

LOOK_UP = 0.5  # [s] between two looks at whether a thread is left
ENDS_WITHIN = 10.0  # [s]: a thread whose workers were ended


def run_here(sweep: Sweep, digest: str, works: Iterable[Work], jobs: int) -> Generator[tuple[Part, ...], None, None]:
    """The parts of each chunk, in the order in which they are done; ``jobs``: how many are under way at once.

    ``works`` is gone through as chunks are done, so that few are held at a time. Closed early, it ends its workers.
    """
    crew = _Crew(sweep, digest, jobs)
    waiting = iter(works)
    try:
        left = sum(crew.give(work) for work in _first(waiting, 2 * jobs))  # one that runs, one that is next
        while left:
            yield crew.result()
            left -= 1
            left += sum(crew.give(work) for work in _first(waiting, 1))
    finally:
        crew.end()


def _first(works: Iterator[Work], count: int) -> Iterator[Work]:
    for _, work in zip(range(count), works, strict=False):
        yield work


class _Crew:
    """Threads, each with a lane; what is given to them, and what comes back."""

    def __init__(self, sweep: Sweep, digest: str, jobs: int) -> None:
        self._sweep, self._digest = sweep, digest
        self._todo: SimpleQueue[Work | None] = SimpleQueue()
        self._done: SimpleQueue[tuple[Part, ...] | BaseException] = SimpleQueue()
        self._stopped = threading.Event()
        self._threads = [threading.Thread(target=self._work, daemon=True) for _ in range(jobs)]
        self._lanes: list[Lane] = []
        for thread in self._threads:
            thread.start()

    def give(self, work: Work) -> bool:
        """Have a chunk done."""
        self._todo.put(work)
        return True

    def result(self) -> tuple[Part, ...]:
        """The next that is done. Raises what a thread raised."""
        while True:
            try:
                found = self._done.get(timeout=LOOK_UP)  # so that a signal is handled in between
            except Empty:
                continue
            if isinstance(found, BaseException):
                raise found
            return found

    def end(self) -> None:
        """End all workers and threads, whatever they are doing."""
        self._stopped.set()
        for _ in self._threads:
            self._todo.put(None)
        for lane in list(self._lanes):
            for worker in [*lane.source.taken]:
                worker.process.kill()  # its thread notices, and ends the rest
        for thread in self._threads:
            thread.join(ENDS_WITHIN)

    def _work(self) -> None:
        """What a thread does. It starts its workers itself: they die with the thread that started them."""
        try:
            with Lane(self._sweep.memory) as lane:
                self._lanes.append(lane)
                while (work := self._todo.get()) is not None and not self._stopped.is_set():
                    self._done.put(do(self._sweep, self._digest, work, lane, self._stopped.is_set))
        except Stopped:
            pass
        except BaseException as error:  # the one who waits for it is told
            self._done.put(error)
