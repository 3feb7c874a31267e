"""Programs made plainer before a function is followed: loops, matrices filled entry by entry.

Texts are changed as data; nothing of them is run, and what is unrolled is bounded.

May import models (for its errors), and letters, markup, names, statements and table of dialects.
"""
