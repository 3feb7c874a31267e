"""``python -m furiko``."""

from .cli import main

main()
