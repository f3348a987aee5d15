"""Scenes that are made in memory."""

from __future__ import annotations

from . import _camera, _core
from . import _checks as checks
from ._objects import (
    KINDS,
    Capsule,
    Clip,
    Distortion,
    Fit,
    ImageSettings,
    Instance,
    Particles,
    Plane,
    RenderSettings,
    Sphere,
    Table,
    error,
    path_of,
)


class _Many(checks.Strict):
    """What Spheres and Capsules have in common: arrays, and what may stand in place of colours."""

    def _read(self, make, *arrays, colors, color_space, scalar, map, range, color, material):
        if color is not None and not (colors is None and scalar is None):
            raise error("color", "cannot stand beside 'colors' or 'scalar'")
        self._data, self._range = make(*arrays, colors, color_space, scalar, map, range)
        self.color = color
        self.material = material

    @classmethod
    def _of(cls, data):
        """Those of a scene that was read."""
        self = cls.__new__(cls)
        self._data = data
        self._range = None
        self.color = self.material = None
        return self

    @staticmethod
    def _placed(views, name):
        """Points; a view unless they were rounded after an origin was subtracted."""
        if views["base"] == (0, 0, 0) or views[name].dtype == "float64":
            return views[name]
        return views[name] + views["base"]

    @property
    def range(self):
        """The numbers at the ends of map, [low, high], given or chosen; None without scalar."""
        return None if self._range is None else list(self._range)

    @property
    def color(self):
        """One colour for all, or None."""
        return self._color

    @color.setter
    def color(self, value):
        Sphere(color=value)  # checks it
        self._color = value

    @property
    def material(self):
        """A material, or the name of one in Scene.materials; None: the default of a scene."""
        return self._material

    @material.setter
    def material(self, value):
        Sphere(material=value)  # checks it
        self._material = value

    def __repr__(self):
        return f"<boule.{type(self).__name__}, {len(self)} of them>"

    def _table(self, names):
        table = {"file": self._data, "color": self.color}
        if self.material is not None:
            table["material"] = names("material", self.material)
        return table


class Spheres(_Many):
    """Many spheres in arrays, which are read once: you may change the arrays afterwards.

    centers: N x 3, float32 or float64. Those of float64 are kept as they are, 24 bytes each, and
        rounded once, after the origin of the scene is subtracted.
    radii: N, or one number for all, above 0.
    colors: N x 3, uint8 or floats from 0 to 1: codes of the sRGB curve (color_space="srgb") or
        linear values ("linear").
    scalar: N numbers, which map makes colours of: the name of a map, or colours "#rrggbb"; range
        has the numbers at its ends (the 1st and the 99th percentile).
    color: one colour for all, "#rrggbb" or three linear numbers from 0 to 1.
    material: a material, or the name of one in Scene.materials.

    Of these, color and material can be set afterwards. All are checked when they are set, but for
    the name of a material, which is looked up when the scene is rendered. No other attribute can be
    set.
    """

    def __init__(
        self, centers, radii, *, colors=None, color_space="srgb", scalar=None, map=None,
        range=None, color=None, material=None,
    ):  # fmt: skip
        self._read(
            _core.spheres, centers, radii, colors=colors, color_space=color_space, scalar=scalar, map=map,
            range=range, color=color, material=material,
        )  # fmt: skip

    def __len__(self):
        return len(self.radii)

    @property
    def centers(self):
        """N x 3, read-only; a view unless the scene that they were read with has an origin."""
        return self._placed(_core.sphere_views(self._data), "centers")

    @property
    def radii(self):
        """N, float32, a read-only view."""
        return _core.sphere_views(self._data)["radii"]

    @property
    def colors(self):
        """The colours that they have of their own: N x 3 of uint8, or None."""
        return _core.sphere_colors(self._data)


