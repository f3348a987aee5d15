"""Calls the package at random: fuzz.py CALLS [SEED]. Nothing may end the interpreter.

A call either works or raises one of the exceptions that the package promises. Arrays have random
types, shapes, strides and values, sizes 0 and huge among them; huge ones are views of little memory.
"""

import collections
import copy
import faulthandler
import pickle
import random
import resource
import sys
import tempfile
import threading

try:
    import numpy as np
except ImportError:
    print("skipped: there is no numpy")
    sys.exit(77)

import boule

faulthandler.enable()
# What takes too much memory shall fail, not the machine.
resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

PROMISED = (boule.Error, MemoryError, TypeError, AttributeError)
DTYPES = ["f4", "f8", "f2", "i1", "i4", "i8", "u1", "u8", ">f4", ">f8", "c8", "?", "O", "U3", "M8[s]",
          "f4,f4", "g"]  # fmt: skip
ODD = [0.0, -0.0, 1.0, -1.0, 1e-45, 1e38, -1e300, np.inf, -np.inf, np.nan, 1e6, 2.0**24 + 1]


class Caller:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.numpy = np.random.default_rng(seed)
        self.tracers = [boule.Tracer(self.numpy.uniform(-3, 3, (300, 3)), 0.3)]
        self.pictures = [boule.render(self.small_scene(), size=(8, 6))]
        self.folder = tempfile.TemporaryDirectory()
        self.ended = collections.Counter()

    def one_of(self, *choices):
        return self.random.choice(choices)

    def numbers(self, shape):
        values = self.numpy.normal(0, self.one_of(0.1, 1, 10, 1e6), shape)
        if self.random.random() < 0.3 and values.size:
            flat = values.reshape(-1)
            for _ in range(self.random.randint(1, 4)):
                flat[self.random.randrange(flat.size)] = self.random.choice(ODD)
        return values

    def array(self, *shape):
        """An array of about this shape: of another type, layout or shape now and then."""
        if self.random.random() < 0.15:
            shape = tuple(self.random.choice([0, 1, 2, 3, 4, 7]) for _ in range(self.random.randint(0, 4)))
        values = self.numbers(shape)
        chance = self.random.random()
        if chance < 0.3:
            with np.errstate(all="ignore"):
                try:
                    values = values.astype(self.random.choice(DTYPES))
                except (TypeError, ValueError):
                    pass
        elif chance < 0.4:
            values = np.asfortranarray(values)
        elif chance < 0.5 and values.ndim:
            values = np.repeat(values, 3, axis=0)[:: self.one_of(3, -3)]
        elif chance < 0.55 and values.ndim:
            values = values[..., ::-1]
        elif chance < 0.58:
            values = values.tolist()
        elif chance < 0.62:
            values = self.huge(*shape[1:])
        elif chance < 0.65:
            values = self.value()
        return values

    def huge(self, *inner):
        """More rows than any memory holds, all of them one row."""
        one = np.zeros(inner, self.one_of("f4", "f8", "u1"))
        rows = self.one_of(2**31, 2**40, 2**33 + 1)
        return np.lib.stride_tricks.as_strided(one, (rows, *inner), (0, *one.strides))

    def value(self):
        return self.random.choice([
            None, True, 0, -1, 3, 10**30, 0.5, float("nan"), "", "x", "#ff0000", "\ud800", b"y", [],
            [1, 2, 3], (1, "a"), {}, {"a": 1}, {1: 2}, object(), np.float32(2), np.zeros(3),
            range(4), lambda: 0, boule.Matte, boule.Plastic(), self.pictures[-1], [[[]]],
        ])  # fmt: skip

    def small_scene(self):
        scene = boule.Scene()
        scene.add_spheres(self.numpy.uniform(-2, 2, (20, 3)), 0.5)
        return scene

    def keys(self, names, most=3):
        return {self.random.choice(names): self.value()
                for _ in range(self.random.randint(0, most))}  # fmt: skip

    # The calls.

    def make_tracer(self):
        count = self.one_of(0, 1, 5, 100)
        made = boule.Tracer(self.array(count, 3), self.array(count), **self.keys(
            ["origin", "solver", "threads", "isa"], 1))  # fmt: skip
        self.tracers = self.tracers[-4:] + [made]

    def closest(self):
        count = self.one_of(0, 1, 7, 1000)
        hits = self.random.choice(self.tracers).closest(
            self.array(count, 3), self.array(count, 3), *self.one_of((), (self.array(count),),
                                                                      (0, self.array(count)))
        )  # fmt: skip
        assert hits.t.shape == hits.id.shape == hits.normal.shape[:-1]

    def any(self):
        count = self.one_of(0, 1, 7, 1000)
        self.random.choice(self.tracers).any(self.array(count, 3), self.array(count, 3))

    def crossings(self):
        count = self.one_of(0, 1, 7, 300)
        tracer = self.random.choice(self.tracers)
        call = self.one_of(tracer.all_hits, tracer.count, tracer.chord, tracer.closest, tracer.any)
        keys = {"source": self.one_of(-1, 0, 5, self.array(count)), "inside": self.one_of(0, True, self.array(count)),
                "tmin": self.array(count), "limit": self.one_of(0, 3, None, self.value()),
                "per_sphere": self.one_of(True, self.value()), "out": self.one_of(None, self.value())}  # fmt: skip
        given = self.random.sample(sorted(keys), self.random.randint(0, 3))
        call(self.array(count, 3), self.array(count, 3), **{key: keys[key] for key in given})

    def points(self):
        count = self.one_of(0, 1, 7, 300)
        tracer = self.random.choice(self.tracers)
        calls = {
            tracer.nearest: {"k": self.one_of(1, 3, self.value()), "limit": self.value()},
            tracer.inside: {"first": self.one_of(True, self.value())},
            tracer.within: {"radius": self.one_of(0.5, self.array(count), self.value())},
        }
        call = self.random.choice([*calls, tracer.pairs])
        if call == tracer.pairs:
            call(self.one_of(0, -0.1, self.value()))
        else:
            call(self.array(count, 3), **calls[call])

    def make_object(self):
        name = self.random.choice([name for name in boule.__all__ if name[0].isupper()])
        cls = getattr(boule, name)
        if not hasattr(cls, "_defaults"):
            return
        made = cls(**self.keys(list(cls._defaults) + ["x"]))
        setattr(made, self.random.choice([*cls._defaults, "y"]), self.value())
        repr(made), [getattr(made, key) for key in cls._defaults]

    def make_spheres(self):
        count = self.one_of(0, 1, 20)
        keys = {"colors": self.array(count, 3), "scalar": self.array(count),
                "map": self.one_of("viridis", ["#000000"], self.value()),
                "range": self.array(2)}  # fmt: skip
        chosen = self.random.sample(sorted(keys), self.random.randint(0, 2))
        spheres = boule.Spheres(self.array(count, 3), self.array(count),
                                **{name: keys[name] for name in chosen})  # fmt: skip
        assert len(spheres.centers) == len(spheres.radii) == len(spheres)
        spheres.colors

    def spoil_scene(self):
        scene = self.small_scene()
        names = ["image", "render", "camera", "background", "ambient", "backdrop", "origin", "lights",
                 "spheres", "planes", "capsules", "materials", "groups", "instances"]  # fmt: skip
        name = self.random.choice(names)
        setattr(scene, name, self.one_of(self.value(), [self.value()], {"a": self.value()}))
        boule.render(scene, size=(4, 3))

    def render(self):
        names = ["size", "spp", "filter", "background", "outline", "seed", "crop", "aov", "method",
                 "max_depth", "time_limit", "partial", "order", "tile", "solver", "threads", "isa",
                 "frame", "look", "color", "view", "radius"]  # fmt: skip
        keys = {"size": (8, 6), "threads": 1, **self.keys(names)}
        if isinstance(keys.get("spp"), int) and keys["spp"] > 10:
            keys["spp"] = 2
        if keys.get("size") is None:
            keys["size"] = (8, 6)
        source = self.small_scene() if self.random.random() < 0.8 else self.value()
        self.pictures = self.pictures[-4:] + [boule.render(source, **keys)]

    def use_picture(self):
        picture = self.random.choice(self.pictures)
        np.asarray(picture), picture.alpha, picture.channels, picture.aovs, picture.stats
        picture.to_srgb(exposure=self.one_of(0.0, 1, self.value()))
        if self.random.random() < 0.2:
            name = self.one_of("a.png", "a.exr", "a.jpg", "no/a.png", "a", "\0.png")
            picture.save(f"{self.folder.name}/{name}", **self.keys(["exposure", "compression"], 1))

    def make_pixels(self):
        made = self.one_of(
            lambda: boule.EnvironmentBackground(pixels=self.array(4, 8, 3)),
            lambda: boule.Distortion(st=self.array(4, 8, 2)),
            lambda: boule.Lens(eye=(0, 0, 1), look_at=(0, 0, 0), surfaces=self.array(4, 4)),
        )()
        name = made._array
        setattr(made, name, self.array(*getattr(made, name).shape))

    def make_particles(self):
        count = self.one_of(0, 1, 30)
        scene = boule.from_particles(
            self.array(count, 3),
            species=self.one_of(None, ["C"] * count, self.array(count), [self.value()] * count,
                                [b"C", "O", 6] * (count // 3)),
            columns=self.one_of({}, {"q": self.array(count)}, {"t": ["a"] * count},
                                {"t": ["a", self.value()] * (count // 2)}, self.value()),
            angstrom=self.one_of(1, 10, 1e-40, self.value()),
            cell=self.one_of(None, self.array(3, 3)), periodic=self.one_of((), [True] * 3),
            **self.keys(["look", "color", "radius", "scale", "select", "view", "map", "range"], 2),
        )  # fmt: skip
        boule.render(scene, size=(4, 3), spp=1, method="whitted")

    def read(self):
        path = f"{self.folder.name}/" + self.one_of("a.toml", "a.nff", "a.npy", "a.xyz", "a.pdb", "b")
        with open(path, "wb") as file:
            file.write(self.random.randbytes(self.one_of(0, 3, 100)))
        self.one_of(boule.load, boule.frames)(path, **self.keys(["frame", "color", "water"], 1))

    def move(self):
        tracer = self.random.choice(self.tracers)
        count = self.one_of(0, 1, 5, 100, 300)
        tracer.update(self.array(count, 3), *self.one_of((), (self.array(count),), (0.5,)))

    def copy(self):
        one = self.random.choice([*self.tracers, *self.pictures, self.small_scene(), self.value()])
        copied = self.one_of(copy.deepcopy, lambda it: pickle.loads(pickle.dumps(it)))(one)
        if type(one) in (boule.Tracer, boule.Picture):
            assert type(copied) is type(one)

    def camera(self):
        scene = self.small_scene()
        keys = {"size": (8, 6), **self.keys(["size", "spp", "sample", "filter", "seed", "crop", "frame"])}
        rays = scene.rays(**keys)
        assert rays.origin.shape == rays.direction.shape
        scene.camera = scene.fitted_camera(keys["size"])

    def series(self):
        frames = [
            {"positions": self.array(4, 3), "columns": self.one_of({}, {"q": self.array(4)})}
            for _ in range(self.random.randint(0, 3))
        ]
        frames = self.one_of(frames, frames, [*frames, self.value()], self.value())
        list(boule.series(frames, **self.keys(["look", "color", "radius", "select", "floor"], 1)))

    CALLS = (
        (closest, 20), (any, 10), (crossings, 20), (points, 15), (make_tracer, 12), (make_object, 20), (make_spheres, 10),
        (render, 6), (use_picture, 4), (make_pixels, 4), (spoil_scene, 3), (make_particles, 4),
        (read, 3), (move, 10), (copy, 8), (camera, 6), (series, 6),
    )  # fmt: skip

    def call(self):
        names, weights = zip(*self.CALLS)
        (chosen,) = self.random.choices(names, weights)
        try:
            with np.errstate(all="ignore"):
                chosen(self)
            self.ended["done"] += 1
        except PROMISED as error:
            self.ended[type(error).__name__] += 1


def main():
    calls, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    # Two threads: any thread may call.
    callers = [Caller(seed), Caller(seed + 1)]
    failures = []

    def work(caller):
        try:
            for _ in range(calls // len(callers)):
                caller.call()
        except BaseException as error:
            failures.append(error)
            raise

    threads = [threading.Thread(target=work, args=(caller,)) for caller in callers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for caller in callers:
        print(dict(caller.ended))
        caller.folder.cleanup()
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
