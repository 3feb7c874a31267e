"""The one function of a program that has the equations of motion, written as Python would, for ``functions`` to follow.

``chosen`` finds it, ``neutral`` follows one whose state is an array, ``by_name`` one whose state is in names, and
``writer`` puts their statements into words that the reader knows.

May import models (for its errors), and languages, letters, markup, names, statements and table of dialects.
"""
