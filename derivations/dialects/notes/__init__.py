r"""Notes: formulas of mathematics among words, in markdown, LaTeX or plain text, with what letters stand for.

What such a text says is sorted: equations of motion, what a name is, a rate that has a name, energies. A text is looked
at so only where it is no plain list of equations. What cannot be taken as meant is refused.

May import models (for its errors), and letters, lines, markup, worksheets and names of dialects.
"""
