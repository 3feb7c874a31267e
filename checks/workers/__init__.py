"""The processes in which engines run, so that one that crashes or hangs takes nothing else along."""
