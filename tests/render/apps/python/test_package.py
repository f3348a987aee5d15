"""The package as such: what importing it loads, its stubs, its examples."""

import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT

import boule

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = ROOT / "render" / "apps" / "python" / "examples"
PACKAGE = pathlib.Path(boule.__file__).resolve().parent


def run(*arguments, **options):
    told = subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, timeout=300, **options
    )
    assert told.returncode == 0, told.stdout + told.stderr
    return told.stdout


def test_importing_loads_next_to_nothing():
    told = run("-c", "import sys, boule; print(*sys.modules); print(open('/proc/self/maps').read())")
    modules, maps = told.split("\n", 1)
    for name in ("numpy", "tqdm", "asyncio", "ctypes"):
        assert name not in modules.split(), name
    for library in ("OpenImageIO", "OpenEXR", "boule_image_io"):
        assert library not in maps, library
    # Tracing and rendering need numpy, pictures in files OpenImageIO.
    told = run("-c", "import boule; boule.Tracer([[0, 0, 0]], 1).closest([[0, 0, 5]], [[0, 0, -1]]);"
               "print(open('/proc/self/maps').read())")  # fmt: skip
    assert "OpenImageIO" not in told


def test_numpy_has_bounds_and_is_within_them():
    """In the metadata of the wheel and of the Debian package, and the same in both."""
    low = re.search(r"numpy>=([\d.]+),<", (ROOT / "setup.py").read_text()).group(1)
    control = (ROOT / "packaging" / "debian" / "control").read_text()
    assert f"python3-numpy (>= 1:{low}), python3-numpy (<< 1:${{numpy:Below}}~)" in control
    version = [int(part) for part in re.findall(r"\d+", np.__version__)[:2]]
    assert [int(part) for part in low.split(".")] <= version < [boule._core.numpy_below]


def test_numpy_that_is_too_new_is_refused():
    below = boule._core.numpy_below
    told = run("-c", f"""if True:
        import numpy, boule
        numpy.__version__ = "{below}.0.1"
        try:
            boule.Tracer([[0, 0, 0]], 1)
        except ImportError as error:
            print(error)
        numpy.__version__ = "{below - 1}.9"
        print(boule.Tracer([[0, 0, 0]], 1).any([[0, 0, 5]], [[0, 0, -1]]))""")
    assert told == f"numpy is {below}.0.1, but this boule was built for numpy<{below}\n[ True]\n"


# What numpy 2 no longer has, by its guide for migration, and what means something else there.
GONE = re.compile(
    r"\b(?:np|numpy)\.(?:core|compat|add_newdoc|alltrue|asfarray|byte_bounds|cast|cfloat|complex_|"
    r"compare_chararrays|cumproduct|DataSource|deprecate|disp|find_common_type|float_|format_parser|"
    r"geterrobj|in1d|Inf|Infinity|infty|issctype|issubclass_|issubsctype|lookfor|longcomplex|longfloat|"
    r"mat|maximum_sctype|msort|NaN|nbytes|NINF|NZERO|obj2sctype|PINF|product|PZERO|recfromcsv|"
    r"recfromtxt|round_|row_stack|safe_eval|sctype2char|sctypeDict|sctypes|set_numeric_ops|"
    r"set_string_function|singlecomplex|sometrue|source|string_|trapz|unicode_|who)\b"
    r"|\.(?:ptp|itemset)\(|\bcopy=False"
)


def test_scripts_use_what_numpy_2_has():
    scripts = [
        script
        for folder in ("render", "scenes", "bench", "tests", "packaging")
        for script in (ROOT / folder).rglob("*.py")
    ]
    assert len(scripts) > 40
    for script in scripts:
        if script.samefile(__file__):
            continue
        for number, line in enumerate(script.read_text(encoding="utf-8").splitlines(), 1):
            assert not GONE.search(line), f"{script}:{number}: {line}"


def test_version_and_isa():
    project = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    assert f"project(boule VERSION {boule.__version__} " in project
    assert boule.isa() in ("scalar", "sse42", "avx2", "avx512", "neon")


