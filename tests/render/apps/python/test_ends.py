"""Processes that end, and Ctrl-C, while threads are inside calls of the package."""

import signal
import subprocess
import sys
import time

import pytest

SETUP = """
import asyncio, atexit, os, signal, sys, threading, time, warnings
from concurrent.futures import ThreadPoolExecutor
import numpy as np
import boule

centers = np.random.default_rng(0).uniform(-5, 5, (5000, 3))
endless = boule.Scene(background=boule.GradientBackground())
endless.add_spheres(centers, 0.2)
endless.image.size = (800, 600)
endless.image.spp = 100_000
endless.render.method = "path"
begun = threading.Barrier(3, timeout=60)  # the threads of two calls, and the main one

def begin():
    if not hasattr(mine, "begun"):
        mine.begun = True
        begun.wait()

mine = threading.local()
"""

DAEMONS = """
def again(call):
    begin()
    while True:
        call()

rays = np.random.default_rng(1).normal(size=(1000, 3))
many = np.tile(rays, (2000, 1))
tracer = boule.Tracer(centers, 0.2)
calls = {
    "render": lambda: boule.render(endless),
    "partial": lambda: boule.render(endless, partial=True),
    "small": lambda: boule.render(endless, size=(8, 8), spp=1),
    "tick": lambda: boule.render(endless, progress=lambda share: time.sleep(0.01)),
    "long tick": lambda: boule.render(endless, progress=lambda share: time.sleep(100)),
    "few rays": lambda: tracer.closest((0, 0, 0), rays),
    "many rays": lambda: tracer.closest((0, 0, 0), many),
    "lists": lambda: boule.Tracer([[0, 0, 0]] * 1000, 1),
}
for _ in range(2):
    threading.Thread(target=again, args=(calls[KIND],), daemon=True).start()
begun.wait()
time.sleep(DELAY)
"""


def start(*parts):
    """A process of its own that runs these parts of a program."""
    return subprocess.Popen(
        [sys.executable, "-c", "".join((SETUP, *parts))],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def run(*parts):
    process = start(*parts)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


@pytest.mark.parametrize(
    "kind",
    ["render", "partial", "small", "tick", "long tick", "few rays", "many rays", "lists"],
)
def test_a_process_may_end_inside_calls(kind):
    for delay in (0, 0.01, 0.05, 0.2):
        assert run(f"KIND, DELAY = {kind!r}, {delay}", DAEMONS) == (0, "", "")


def test_exit_status_survives_a_running_call():
    assert run("KIND, DELAY = 'render', 0.1", DAEMONS, "print('out'); sys.exit(7)") == (7, "out\n", "")


def test_abandoned_calls_let_the_process_end():
    """A tree takes minutes here, and cannot be stopped; signals leave it."""
    code = """
centers = np.random.default_rng(0).uniform(-5, 5, (8_000_000, 3)).astype(np.float32)
threading.Timer(1, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    boule.Tracer(centers, 0.01)
except KeyboardInterrupt:
    print("interrupted")
sys.exit(3)
"""
    assert run(code) == (3, "interrupted\n", "")


def test_main_thread_may_call_at_exit():
    """Hooks that were there before the package's run after it."""
    code = """
def last():
    print(boule.render(endless, size=(4, 4), spp=1).finished)
    thread = threading.Thread(target=lambda: print(boule.render(endless, size=(4, 4), spp=1)))
    thread.start()
    thread.join()
    print("over")
"""
    first = "import atexit\natexit.register(lambda: last())\n"
    process = subprocess.run(
        [sys.executable, "-c", first + SETUP + code], capture_output=True, text=True, timeout=120
    )
    assert (process.returncode, process.stdout, process.stderr) == (0, "True\nover\n", "")


POOL = """
def call(number):
    begin()
    try:
        boule.render(endless)
    except boule.Interrupted as interrupted:
        print(interrupted.picture is None or not interrupted.picture.finished, flush=True)
        raise
"""

WAYS = {
    "submit": """
with ThreadPoolExecutor(2) as pool:
    futures = [pool.submit(call, number) for number in range(6)]
    begun.wait()
    print("begun", flush=True)
    for future in futures:
        future.result()
""",
    "map": """
with ThreadPoolExecutor(2) as pool:
    results = pool.map(call, range(6))
    begun.wait()
    print("begun", flush=True)
    list(results)
""",
    "no with": """
pool = ThreadPoolExecutor(2)
futures = [pool.submit(call, number) for number in range(4)]
begun.wait()
print("begun", flush=True)
futures[0].result()
""",
    # Not by join(): interrupted, it takes a thread for one that has ended.
    "threads": """
over = threading.Semaphore(0)
def quiet(number):
    try:
        call(number)
    except KeyboardInterrupt:
        over.release()
for k in range(2):
    threading.Thread(target=quiet, args=(k,)).start()
begun.wait()
print("begun", flush=True)
try:
    over.acquire()
finally:
    over.acquire()
    over.acquire()
""",
    "asyncio": """
async def main():
    calls = [asyncio.to_thread(call, k) for k in range(2)]
    waiting = asyncio.gather(*calls)
    await asyncio.to_thread(begun.wait)
    print("begun", flush=True)
    await waiting
asyncio.run(main())
""",
}


@pytest.mark.parametrize("way", WAYS)
def test_interrupt_ends_calls_of_other_threads(way):
    process = start(POOL, WAYS[way])
    assert process.stdout.readline() == "begun\n"
    time.sleep(0.3)
    began = time.monotonic()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert time.monotonic() - began < 30  # the renders take hours
    assert "KeyboardInterrupt" in err and process.returncode in (1, -signal.SIGINT)
    assert out.count("True") >= 2 and "False" not in out


def test_interrupted_partial_render_returns_its_picture():
    code = """
def call():
    picture = boule.render(endless, partial=True)
    print(picture.finished, picture.share > 0, flush=True)
    done.set()
done = threading.Event()
threading.Thread(target=call).start()
time.sleep(1)
try:
    print("begun", flush=True)  # here: the signal may come at once
    done.wait()
except KeyboardInterrupt:
    done.wait()
"""
    process = start(code)
    assert process.stdout.readline() == "begun\n"
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=120) == ("False True\n", "")
    assert process.returncode == 0


