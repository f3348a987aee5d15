from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple, Protocol, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Color = Union[str, Sequence[float], NDArray[Any]]
_Vector = Union[Sequence[float], NDArray[Any]]
_Path = Union[str, os.PathLike[str]]

class _Ase(Protocol):
    def get_positions(self) -> Any: ...

class _MDAnalysis(Protocol):
    @property
    def atoms(self) -> Any: ...

class _Pymatgen(Protocol):
    @property
    def cart_coords(self) -> Any: ...

_Atoms = Union[_Ase, _MDAnalysis, _Pymatgen]
_FovAxis = Literal["x", "y", "max"]
_Key = Mapping[str, Any]
_Method = Literal["whitted", "path"]
_Filter = Literal["box", "tent"]
_Solver = Literal["fast", "robust", "reference"]
_Frame = Literal["scene", "camera"]
_Order = Literal["rows", "tiles", "progressive", "frameless"]
_OverlayPart = Literal["legend", "scale", "axes", "time"]
_Polygons = Literal["plane", "skip", "error"]
_Look = Literal["paper", "plain", "dark"]
_Style = Literal["space-filling", "balls-and-sticks", "sticks"]

def isa() -> str: ...

class Error(ValueError):
    file: str | None
    line: int | None
    column: int | None
    key: str | None

class Interrupted(KeyboardInterrupt):
    picture: Picture | None
    def __init__(self, picture: Picture | None = ...) -> None: ...

class _Keys:
    """Has its attributes as keywords, and all may be left out: see expand_stubs.py."""

class Matte(_Keys):
    color: _Color

class Plastic(_Keys):
    color: _Color
    specular: float
    shininess: float
    reflect: float

class Metal(_Keys):
    color: _Color

class Glass(_Keys):
    color: _Color
    ior: float

class Emissive(_Keys):
    radiance: _Color

class Phong(_Keys):
    color: _Color
    ka: float
    kd: float
    ks: float
    shininess: float
    transmission: float
    ior: float

class Ghost(_Keys):
    color: _Color
    opacity: float

class Pinhole(_Keys):
    eye: _Vector | None
    look_at: _Vector | None
    up: _Vector
    fov: float
    fov_axis: _FovAxis
    distortion: Distortion | None
    key: Sequence[_Key] | None

class Orthographic(_Keys):
    eye: _Vector | None
    look_at: _Vector | None
    up: _Vector
    height: float
    distortion: Distortion | None
    key: Sequence[_Key] | None

class Fisheye(_Keys):
    eye: _Vector | None
    look_at: _Vector | None
    up: _Vector
    fov: float
    fov_axis: _FovAxis
    distortion: Distortion | None
    key: Sequence[_Key] | None

class ThinLens(_Keys):
    eye: _Vector | None
    look_at: _Vector | None
    up: _Vector
    fov: float
    fov_axis: _FovAxis
    aperture: float | None
    focus: float | _Vector | None
    f_number: float | None
    focal_length: float | None
    distortion: Distortion | None
    key: Sequence[_Key] | None

class Lens(_Keys):
    eye: _Vector | None
    look_at: _Vector | None
    up: _Vector
    file: _Path | None
    film_width: float
    scale: float
    focus: float | _Vector | None
    f_number: float | None
    distortion: Distortion | None
    key: Sequence[_Key] | None
    surfaces: NDArray[Any] | None

class Fit(_Keys):
    type: Literal["pinhole", "orthographic"]
    direction: _Vector | None
    up: _Vector | None
    fov: float
    fov_axis: _FovAxis | None
    margin: float
    pose: Literal["upright", "principal"] | None
    roll: float
    room: float
    distortion: Distortion | None

class Distortion(_Keys):
    file: _Path | None
    st: NDArray[Any] | None

class ConstantBackground(_Keys):
    color: _Color

class GradientBackground(_Keys):
    bottom: _Color
    top: _Color
    up: _Vector

class EnvironmentBackground(_Keys):
    file: _Path | None
    rotation: float
    pixels: NDArray[Any] | None

class PointLight(_Keys):
    position: _Vector
    intensity: _Color
    falloff: Literal["none", "inverse_square"]
    relative_to: _Frame

class DirectionalLight(_Keys):
    direction: _Vector
    intensity: _Color
    relative_to: _Frame

class SphereLight(_Keys):
    center: _Vector
    radius: float
    radiance: _Color
    relative_to: _Frame
    color: _Color | None

class ImageSettings(_Keys):
    size: Sequence[int]
    spp: int
    filter: _Filter
    transparent: bool
    outline: float
    overlay: Sequence[_OverlayPart]
    fog: float
    fog_from: float | None
    fog_to: float | None

