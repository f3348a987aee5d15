"""run_pytest.py FILE: its tests by pytest; 77, skipped, where pytest or numpy is missing."""

import importlib.util
import sys


def main():
    for needed in ("numpy", "pytest"):
        if importlib.util.find_spec(needed) is None:
            print(f"skipped: there is no {needed}")
            return 77
    import pytest

    return pytest.main(["-q", "-rs", "-p", "no:cacheprovider", "--durations=3", sys.argv[1]])


if __name__ == "__main__":
    sys.exit(main())
