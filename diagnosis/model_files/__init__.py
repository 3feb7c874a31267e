"""``furiko diagnose``: a user's own model file, in every engine that reads it, against the theory.

:mod:`.diagnose` puts it together: each engine's answer and its causes (:mod:`.engine_answers`, :mod:`.engine_causes`),
the vote of the engines (:mod:`.voting`), the comparison with a scene or another model (:mod:`.comparison`,
:mod:`.matching`), and the result (:mod:`.result`). Everything else in ``diagnosis`` knows nothing of this folder.
May import: models, reference, engines, and the rest of diagnosis.
"""
