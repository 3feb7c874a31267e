"""Modules that most jobs need: a worker imports them while its first job is still being decided on.

Nothing is imported here, so that workers can be started before anything else.
"""

MODULES = ("furiko.checks.facts", "furiko.checks.causes")