class Capsules(_Many):
    """Many capsules in arrays, which are read once: you may change the arrays afterwards. A capsule
    is all points within a radius of a segment.

    a, b: the ends of the segments, N x 3, float32 or float64, or one end, (3,), for all. If one of
        them is float64, both are kept as they are, 48 bytes a capsule, and rounded once, after the
        origin of the scene is subtracted.
    radius: N, or one number for all, above 0.
    colors, color_space, scalar, map, range, color, material: as those of Spheres.

    Of these, color and material can be set afterwards. All are checked when they are set, but for
    the name of a material, which is looked up when the scene is rendered. No other attribute can be
    set.
    """

    def __init__(
        self, a, b, radius, *, colors=None, color_space="srgb", scalar=None, map=None, range=None,
        color=None, material=None,
    ):  # fmt: skip
        self._read(
            _core.capsules, a, b, radius, colors=colors, color_space=color_space, scalar=scalar, map=map,
            range=range, color=color, material=material,
        )  # fmt: skip

    def __len__(self):
        return len(self.radius)

    @property
    def a(self):
        """N x 3, read-only; a view unless the scene that they were read with has an origin."""
        return self._placed(_core.capsule_views(self._data), "a")

    @property
    def b(self):
        """N x 3, as a."""
        return self._placed(_core.capsule_views(self._data), "b")

    @property
    def radius(self):
        """N, float32, a read-only view."""
        return _core.capsule_views(self._data)["radius"]

    @property
    def colors(self):
        """The colours that they have of their own: N x 3 of uint8, or None."""
        return _core.capsule_colors(self._data)


class _Objects(checks.Strict):
    """What a scene and a group have in common: lists of objects and instances."""

    def add_spheres(
        self, centers, radii, *, colors=None, color_space="srgb", scalar=None, map=None,
        range=None, color=None, material=None,
    ):  # fmt: skip
        """Adds spheres in arrays: see Spheres, which it returns."""
        spheres = Spheres(
            centers, radii, colors=colors, color_space=color_space, scalar=scalar, map=map,
            range=range, color=color, material=material,
        )  # fmt: skip
        self.spheres.append(spheres)
        return spheres

    def add_sphere(self, **keys):
        """Adds one sphere: see Sphere, which it returns."""
        self.spheres.append(Sphere(**keys))
        return self.spheres[-1]

    def add_particles(self, file, **keys):
        """Adds the particles of a file: see Particles, which it returns."""
        self.spheres.append(Particles(file=file, **keys))
        return self.spheres[-1]

    def add_plane(self, **keys):
        """Adds a plane: see Plane, which it returns."""
        self.planes.append(Plane(**keys))
        return self.planes[-1]

    def add_capsules(
        self, a, b, radius, *, colors=None, color_space="srgb", scalar=None, map=None, range=None,
        color=None, material=None,
    ):  # fmt: skip
        """Adds capsules in arrays: see Capsules, which it returns."""
        capsules = Capsules(
            a, b, radius, colors=colors, color_space=color_space, scalar=scalar, map=map,
            range=range, color=color, material=material,
        )  # fmt: skip
        self.capsules.append(capsules)
        return capsules

    def add_capsule(self, **keys):
        """Adds one capsule: see Capsule, which it returns."""
        self.capsules.append(Capsule(**keys))
        return self.capsules[-1]

    def add_instance(self, group, **keys):
        """Adds an instance of a group, which is a Group or the name of one."""
        self.instances.append(Instance(group=group, **keys))
        return self.instances[-1]

    def _object_tables(self, names):
        """The lists of objects as scene files have them."""
        kinds = {Sphere: "sphere", Spheres: "spheres", Particles: "particles"}
        order = []  # in one order, as ids count them: see TreeBuilder
        for one in _spheres("spheres", self.spheres):
            kind = next(name for cls, name in kinds.items() if isinstance(one, cls))
            order.append((kind, one._table(names)))
        for one in _capsules("capsules", self.capsules):
            kind = "capsule" if isinstance(one, Capsule) else "capsules"
            order.append((kind, one._table(names)))
        tables = {None: order}
        tables["plane"] = [one._table(names) for one in _planes("planes", self.planes)]
        tables["instance"] = [one._table(names) for one in _instances("instances", self.instances)]
        return tables


