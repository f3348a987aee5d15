"""run_pytest.py FILE: its tests by pytest; 77, skipped, where pytest or numpy is missing."""

import importlib.util
import sys

for needed in ("numpy", "pytest"):
    if importlib.util.find_spec(needed) is None:
        print(f"skipped: there is no {needed}")
        sys.exit(77)

import pytest

sys.exit(pytest.main(["-q", "-rs", "-p", "no:cacheprovider", "--durations=3", sys.argv[1]]))
