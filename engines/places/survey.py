"""Run by the Python of an environment, whatever its version: prints what is installed there, as JSON on one line.

It imports nothing of furiko, and is written in the Python of many years ago, so that an old one can say what it is.
"""

import json
import sys


def main() -> None:
    """Print version, search path, and the installed packages with their versions."""
    packages = {}
    try:
        from importlib.metadata import distributions

        for one in distributions():
            name = one.metadata["Name"]
            if name and name.lower() not in packages:  # the first on the search path is the one that is imported
                packages[name.lower()] = one.version
    except ImportError:  # before 3.8
        pass
    version = ".".join(map(str, sys.version_info[:3]))
    sys.stdout.write(json.dumps({"version": version, "path": [p for p in sys.path if p], "packages": packages}) + "\n")


if __name__ == "__main__":
    main()
