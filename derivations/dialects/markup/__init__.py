"""Equations inside something else: pages (HTML, MathML), Typst, AsciiMath, e-mails, sentences, numbered rows.

Only the formulas are taken out; what may belong to the mathematics, and is not understood, is refused. Nothing is run,
and entities of a document type are not expanded.

May import models (for its errors), and letters, lines and names of dialects.
"""