def test_a_handler_of_ones_own_decides():
    """A SIGINT that raises nothing ends no call; and handlers are as they were afterwards."""
    code = """
got = []
signal.signal(signal.SIGINT, lambda number, frame: got.append(number))
def call():
    print(boule.render(endless, size=(200, 150), time_limit=1, partial=True).share < 1, flush=True)
thread = threading.Thread(target=call)
thread.start()
time.sleep(0.2)
os.kill(os.getpid(), signal.SIGINT)
os.kill(os.getpid(), signal.SIGINT)
thread.join()
assert len(got) in (1, 2)  # those that come at once are one
os.kill(os.getpid(), signal.SIGINT)
assert len(got) in (2, 3)
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(10)
except KeyboardInterrupt:
    print("raised")
print(boule.render(endless, size=(4, 4), spp=1).finished)
thread = threading.Thread(target=lambda: print(boule.render(endless, size=(4, 4), spp=1).finished))
thread.start()
thread.join()
"""
    assert run(code) == (0, "True\nraised\nTrue\nTrue\n", "")


def test_process_forked_in_a_call_ends():
    """It has none of the threads that its parent has."""
    code = """
threading.Thread(target=lambda: boule.render(endless, time_limit=3, partial=True)).start()
time.sleep(0.3)
warnings.simplefilter("ignore")  # from 3.12 on Python warns of forks beside threads
child = os.fork()
if child == 0:
    begin = time.monotonic()
    atexit.register(print, "child", boule.render(endless, size=(4, 4), spp=1).finished)
    sys.exit(0)
assert os.waitpid(child, 0)[1] == 0
"""
    assert run(code) == (0, "child True\n", "")


@pytest.mark.parametrize("call", ["to_srgb()", "alpha", "channels"])
def test_threads_make_first_arrays_together(call):
    """numpy is loaded by whichever is first."""
    code = f"""
import threading, boule
scene = boule.Scene()
scene.add_sphere()
picture = boule.render(scene, size=(40, 30), aov="depth", background="transparent")
begin = threading.Barrier(4)
def call():
    begin.wait()
    picture.{call}
threads = [threading.Thread(target=call) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
"""
    for _ in range(5):
        subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
