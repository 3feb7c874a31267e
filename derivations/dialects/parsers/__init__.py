"""Programs in Lua, R and Fortran, for which no grammar is at hand: parsed here, followed as grammars follows others.

May import models (for its errors), and statements, traced and grammars of dialects.
"""
