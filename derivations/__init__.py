"""The audit of the documents, the catalogue of mistakes, and the grader.

From a derivation to a diagnosis: :mod:`.submission` reads it (:mod:`.tokens`, :mod:`.parser`, :mod:`.evaluation`) into
the exact algebra of :mod:`.trig`; :mod:`.verdict` decides whether it is right; :mod:`.explain` looks for mistakes of
the catalogue (:mod:`.mistakes`) that lead to it; :mod:`.findings` tells the terms; :mod:`.grade` puts it together.
Nothing is imported here, so that each part costs only what it needs.

May import models and reference.
"""
