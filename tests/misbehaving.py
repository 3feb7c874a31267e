"""Functions and jobs for workers that die, hang, fail, or write anything into their connection."""

import os
import sys
import time
from dataclasses import dataclass

from furiko.engines.workers.channel import encode
from furiko.engines.workers.frames import HEADER, MAGIC
from furiko.engines.workers.messages import Step


def die():
    os.abort()


def hang():
    time.sleep(3600)


def fail():
    raise ValueError("no")


def double(number):
    return 2 * number


def connection():
    """The file descriptor of this worker's connection."""
    return int(sys.argv[1])


def rubbish():
    os.write(connection(), b"engine: warning: time step too large\n" * 1000)
    return "an answer"


def endless():
    os.write(connection(), HEADER.pack(MAGIC, 2**62, 0))
    time.sleep(3600)


def half_a_message():
    os.write(connection(), encode("a message" * 100)[:60])
    time.sleep(3600)


def damaged():
    frame = bytearray(encode("a message" * 100))
    frame[-5] ^= 1
    os.write(connection(), frame)
    time.sleep(3600)


@dataclass(frozen=True)
class LosesOne:
    """Claims to have sent one message more than arrives."""

    def run(self, send):
        from furiko.engines.workers import channel

        send("first")
        real, channel.Channel.send = channel.Channel.send, lambda self, message: None
        send("second")
        channel.Channel.send = real


@dataclass(frozen=True)
class Works:
    """Takes its time with work of its own, or in an engine."""

    engine: bool
    seconds: float

    def run(self, send):
        send(Step("energy", engine=self.engine))
        time.sleep(self.seconds)
        send("done")