class RenderSettings(_Keys):
    method: _Method
    max_depth: int
    noise: float
    min_spp: int
    aa: float
    least_weight: float

class Sphere(_Keys):
    center: _Vector
    radius: float
    material: _Material | str | None
    color: _Color | None

class Plane(_Keys):
    point: _Vector
    normal: _Vector
    material: _Material | str | None
    color: _Color | None

class Capsule(_Keys):
    a: _Vector
    b: _Vector
    radius: float
    material: _Material | str | None
    color: _Color | None

class Clip(_Keys):
    point: _Vector
    normal: _Vector

class Instance(_Keys):
    group: Group | str | None
    translate: _Vector
    rotate: _Vector
    scale: float
    material: _Material | str | None

class Particles(_Keys):
    file: _Path | None
    frame: int | None
    format: str | None
    columns: Sequence[str] | None
    water: bool | None
    topology: str | None
    radius: float | str | None
    radii: Mapping[str, float] | None
    scale: float | None
    color: _Color | _Key | None
    colors: Mapping[str, _Color] | None
    nan_color: _Color | None
    outline_by: str | None
    style: _Style | None
    bonds: float | str | None
    bond_radius: float | None
    bond_color: _Color | None
    cell_edges: bool | None
    axes: bool | None
    arrows: str | Sequence[str] | None
    arrow_scale: float | None
    select: str | None
    ghost: str | None
    opacity: float | None
    labels: str | None
    label_text: str | Sequence[str] | None
    wrap: bool | None
    unwrap: bool | None
    boundary: bool | None
    replicate: Sequence[int] | None
    material: _Material | str | None

_Material = Union[Matte, Plastic, Metal, Glass, Emissive, Phong, Ghost]
_Camera = Union[Pinhole, Orthographic, Fisheye, ThinLens, Lens, Fit]
_Background = Union[ConstantBackground, GradientBackground, EnvironmentBackground]
_Light = Union[PointLight, DirectionalLight, SphereLight]
_Map = Union[str, Sequence[str]]

class _Colors(_Keys):
    colors: ArrayLike | None
    color_space: Literal["srgb", "linear"]
    scalar: ArrayLike | None
    map: _Map | None
    range: Sequence[float] | None
    color: _Color | None
    material: _Material | str | None

class _Many:
    color: _Color | None
    material: _Material | str | None
    def __len__(self) -> int: ...
    @property
    def colors(self) -> NDArray[np.uint8] | None: ...
    @property
    def range(self) -> list[float] | None: ...

class Spheres(_Many):
    def __init__(self, centers: ArrayLike, radii: ArrayLike, **colors: _Colors) -> None: ...
    @property
    def centers(self) -> NDArray[Any]: ...
    @property
    def radii(self) -> NDArray[np.float32]: ...

class Capsules(_Many):
    def __init__(
        self, a: ArrayLike, b: ArrayLike, radius: ArrayLike, **colors: _Colors
    ) -> None: ...
    @property
    def a(self) -> NDArray[Any]: ...
    @property
    def b(self) -> NDArray[Any]: ...
    @property
    def radius(self) -> NDArray[np.float32]: ...

class _Objects:
    spheres: list[Sphere | Spheres | Particles]
    planes: list[Plane]
    capsules: list[Capsule | Capsules]
    instances: list[Instance]
    def add_spheres(
        self, centers: ArrayLike, radii: ArrayLike, **colors: _Colors
    ) -> Spheres: ...
    def add_sphere(self, **keys: Sphere) -> Sphere: ...
    def add_particles(self, file: _Path, **keys: Particles) -> Particles: ...
    def add_plane(self, **keys: Plane) -> Plane: ...
    def add_capsules(
        self, a: ArrayLike, b: ArrayLike, radius: ArrayLike, **colors: _Colors
    ) -> Capsules: ...
    def add_capsule(self, **keys: Capsule) -> Capsule: ...
    def add_instance(self, group: Group | str, **keys: Instance) -> Instance: ...

class Group(_Objects):
    name: str
    def __init__(self, name: str = ...) -> None: ...

