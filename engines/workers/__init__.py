"""The processes in which engines run, so that one that crashes or hangs takes nothing else along.

A worker runs jobs, one after the other; it knows no job, and a job knows no worker. The pool hands jobs out, keeps the
clock, and tells what became of each. May import: records, models.errors.
"""
