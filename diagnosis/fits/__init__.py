"""Wrong numbers and wrong terms as hypotheses, fitted to what an engine was measured to do.

Imports what the folder above does, and :mod:`..question`, :mod:`..measurement`, :mod:`..finding` of it.
"""
