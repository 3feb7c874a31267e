"""Programs as data, whatever their language: a module for each, which makes a :class:`~.program.Program` of a text.

Texts are data; nothing of them is run. Where equations are stated, rows are made.

May import models (for its errors), and markup, names and statements of dialects.
"""