def test_everything_public_says_what_it_is():
    for name in boule.__all__:
        thing = getattr(boule, name)
        if name != "__version__":
            assert thing.__doc__, name
            assert thing.__module__ in ("boule", "boule._core"), name


def check_types(*arguments):
    pytest.importorskip("mypy")
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    return run("-m", *arguments, env=environment, cwd=HERE)


def test_stubs_are_complete(tmp_path):
    """stubtest compares them with the package: every name, argument and default."""
    check_types(
        "mypy.stubtest", "boule", "--mypy-config-file", str(HERE / "mypy.ini"), "--allowlist",
        str(HERE / "stubtest_allowed.txt"), "--ignore-missing-stub", "--ignore-unused-allowlist",
    )  # fmt: skip


def test_stubs_have_every_public_name():
    import ast

    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    known = {node.name for node in tree.body if hasattr(node, "name")}
    known |= {node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)}
    assert set(boule.__all__) <= known
    assert (PACKAGE / "py.typed").exists()


def test_examples_have_strict_types(tmp_path):
    examples = sorted(str(path) for path in EXAMPLES.glob("*.py"))
    assert len(examples) >= 3
    check_types("mypy", "--strict", "--config-file", str(HERE / "mypy.ini"), "--cache-dir",
                str(tmp_path), *examples)  # fmt: skip


def test_a_wrong_argument_is_a_wrong_type(tmp_path):
    pytest.importorskip("mypy")
    path = tmp_path / "wrong.py"
    path.write_text("import boule\nboule.Plastic(colour=1)\nboule.render(3)\n")
    told = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", HERE / "mypy.ini", "--cache-dir", tmp_path,
         path],
        capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
    )  # fmt: skip
    assert "Found 2 errors" in told.stdout, told.stdout


@pytest.mark.parametrize(
    "name, needs, pictures",
    [
        ("ase_two_lines", "ase", ["picture.png"]),
        ("mdanalysis_frames", "MDAnalysis", [f"frame{k:04d}.png" for k in range(4)]),
        ("matplotlib_depth", "matplotlib", ["picture.png"]),
    ],
)
def test_examples_make_pictures(name, needs, pictures, tmp_path):
    pytest.importorskip(needs)
    image = pytest.importorskip("matplotlib.image")
    target = tmp_path if len(pictures) > 1 else tmp_path / pictures[0]
    run("-W", "ignore", EXAMPLES / f"{name}.py", target, env={**os.environ, "HOME": str(tmp_path)})
    for picture in pictures:
        pixels = image.imread(tmp_path / picture)
        assert pixels.shape[0] >= 240 and pixels[..., :3].std() > 0.05


def test_the_notebook_runs(tmp_path):
    """Every cell of the gallery's notebook, in a kernel of its own."""
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(ROOT / "scenes" / "spheres.ipynb", as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": tmp_path}}
    )
    client.execute(env={**os.environ, "HOME": str(tmp_path)})
    shown = [
        output
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert len(shown) >= 3


ENDLESS = """
import numpy as np, boule
scene = boule.Scene(background=boule.GradientBackground())
scene.add_spheres(np.random.default_rng(0).uniform(-5, 5, (5000, 3)), 0.2)
begun = []
boule.render(scene, size=(160, 120), spp=1_000_000, method="path", partial=True,
             progress=lambda share: begun or begun.append(print("begun", flush=True)))
"""


def test_interrupted_kernel_shows_what_is_done(tmp_path):
    manager = pytest.importorskip("jupyter_client.manager")
    pytest.importorskip("ipykernel")
    kernel, client = manager.start_new_kernel(
        kernel_name="python3", env={**os.environ, "HOME": str(tmp_path)}
    )
    try:
        client.execute(ENDLESS)
        shown = None
        while shown is None:
            message = client.get_iopub_msg(timeout=120)
            content = message["content"]
            assert message["msg_type"] != "error", content
            if message["msg_type"] == "stream" and "begun" in content["text"]:
                kernel.interrupt_kernel()
            if message["msg_type"] == "execute_result":
                shown = content["data"]
        assert "unfinished" in shown["text/plain"] and len(shown["image/png"]) > 1000
    finally:
        client.stop_channels()
        kernel.shutdown_kernel(now=True)
