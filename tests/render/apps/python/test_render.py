"""render() and Picture: the same pictures as the program's, and what stops them."""

import os
import subprocess
import threading
import time

import numpy as np
import pytest
from conftest import interrupt_after, program

import boule


def test_files_are_the_programs_byte_for_byte(tmp_path, scenes):
    scene = scenes / "first_light.toml"
    told = ["--size", "96x54", "--spp", "4", "--aov", "depth,normal,id", "--seed", "7", "-q"]
    subprocess.run([program(), "render", scene, "-o", tmp_path / "a.exr", *told], check=True)
    picture = boule.render(
        scene, size=(96, 54), spp=4, aov=["depth", "normal", "id"], seed=7
    )
    picture.save(tmp_path / "b.exr")
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    subprocess.run(
        [program(), "render", scene, "-o", tmp_path / "a.png", "--size", "96x54", "--spp", "4",
         "--seed", "7", "--exposure", "1", "-q"],
        check=True,
    )  # fmt: skip
    picture.save(str(tmp_path / "b.png"), exposure=1)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


@pytest.mark.parametrize("epsilon", ["none", 0.001])
def test_false_shadows_are_the_programs(tmp_path, scenes, epsilon):
    scene = scenes / "false_shadows.toml"
    told = ["--size", "96x54", "--shadow-epsilon", str(epsilon), "-q"]
    subprocess.run([program(), "render", scene, "-o", tmp_path / "a.png", *told], check=True)
    picture = boule.render(scene, size=(96, 54), shadow_epsilon=epsilon)
    picture.save(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert not np.array_equal(picture, boule.render(scene, size=(96, 54)))
    for wrong in ("some", -1):
        with pytest.raises(boule.Error) as told:
            boule.render(scene, shadow_epsilon=wrong)
        assert told.value.key == "shadow_epsilon"


@pytest.mark.parametrize("name", ["first_light", "depth_of_field", "double_gauss", "distorted", "far_away", "lecture", "daylight"])
def test_loaded_scene_gives_the_files_picture(scenes, name, tmp_path):
    path = scenes / f"{name}.toml"
    if not path.exists():
        pytest.skip(f"{path} is not there")
    try:
        loaded = boule.load(path)
    except boule.Error as error:
        pytest.skip(str(error))  # a picture that a program has to make first
    direct = np.asarray(boule.render(path, size=(64, 36), spp=2))
    assert (np.asarray(boule.render(loaded, size=(64, 36), spp=2)) == direct).all()


def test_every_option_counts(ball):
    plain = np.asarray(boule.render(ball))
    assert plain.shape == (48, 64, 3) and plain.dtype == np.float32
    for other in (
        {"spp": 4}, {"spp": 4, "filter": "tent"}, {"background": "#ffffff"}, {"outline": 2},
        {"method": "path", "spp": 4}, {"max_depth": 0, "spp": 2}, {"crop": (8, 8, 24, 20)},
        {"size": (32, 24)},
    ):  # fmt: skip
        picture = boule.render(ball, **other)
        assert picture.finished and picture.share == 1
        assert not np.array_equal(np.asarray(picture), plain), other
    for same in (
        {"order": "frameless"}, {"tile": 16}, {"threads": 1}, {"isa": "scalar"},
        {"solver": "reference"}, {"partial": True}, {"time_limit": 1e6},
    ):  # fmt: skip
        assert np.array_equal(np.asarray(boule.render(ball, **same)), plain), same
    path = {"method": "path", "spp": 4}
    one, other = boule.render(ball, seed=1, **path), boule.render(ball, seed=2**64 - 1, **path)
    assert not np.array_equal(np.asarray(one), np.asarray(other))
    crop = np.asarray(boule.render(ball, crop=(8, 8, 24, 20)))
    assert np.array_equal(crop, plain[8:20, 8:24])


def test_a_picture_is_an_array_in_place(ball):
    picture = boule.render(ball)
    array = np.asarray(picture)
    assert np.shares_memory(array, np.asarray(picture))
    with pytest.raises(ValueError):
        array[0] = 1
    first = array.copy()
    del picture
    assert np.array_equal(array, first)
    assert np.asarray(boule.render(ball), dtype=np.float64).dtype == np.float64


def test_channels_and_alpha(ball):
    picture = boule.render(ball, aov="depth,normal,position,id,albedo,z", background="transparent")
    hits = picture.aovs
    assert hits["depth"].shape == (48, 64) and hits["normal"].shape == (48, 64, 3)
    assert np.shares_memory(hits["depth"], picture.channels["Z"])
    assert hits["id"].dtype == np.uint32 and set(np.unique(hits["id"])) == {0, 1, 2**32 - 1}
    seen = np.isfinite(hits["depth"])
    eye = np.array([0, 2, 6])
    assert np.allclose(np.linalg.norm(hits["position"][seen] - eye, axis=1), hits["depth"][seen],
                       rtol=1e-6)  # fmt: skip
    assert np.array_equal(picture.alpha == 1, seen)
    assert boule.render(ball).alpha is None
    assert picture.to_srgb().shape == (48, 64, 4)
    assert boule.render(ball).to_srgb().dtype == np.uint8


def test_notebooks_show_a_picture(ball, tmp_path):
    png = boule.render(ball)._repr_png_()
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    boule.render(ball).save(tmp_path / "a.png")
    image = pytest.importorskip("matplotlib.image")
    import io

    shown = (image.imread(io.BytesIO(png))[..., :3] * 255).round().astype(np.uint8)
    assert np.array_equal(shown, boule.render(ball).to_srgb())
    assert np.array_equal(shown, (image.imread(tmp_path / "a.png")[..., :3] * 255).round())


def test_signal_ends_render_with_partial_picture(endless):
    interrupt_after(0.3)
    with pytest.raises(boule.Interrupted) as caught:
        boule.render(endless)
    assert isinstance(caught.value, KeyboardInterrupt)
    assert caught.value.picture is None or not caught.value.picture.finished


def test_partial_returns_the_unfinished_picture(endless, tmp_path):
    interrupt_after(0.5)
    picture = boule.render(endless, partial=True)
    assert not picture.finished and 0 < picture.share < 1
    assert "unfinished" in repr(picture)
    assert np.isfinite(np.asarray(picture)).all()
    picture.save(tmp_path / "a.exr")
    assert b"partial: " in (tmp_path / "a.exr").read_bytes()


def test_a_time_limit(endless):
    with pytest.raises(boule.Error, match="time limit") as caught:
        boule.render(endless, time_limit=0.1)
    assert caught.value.key == "time_limit"
    assert not boule.render(endless, time_limit=0.3, partial=True).finished


def test_progress_counts_and_may_stop(ball, endless, capsys):
    shares = []

    def tell(share):
        shares.append(share)
        if len(shares) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        boule.render(endless, progress=tell)
    assert len(shares) == 3 and shares == sorted(shares) and shares[0] >= 0
    boule.render(ball, progress=True)
    boule.render(endless, progress=True, time_limit=0.5, partial=True)
    assert "%" in capsys.readouterr().err
    with pytest.raises(boule.Error, match="progress"):
        boule.render(ball, progress="yes")


@pytest.mark.parametrize("size", [(8, 8), (160, 120)])
@pytest.mark.parametrize("noise", [0, 0.1])
def test_progress_ends_with_1(ball, size, noise):
    shares = []
    picture = boule.render(ball, size=size, spp=32, noise=noise, progress=shares.append)
    assert picture.finished and shares[-1] == 1 and shares.count(1) == 1
    assert shares == sorted(shares)


def test_progress_of_what_was_stopped_is_below_1(endless):
    shares = []
    boule.render(endless, progress=shares.append, time_limit=0.3, partial=True)
    assert all(share < 1 for share in shares)


def test_own_bar_ends_full(monkeypatch, ball, capsys):
    import sys

    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    boule.render(ball, progress=True)
    assert capsys.readouterr().err.endswith("] 100 %\n")


def test_the_own_bar(monkeypatch, endless, capsys):
    import sys

    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    boule.render(endless, progress=True, time_limit=0.5, partial=True)
    assert "rendering [" in capsys.readouterr().err


def test_other_threads_of_python_run_meanwhile(endless):
    counted = [0]
    done = threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    boule.render(endless, time_limit=0.5, partial=True)
    done.set()
    thread.join()
    assert counted[0] > 10


def test_two_threads_render_at_once(ball):
    expected = np.asarray(boule.render(ball, spp=8))
    found = [None] * 4

    def render(k):
        found[k] = np.asarray(boule.render(ball, spp=8, threads=1 + k % 2))

    threads = [threading.Thread(target=render, args=(k,)) for k in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(one, expected) for one in found)


def test_a_forked_process_renders_too(ball):
    expected = np.asarray(boule.render(ball))
    child = os.fork()
    if child == 0:
        same = np.array_equal(np.asarray(boule.render(ball)), expected)
        os._exit(0 if same else 1)
    assert os.waitpid(child, 0)[1] == 0


@pytest.mark.parametrize(
    "options, key, words",
    [
        ({"size": (0, 4)}, "size", "expected WIDTHxHEIGHT in pixels, each 1 to 65535"),
        ({"size": 4}, "size", "expected WIDTHxHEIGHT"),
        ({"spp": 1.5}, "spp", "expected a whole number, got float"),
        ({"spp": 10**30}, "spp", "must be 1 or above and at most 2147483647, is 1000000"),
        ({"max_depth": 2**31}, "max_depth", "at most 2147483647, is 2147483648"),
        ({"min_spp": 2**31}, "min_spp", "at most 2147483647, is 2147483648"),
        ({"frame": 2**40}, "frame", "at most 2147483647, is 1099511627776"),
        ({"seed": -1}, "seed", "expected a whole number from 0"),
        ({"filter": "tint"}, "filter", "did you mean 'tent'?"),
        ({"background": "rde"}, "background", "expected a colour"),
        ({"outline": 101}, "outline", "0 to 100 pixels"),
        ({"crop": (0, 0, 1000, 10)}, "crop", "lie within the frame"),
        ({"aov": "deep"}, "aov", "expected some of depth"),
        ({"method": "magic"}, "method", "expected 'whitted' or 'path'"),
        ({"time_limit": 0}, "time_limit", "must be above 0"),
        ({"order": "up"}, "order", "unknown name"),
        ({"isa": "mmx"}, "isa", "mmx"),
        ({"threads": 2000}, "threads", "is 2000"),
        ({"partial": 1}, "partial", "expected True or False"),
        ({"look": "paper"}, "look", "is of files"),
    ],
)
def test_errors_name_the_argument(ball, options, key, words):
    with pytest.raises(boule.Error) as caught:
        boule.render(ball, **options)
    assert words in str(caught.value)
    if key is not None:
        assert caught.value.key == key


@pytest.mark.parametrize("exposure", [np.nan, np.inf, 101, -101, 1e9])
def test_exposures_are_those_of_files(ball, exposure, tmp_path):
    picture = boule.render(ball, size=(8, 6))
    for call in (picture.to_srgb, lambda exposure: picture.save(tmp_path / "a.png", exposure=exposure)):
        with pytest.raises(boule.Error, match="must be from -100 to 100") as caught:
            call(exposure=exposure)
        assert caught.value.key == "exposure"
    assert not np.array_equal(picture.to_srgb(exposure=1), picture.to_srgb())


def test_memory_errors_are_memory_errors(ball):
    with pytest.raises(MemoryError, match="65535 x 65535"):
        boule.render(ball, size=(65535, 65535))


def test_saving_channels_leaves_the_calling_thread_free(ball, tmp_path):
    """It looks for Ctrl-C meanwhile. Where it copied them, it had a sixth of the work or more."""
    picture = boule.render(ball, size=(1000, 800), aov="depth,normal,position,id,albedo")
    mine, all_threads = time.thread_time(), time.process_time()
    picture.save(tmp_path / "a.exr")
    mine, all_threads = time.thread_time() - mine, time.process_time() - all_threads
    assert mine < all_threads / 10


def test_a_picture_that_cannot_be_written(ball, tmp_path):
    picture = boule.render(ball)
    with pytest.raises(boule.Error, match="No such file"):
        picture.save(tmp_path / "missing" / "a.png")
    with pytest.raises(boule.Error, match="unknown image extension"):
        picture.save(tmp_path / "a.tiff2")
    with pytest.raises(boule.Error) as caught:
        picture.save(tmp_path / "a.exr", compression="rar")
    assert caught.value.key == "compression"
    assert os.listdir(tmp_path) == []


def test_overlays_are_drawn_where_pictures_are_shown(tmp_path):
    file = tmp_path / "salt.xyz"
    file.write_text("2\nProperties=species:S:1:pos:R:3\nNa 0 0 0\nCl 2.8 0 0\n")
    options = {"size": (320, 240), "quick": True, "margin": 0.3}
    plain = boule.render(file, **options)
    drawn = boule.render(file, overlay=["legend", "scale"], **options)
    assert np.array_equal(np.asarray(plain), np.asarray(drawn))
    ys, xs = np.nonzero((plain.to_srgb() != drawn.to_srgb()).any(axis=2))
    assert len(xs) > 100 and xs.min() > 160
    for name in ("a.png", "a.pdf", "a.svg"):
        drawn.save(tmp_path / name)
    assert ">Na</text>" in (tmp_path / "a.svg").read_text()
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF-")
    drawn.save(tmp_path / "a.exr")
    with pytest.raises(boule.Error, match="did you mean 'legend'"):
        boule.render(file, overlay="lgend", **options)
    labelled = boule.render(file, labels="x > 0", label_text="species", **options)
    labelled.save(tmp_path / "b.svg")
    assert ">Cl</text>" in (tmp_path / "b.svg").read_text()
    scene = boule.load(file, quick=True, margin=0.3)
    scene.image.overlay = ["scale"]
    asked = boule.render(scene, size=(320, 240))
    scale = boule.render(scene, size=(320, 240), overlay="scale")
    assert np.array_equal(asked.to_srgb(), scale.to_srgb())
    none = boule.render(scene, size=(320, 240), overlay=[])
    assert np.array_equal(none.to_srgb(), plain.to_srgb())
