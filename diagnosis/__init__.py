"""Why an engine or a model file differs from the theory: known causes, each tested by measurement.

:func:`.explain.explain` asks an engine for accelerations and inverse dynamics in many states, and names the causes that
leave no residual: other conventions (:mod:`.conventions`), what the engine compiled (:mod:`.compiled`,
:mod:`.differences`), limits and contacts, single precision, and wrong parameters, which are fitted
(:mod:`.hypotheses`, :mod:`.fitting`). :func:`.explain_motion.explain_motion` does the same for its time steps. A
:class:`.finding.Finding` is one cause with its evidence. :mod:`.model_files` diagnoses a user's own MJCF or URDF file,
for ``furiko diagnose``.

May import models, reference and engines; not checks, but for the worker processes in
:mod:`.model_files.engine_answers`.
"""
