"""Scripts that derive the equations of motion by computer algebra: followed as formulas, and differentiated.

sympy and casadi in Python, MATLAB's symbols, Maxima and Mathematica. Nothing is run.

May import models (for its errors), and letters, names, parsers, statements and traced of dialects.
"""
