#!/usr/bin/python3
"""wheel.py FOLDER [PYTHON...]: makes a wheel in FOLDER that runs on other distributions than this one.

Inside are the Python package, the program and the shared libraries of both but for those of the C and
C++ runtime, with their licences. Its tag names the oldest glibc that it runs with: that of the newest
symbol in it. Pictures are PNG and PPM; the module for other formats needs OpenImageIO and is left out.
It is for the CPython that runs this script, or one for each PYTHON: all but the bindings is compiled
once then. Each has pip, setuptools, wheel, and a pybind11 that knows it. Needs binutils and patchelf.
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# What every system has, and what must be the system's own.
RUNTIME = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)|linux-vdso)\.so")


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **options).stdout


def libraries(program):
    """What a program or library needs, the runtime left out: {name: file}."""
    found = {}
    for name, path in re.findall(r"^\s*(\S+) => (\S+)", run("ldd", program), re.M):
        if RUNTIME.match(name):
            continue
        if not path.startswith("/"):
            sys.exit(f"wheel.py: {program.name} needs {name}, which is not here")
        found[name] = pathlib.Path(path).resolve()
    return found


def own_name(path):
    """Of a library in the wheel: no other wheel's is meant."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
    stem, dot, rest = path.name.partition(".so")
    return f"{stem}-{digest}{dot}{rest}"


def bundle(unpacked):
    """Copies the libraries beside the package and lets all find them there."""
    folder = unpacked / "boule.libs"
    folder.mkdir()
    programs = [*(unpacked / "boule").glob("_core*.so"), unpacked / "boule" / "bin" / "boule"]
    needed = {}
    for program in programs:
        needed |= libraries(program)
    names = {name: own_name(path) for name, path in needed.items()}
    for name, path in needed.items():
        shutil.copy2(path, folder / names[name])
        run("patchelf", "--set-soname", names[name], folder / names[name])
    for file in [*programs, *folder.iterdir()]:
        for name in set(run("patchelf", "--print-needed", file).split()) & set(names):
            run("patchelf", "--replace-needed", name, names[name], file)
        way = os.path.relpath(folder, file.parent)
        run("patchelf", "--set-rpath", "$ORIGIN" if way == "." else f"$ORIGIN/{way}", file)
    return needed.values(), [*programs, *folder.iterdir()]


def add_licences(unpacked, files):
    """Those that Debian's packages of the files have."""
    folder = next(unpacked.glob("*.dist-info")) / "licenses"
    folder.mkdir(exist_ok=True)
    for file in files:
        # The package database may know the file below /lib, which is /usr/lib.
        owner = run("dpkg", "-S", f"*{str(file).removeprefix('/usr')}").split(":")[0]
        shutil.copy2(f"/usr/share/doc/{owner}/copyright", folder / f"{owner}.txt")


def newest_glibc(files):
    symbols = "".join(run("objdump", "-T", file) for file in files)
    return max(tuple(map(int, version.split("."))) for version in re.findall(r"GLIBC_(\d+\.\d+)", symbols))


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[1]).resolve()
    if len(sys.argv) > 2:
        with tempfile.TemporaryDirectory() as build:
            for python in sys.argv[2:]:
                subprocess.run([python, __file__, target], check=True, env=os.environ | {"BOULE_BUILD_FOLDER": build})
        return
    make_wheel(target)


def make_wheel(target):
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        subprocess.run([sys.executable, "-m", "pip", "wheel", ROOT, "--no-deps", "--no-build-isolation",
                        "--wheel-dir", work], check=True)  # fmt: skip
        unpacked = work / "unpacked"
        with zipfile.ZipFile(next(work.glob("*.whl"))) as archive:
            archive.extractall(unpacked)
        for module in (unpacked / "boule").glob("boule_*.so"):  # OpenImageIO, pango, HDF5: the system's, if any
            module.unlink()
        program = unpacked / "boule" / "bin" / "boule"
        program.chmod(0o755)
        bundled, files = bundle(unpacked)
        add_licences(unpacked, bundled)
        major, minor = newest_glibc(files)
        facts = next(unpacked.glob("*.dist-info")) / "WHEEL"
        tag = rf"\1manylinux_{major}_{minor}_{os.uname().machine}"
        facts.write_text(re.sub(r"^(Tag: .*-)\S+$", tag, facts.read_text(), flags=re.M))
        target.mkdir(parents=True, exist_ok=True)
        subprocess.run([sys.executable, "-m", "wheel", "pack", unpacked, "-d", target], check=True)


main()
