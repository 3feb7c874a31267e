"""What rounding really does to engines' terms and accelerations of mechanisms in space, entry by entry, by sampling.

May import ``models`` and, of ``reference``, ``rounding`` and the kernels' formulas and tables.
"""
