"""What comparisons of motions share: textbook schemes, what rounding does in a step, and when runs part.

May import checks, and what checks may.
"""
