"""Sessions of computer algebra: Mathematica, Maple, Maxima, sympy, MATLAB's symbolic toolbox, and Modelica models.

A statement that says an equation is a row, one that says what a name is a definition; what does something else is
refused, or left out where it only prints, solves or declares.

May import models (for its errors), and letters, lines, markup and names of dialects.
"""
