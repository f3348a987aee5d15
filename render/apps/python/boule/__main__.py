"""The program boule, where it is inside the package, as in a wheel: python3 -m boule render scene.toml."""
import os
import pathlib
import sys


def main():
    program = pathlib.Path(__file__).parent / "bin" / "boule"
    if not program.exists():
        sys.exit("boule: this package does not have the program inside: it is installed by itself")
    os.environ.setdefault("BOULE_PYTHON", sys.executable)  # reads files of other programs
    os.execv(program, ["boule", *sys.argv[1:]])


if __name__ == "__main__":
    main()
