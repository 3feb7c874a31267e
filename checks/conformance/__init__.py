"""Is an adapter wrong, before anything is said of its engine? The test behind ``furiko engine-test``.

:mod:`.kit` has the steps in their order and runs them in a process of their own; :mod:`.handling` looks at how
questions and answers are handled, whatever they are; :mod:`.conventions` at what the numbers mean; :mod:`.runs` at time
steps. Mechanisms are small, and conventions that are mixed up make differences of the size of the answer: digits are
for ``furiko check``.

May import engines, diagnosis, reference, models and records.
"""
