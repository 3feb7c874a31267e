"""Starts :mod:`.serve` in an environment that has no furiko: ``python -I start.py PACKAGE MODULE PLANAR TREE READER``.

``PACKAGE`` is furiko's own folder, which becomes importable without anything that lies beside it.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys


def main() -> None:
    """Find furiko, and serve."""
    here = os.path.dirname(os.path.abspath(__file__))
    sys.path[:] = [path for path in sys.path if os.path.abspath(path) != here]
    folder = sys.argv[1]
    spec = importlib.util.spec_from_file_location(
        "furiko", os.path.join(folder, "__init__.py"), submodule_search_locations=[folder]
    )
    if spec is None or spec.loader is None:
        raise SystemExit(f"there is no package in {folder}")
    module = importlib.util.module_from_spec(spec)
    sys.modules["furiko"] = module
    spec.loader.exec_module(module)
    importlib.import_module(".engines.places.serve", package=module.__name__).serve(*sys.argv[2:])


if __name__ == "__main__":
    main()