class Scene(_Objects):
    image: ImageSettings
    render: RenderSettings
    camera: _Camera | None
    background: _Background
    ambient: _Color
    backdrop: _Color | None
    materials: dict[str, _Material]
    lights: list[_Light]
    clips: list[Clip]
    groups: dict[str, Group]
    origin: str | _Vector
    notes: list[str]
    warnings: list[str]
    legend: str
    def __init__(
        self,
        *,
        image: ImageSettings | None = ...,
        render: RenderSettings | None = ...,
        camera: _Camera | None = ...,
        background: _Background | None = ...,
        ambient: _Color = ...,
        backdrop: _Color | None = ...,
        materials: Mapping[str, _Material] | None = ...,
        lights: Sequence[_Light] | None = ...,
        spheres: Sequence[Sphere | Spheres | Particles] | None = ...,
        planes: Sequence[Plane] | None = ...,
        groups: Mapping[str, Group] | None = ...,
        instances: Sequence[Instance] | None = ...,
        capsules: Sequence[Capsule | Capsules] | None = ...,
        clips: Sequence[Clip] | None = ...,
        origin: str | _Vector = ...,
    ) -> None: ...
    def add_clip(self, **keys: Clip) -> Clip: ...
    def add_group(self, name: str) -> Group: ...
    def rays(
        self,
        size: str | Sequence[int] | None = ...,
        spp: int = ...,
        sample: int = ...,
        *,
        filter: _Filter | None = ...,
        seed: int | None = ...,
        crop: str | Sequence[int] | None = ...,
        frame: int | None = ...,
    ) -> Rays: ...
    def save(self, path: _Path) -> None: ...
    def fitted_camera(
        self, size: str | Sequence[int] | None = ...
    ) -> Pinhole | Orthographic: ...

class Rays(NamedTuple):
    origin: NDArray[np.float64]
    direction: NDArray[np.float32]

class Hits(NamedTuple):
    t: NDArray[np.float64]
    id: NDArray[np.int32]
    normal: NDArray[np.float32]
    entering: NDArray[np.bool_]
    @property
    def hit(self) -> NDArray[np.bool_]: ...

class Crossings(NamedTuple):
    offset: NDArray[np.int64]
    t: NDArray[np.float64]
    id: NDArray[np.int32]
    entering: NDArray[np.bool_]

class Chords(NamedTuple):
    offset: NDArray[np.int64]
    id: NDArray[np.int32]
    length: NDArray[np.float64]

class Nearest(NamedTuple):
    distance: NDArray[np.float64]
    id: NDArray[np.int32]

class Members(NamedTuple):
    offset: NDArray[np.int64]
    id: NDArray[np.int32]

class Pairs(NamedTuple):
    first: NDArray[np.int32]
    second: NDArray[np.int32]
    gap: NDArray[np.float64]

class Tracer:
    def __init__(
        self,
        source: ArrayLike | Scene | _Path,
        radii: ArrayLike | None = ...,
        *,
        origin: str | _Vector = ...,
        solver: _Solver = ...,
        threads: int = ...,
        isa: str = ...,
    ) -> None: ...
    def closest(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
        out: Hits | None = ...,
    ) -> Hits: ...
    def any(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
        out: NDArray[np.bool_] | None = ...,
    ) -> NDArray[np.bool_]: ...
    def all_hits(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        limit: int | None = ...,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
    ) -> Crossings: ...
    def count(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
        out: NDArray[np.int64] | None = ...,
    ) -> NDArray[np.int64]: ...
    @overload
    def chord(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
        per_sphere: Literal[False] = ...,
        out: NDArray[np.float64] | None = ...,
    ) -> NDArray[np.float64]: ...
    @overload
    def chord(
        self,
        org: ArrayLike,
        dir: ArrayLike,
        tmin: ArrayLike = ...,
        tmax: ArrayLike = ...,
        *,
        source: ArrayLike = ...,
        inside: ArrayLike = ...,
        per_sphere: Literal[True],
        out: None = ...,
    ) -> Chords: ...
    def update(self, centers: ArrayLike, radii: ArrayLike | None = ...) -> None: ...
    def nearest(self, points: ArrayLike, k: int = ..., limit: float = ...) -> Nearest: ...
    @overload
    def inside(self, points: ArrayLike, *, first: Literal[False] = ...) -> Members: ...
    @overload
    def inside(self, points: ArrayLike, *, first: Literal[True]) -> NDArray[np.int32]: ...
    def within(self, points: ArrayLike, radius: ArrayLike) -> Members: ...
    def pairs(self, gap: float = ...) -> Pairs: ...
    @property
    def stats(self) -> dict[str, Any]: ...

