"""What every line of a derivation is held to, before anything is made of it."""

import re

LONGEST_LINE = 20_000  # characters; a chain of four rods needs about 1000
# Full-width characters, as a Japanese keyboard types them, stand for their ASCII twins; the dots ¨ ˙ for
# those that combine.
FULL_WIDTH = {0xFF01 + i: 0x21 + i for i in range(94)} | {0x3000: 0x20, 0xA8: 0x308, 0x2D9: 0x307}
BLANKS = re.compile(r"\s{300}")  # nobody writes so many, and patterns may look at each of them again and again
# Words in a sentence that say that a formula beside them is not meant as it stands
DENIED = re.compile(
    r"\b(?:wrong|incorrect|mistaken?|erroneous|not|isn't|doesn't|falsch|nicht|kein\w*|faux|fausse|incorrecte?"
    r"|instead|rather than|should be|neglect\w*|approximat\w*|(?<!non-)(?<!non )(?<!non‐)linear\w*|small)\b"
    r"|誤|間違|でない|ではない|近似|無視|線形",
    re.IGNORECASE,
)
