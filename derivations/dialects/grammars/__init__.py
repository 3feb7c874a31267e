"""Programs whose language has a tree-sitter grammar, in the tree of ``traced``: one follower follows them all.

``languages`` has each language's data, ``parsed`` finds the language and the syntax tree; ``patterns``, ``made``,
``expressions``, ``statements``, ``control`` and ``functions`` turn it into ``traced``'s nodes; ``records``, ``calls``,
``places``, ``steps`` and ``follow`` are what these languages have and Python has not; ``rows`` says what moves.

May import models (for its errors), and letters, names, statements and traced of dialects. Grammars are imported when a
text of their language is there, not before.
"""