class Picture:
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def finished(self) -> bool: ...
    @property
    def share(self) -> float: ...
    @property
    def alpha(self) -> NDArray[np.float32] | None: ...
    @property
    def channels(self) -> dict[str, NDArray[Any]]: ...
    @property
    def aovs(self) -> dict[str, NDArray[Any]]: ...
    @property
    def stats(self) -> dict[str, Any]: ...
    @property
    def notes(self) -> list[str]: ...
    def to_srgb(self, *, exposure: float = ...) -> NDArray[np.uint8]: ...
    def save(
        self,
        path: _Path,
        *,
        exposure: float = ...,
        compression: Literal["none", "rle", "zip"] = ...,
    ) -> None: ...
    def __array__(self, dtype: Any = ...) -> NDArray[Any]: ...
    def _repr_png_(self) -> bytes: ...

class View:
    url: str
    notes: list[str]
    def __init__(
        self, process: Any, url: str, notes: list[str], title: str, height: int, folder: Any
    ) -> None: ...
    def close(self) -> None: ...
    def open(self) -> bool: ...
    def __enter__(self) -> View: ...
    def __exit__(self, *_: object) -> None: ...
    def _repr_html_(self) -> str: ...

def view(
    scene: Scene | _Path | _Atoms,
    *,
    size: tuple[int, int] | None = ...,
    spp: int | None = ...,
    frames: range | None = ...,
    threads: int | None = ...,
    height: int = ...,
    **look: _FromFile,
) -> View: ...
class _Shown(_Keys):
    """How particles are shown."""

    look: _Look | None
    quick: bool
    floor: bool
    color: str | None
    colors: str | Mapping[str, str] | None
    map: _Map | None
    range: Sequence[float] | None
    nan_color: str | None
    radius: float | str | None
    radii: str | Mapping[str, float] | None
    scale: float | None
    outline_by: str | None
    style: _Style | None
    bonds: float | str | None
    bond_radius: float | None
    bond_color: str | None
    cell_edges: bool
    axes: bool
    arrows: str | Sequence[str] | None
    arrow_scale: float | None
    select: str | None
    clip: str | Sequence[str] | None
    ghost: str | None
    opacity: float | None
    labels: str | None
    label_text: str | Sequence[str] | None
    wrap: bool
    unwrap: bool
    boundary: bool
    replicate: str | Sequence[int] | None
    view: str | _Vector | None
    up: str | _Vector | None
    roll: float | None
    ortho: bool
    fov: float | None
    margin: float | None

class _FromFile(_Shown):
    """The same of those of a file, and how it is read."""

    input_format: str | None
    columns: str | Sequence[str] | None
    water: bool
    topology: str | None

def load(
    source: _Path | _Atoms,
    *,
    frame: int | None = ...,
    polygons: _Polygons = ...,
    **look: _FromFile,
) -> Scene: ...
def frames(
    source: _Path,
    frames: range | None = ...,
    *,
    interpolate: int = ...,
    polygons: _Polygons = ...,
    **look: _FromFile,
) -> Iterator[Scene]: ...
def from_particles(
    positions: ArrayLike,
    *,
    species: Sequence[str] | Sequence[bytes] | Sequence[float] | NDArray[Any] | None = ...,
    columns: Mapping[str, Sequence[float] | Sequence[str] | Sequence[bytes] | NDArray[Any]] | None = ...,
    cell: ArrayLike | None = ...,
    periodic: bool | Sequence[bool] = ...,
    angstrom: float = ...,
    **look: _Shown,
) -> Scene: ...
def from_ase(atoms: Any, **look: _Shown) -> Scene: ...
def series(frames: Iterable[Any], **look: _Shown) -> Iterator[Scene]: ...
def render(
    scene: Scene | _Path | _Atoms,
    *,
    size: str | Sequence[int] | None = ...,
    width: str | None = ...,
    dpi: float | None = ...,
    spp: int | None = ...,
    noise: float | None = ...,
    min_spp: int | None = ...,
    aa: float | None = ...,
    exposure: float | None = ...,
    filter: _Filter | None = ...,
    background: str | None = ...,
    outline: float | str | None = ...,
    fog: float | None = ...,
    overlay: str | Sequence[_OverlayPart] | None = ...,
    seed: int | None = ...,
    crop: str | Sequence[int] | None = ...,
    aov: str | Sequence[str] | None = ...,
    method: _Method | None = ...,
    max_depth: int | None = ...,
    least_weight: float | None = ...,
    shadow_epsilon: float | Literal["none"] | None = ...,
    time_limit: float | None = ...,
    partial: bool = ...,
    order: _Order | None = ...,
    tile: int | None = ...,
    solver: _Solver | None = ...,
    threads: int | None = ...,
    isa: str | None = ...,
    progress: bool | Callable[[float], object] = ...,
    frame: int | None = ...,
    polygons: _Polygons | None = ...,
    trust: bool = ...,
    **look: _FromFile,
) -> Picture: ...