_spheres = checks.list_of("spheres", "spheres", checks.is_instance(Sphere, Spheres, Particles))
_planes = checks.list_of("plane", "a Plane", checks.is_instance(Plane))
_capsules = checks.list_of("capsules", "capsules", checks.is_instance(Capsule, Capsules))
_instances = checks.list_of("instance", "an Instance", checks.is_instance(Instance))
_lights = checks.list_of("light", "a light", checks.is_kind("light"))
_clips = checks.list_of("clip", "a Clip", checks.is_instance(Clip))
_notes = checks.list_of("notes", "text", checks.is_instance(str))
_warnings = checks.list_of("warnings", "text", checks.is_instance(str))
_materials = checks.dictionary_of("material", "a material", checks.is_kind("material"))


class Group(_Objects):
    """Objects with coordinates of their own, which instances show. name is for a group that is not
    in Scene.groups; you may leave it empty.

    Attributes are checked when they are set, and no others can be set."""

    _checks = {
        "name": checks.text_or_none, "spheres": _spheres, "planes": _planes,
        "capsules": _capsules, "instances": _instances,
    }  # fmt: skip

    def __init__(self, name=""):
        self.name = name
        self.spheres = []
        self.planes = []
        self.capsules = []
        self.instances = []

    def __repr__(self):
        return f"<boule.Group {self.name!r}>"


_groups = checks.dictionary_of("group", "a Group", checks.is_instance(Group))


class _Names:
    """Gives the materials and groups of a scene their names. Those that objects have without being
    in Scene.materials or Scene.groups are added to what is rendered, not to the scene."""

    def __init__(self, scene):
        self.materials = dict(_materials("materials", scene.materials))
        self.groups = dict(_groups("groups", scene.groups))

    def __call__(self, kind, value):
        known = self.materials if kind == "material" else self.groups
        if isinstance(value, str):
            return value
        for name, one in known.items():
            if one is value:
                return name
        is_right = (
            isinstance(value, Group) if kind == "group" else checks.is_kind("material")(value)
        )
        if not is_right:
            raise error(kind, f"expected a {kind} or its name, got {type(value).__name__}")
        name = type(value).__name__.lower()
        if kind == "group" and value.name not in ("", None):
            name = value.name
        number = 1
        free = name
        while free in known:
            number += 1
            free = f"{name} {number}"
        known[free] = value
        return free


