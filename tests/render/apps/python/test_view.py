"""The page of `boule view` in notebooks, and scenes that are saved."""

import os
import subprocess
import sys
import urllib.request

import numpy as np
import pytest

import boule
from boule import _viewing


def scene():
    made = boule.Scene()
    made.add_spheres([[0, 0, 0], [3, 0, 0]], [1, 0.5], color="#c03020")
    made.add_capsule(a=(0, 0, 0), b=(3, 0, 0), radius=0.2)
    made.add_plane(point=(0, -1, 0))
    made.add_group("pair").add_sphere(center=(0, 3, 0))
    made.add_instance("pair")
    made.lights.append(boule.DirectionalLight(direction=(-1, -2, -1)))
    return made


def test_saved_scene_renders_alike(tmp_path):
    path = tmp_path / "scene.boule"
    scene().save(path)
    of_file = boule.render(path, size=(64, 48), spp=2)
    assert np.array_equal(of_file, boule.render(scene(), size=(64, 48), spp=2))
    assert sorted(os.listdir(tmp_path)) == ["scene.boule"]


def test_saving_refuses_what_it_cannot(tmp_path):
    with pytest.raises(boule.Error, match="ends with .boule"):
        scene().save(tmp_path / "scene.toml")
    with pytest.raises(boule.Error, match="nowhere"):
        scene().save(tmp_path / "nowhere" / "scene.boule")


def headers_of(url):
    with urllib.request.urlopen(url) as answer:
        return answer.headers["Content-Security-Policy"], answer.read()


def test_page_shows_in_a_frame():
    with boule.view(scene(), size=(64, 48), spp=2, height=300) as view:
        policy, page = headers_of(view.url)
        assert "default-src 'self'" in policy and "frame-ancestors" not in policy
        assert b"<html" in page
        shown = view._repr_html_()
        assert view.url in shown and 'height="300"' in shown and shown.startswith("<iframe ")
    assert "closed" in repr(view) and "iframe" not in view._repr_html_()
    with pytest.raises(OSError):
        urllib.request.urlopen(view.url)


def test_other_pages_may_not_frame(tmp_path):
    path = tmp_path / "scene.boule"
    scene().save(path)
    command = [_viewing._program(), "view", str(path), "--idle", "20s"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        policy, _ = headers_of(process.stdout.readline().strip())
        process.terminate()
    assert "frame-ancestors 'none'" in policy


def test_nothing_is_left(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    program = (
        "import boule; s = boule.Scene(); s.add_sphere(); view = boule.view(s)\n"
        "print(view._end.peek()[2][0].pid)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert os.listdir(tmp_path) == []
    assert not os.path.exists(f"/proc/{int(run.stdout)}")


def test_looks_reach_the_program(tmp_path):
    path = tmp_path / "-two.xyz"
    path.write_text("2\n\nNa 0 0 0\nCl 2.8 0 0\n")
    with boule.view(path, radii={"Na": 1.0}, look="plain", view=(0, 0, 1), floor=True) as view:
        assert str(path) in repr(view)
    with pytest.raises(boule.Error, match="--look"):
        boule.view(path, look="grand")
    with pytest.raises(boule.Error, match="none.xyz"):
        boule.view(tmp_path / "none.xyz")
    with pytest.raises(boule.Error, match="is of files"):
        boule.view(scene(), radius="vdw")
    with pytest.raises(boule.Error, match="height"):
        boule.view(scene(), height=0)


def test_missing_program_is_named(monkeypatch):
    monkeypatch.setattr(_viewing, "__file__", "/nowhere/boule/_viewing.py")
    monkeypatch.setattr(_viewing.shutil, "which", lambda name: None)
    with pytest.raises(boule.Error, match="program boule is not installed"):
        boule.view(scene())