class Scene(_Objects):
    """A scene, as values: the tables and keys of scene files, with the same names and defaults.

    image, render: ImageSettings and RenderSettings.
    camera: Pinhole, Orthographic, Fisheye, ThinLens, Lens; Fit or None: fitted to the spheres and
        capsules.
    background: ConstantBackground, GradientBackground or EnvironmentBackground.
    ambient: light on every surface from everywhere (method "whitted").
    backdrop: the colour that the camera sees behind all objects, not the background; or None.
    materials: a dictionary of materials by name.
    lights: a list of PointLight, DirectionalLight, SphereLight.
    clips: a list of Clip: planes that cut spheres and capsules in pictures, not for a Tracer.
    spheres: a list of Sphere, Spheres and Particles; ids count them in this order.
    planes, instances: lists of Plane and Instance.
    capsules: a list of Capsule and Capsules; their ids follow those of the planes.
    groups: a dictionary of Group by name.
    origin: a point that is subtracted from all points before they are rounded, or "auto".
    notes, warnings: messages from reading the scene. legend: an SVG that explains its colours.

    Attributes are checked when they are set, and no others can be set. What is in their lists and
    dictionaries is checked again when the scene is rendered or traced.
    """

    _checks = {
        "image": checks.one("image"), "render": checks.one("render"), "camera": checks.camera,
        "background": checks.one("background"), "ambient": checks.color, "backdrop": checks.color,
        "materials": _materials, "lights": _lights, "clips": _clips, "spheres": _spheres,
        "planes": _planes, "capsules": _capsules, "groups": _groups, "instances": _instances,
        "origin": checks.origin, "notes": _notes, "warnings": _warnings, "legend": checks.text,
    }  # fmt: skip

    def __init__(
        self, *, image=None, render=None, camera=None, background=None, ambient=(0.0, 0.0, 0.0),
        backdrop=None, materials=None, lights=None, spheres=None, planes=None, groups=None,
        instances=None, capsules=None, clips=None, origin="auto",
    ):  # fmt: skip
        self.image = ImageSettings() if image is None else image
        self.render = RenderSettings() if render is None else render
        self.camera = camera
        self.background = KINDS["ConstantBackground"]() if background is None else background
        self.ambient = ambient
        self.backdrop = backdrop
        self.materials = {} if materials is None else dict(_materials("materials", materials))
        self.lights = [] if lights is None else list(_lights("lights", lights))
        self.clips = [] if clips is None else list(_clips("clips", clips))
        self.spheres = [] if spheres is None else list(_spheres("spheres", spheres))
        self.planes = [] if planes is None else list(_planes("planes", planes))
        self.capsules = [] if capsules is None else list(_capsules("capsules", capsules))
        self.groups = {} if groups is None else dict(_groups("groups", groups))
        self.instances = [] if instances is None else list(_instances("instances", instances))
        self.origin = origin
        self.notes = []
        self.warnings = []
        self.legend = ""

    def __repr__(self):
        return (
            f"<boule.Scene: {len(self.spheres)} entries of spheres, {len(self.planes)} planes, "
            f"{len(self.lights)} lights>"
        )

    def add_clip(self, **keys):
        """Adds a clip plane: see Clip, which it returns."""
        self.clips.append(Clip(**keys))
        return self.clips[-1]

    def add_group(self, name):
        """Adds a group without objects, and returns it."""
        if name in self.groups:
            raise error("group", f"there is a group {name!r} already")
        self.groups[name] = Group(name)
        return self.groups[name]

    def rays(
        self, size=None, spp=1, sample=0, *, filter=None, seed=None, crop=None, frame=None
    ):
        """The camera's rays, as render() traces them for one sample of each pixel, to the bit.

        size: (width, height) in pixels; None: that of image. spp: samples per pixel; sample: which
        of them, 0 to spp - 1. A single sample goes through the pixel's centre and that of the lens.
        filter, seed, crop: those of render(); with a crop, rays are of its pixels only. frame: that
        of a camera that moves.

        Returns Rays, H x W x 3 each, with row 0 on top. Where the scene has an origin, it is added.
        """
        options = {
            "size": size, "spp": spp, "sample": sample, "filter": filter, "seed": seed,
            "crop": crop,
        }  # fmt: skip
        return _camera.rays_of(self._tree(), frame, options)

    def fitted_camera(self, size=None):
        """The camera that is fitted to the spheres and capsules, as numbers: a Pinhole or an
        Orthographic. As Scene.camera it gives the same picture of this size.

        size: (width, height) in pixels; None: that of image. If Scene.camera is a Fit, its keys
        hold, otherwise those of Fit().
        """
        tree = self._tree()
        tree.pop("camera", None)
        return _camera.fitted_camera(tree, self.camera, size)

    def save(self, path):
        """Writes the scene to a packed file, .boule, of which the program and render() make the same
        pictures, bit for bit. It appears when it is complete.

        Raises Error if it cannot be written, MemoryError if there is too little memory.
        """
        _core.pack(self._tree(), path_of(path, "path"))

    def _tree(self):
        """The scene as its file would have it."""
        names = _Names(self)
        tree = {"schema": 1, "origin": self.origin}
        tree["image"] = self.image._table(None)
        tree["render"] = self.render._table(None)
        if self.camera is not None:
            tree["camera"] = self.camera._table(None)
        background = dict(self.background._table(None))
        background["ambient"] = self.ambient
        background["backdrop"] = self.backdrop
        tree["background"] = background
        tree["light"] = [light._table(None) for light in _lights("lights", self.lights)]
        tree["clip"] = [clip._table(None) for clip in _clips("clips", self.clips)]
        objects = self._object_tables(names)
        groups = {}
        done = 0
        while done < len(names.groups):  # instances in groups may bring groups along
            name = list(names.groups)[done]
            groups[name] = names.groups[name]._object_tables(names)
            done += 1
        tree["material"] = {
            name: material._table(None)
            for name, material in names.materials.items()
        }
        tree["group"] = {name: _in_order(tables) for name, tables in groups.items()}
        tree.update(_in_order(objects))
        return tree


def _in_order(tables):
    """Objects with their places: see _core.read."""
    return {None: tables[None], **{key: rows for key, rows in tables.items() if key and rows}}
