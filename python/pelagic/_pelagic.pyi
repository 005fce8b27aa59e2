"""The C++ module. Arrays are NumPy arrays. Points are (..., 2), x and z in metres; x and z may also
be separate arguments."""

from types import TracebackType
from typing import Any, Dict, Iterable, List, Literal, Optional, Tuple, Type, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._options import AnalyticWave, Disturbance, DynamicWavesOptions, Rain, Ripple, ShoreOptions, SprayEmitter, SprayOptions
from ._sea import Sea

version: str

Field = Literal["height", "normal", "jacobian", "velocity", "foam", "converged", "error"]
Interpolation = Literal["linear", "cubic"]

class StaleFrame(RuntimeError):
    """The frame's memory belongs to a later frame."""

class SurfaceSamples(TypedDict, total=False):
    """The results of a query, for each point."""

    height: NDArray[np.float32]  #: metres
    normal: NDArray[np.float32]  #: (..., 3), unit vectors
    jacobian: NDArray[np.float32]  #: 1 undisplaced, small at sharp crests, < 0 if overturned
    velocity: NDArray[np.float32]  #: (..., 3), m/s; requires Ocean(velocities=True)
    foam: NDArray[np.float32]  #: 0 to 1; requires Ocean(foam=True)
    converged: NDArray[np.bool_]  #: the error is within the tolerance
    error: NDArray[np.float32]  #: horizontal distance of the sampled point, metres

class UndisplacedSamples(TypedDict, total=False):
    """The water at n reference positions. Velocity and foam require an ocean that has them."""

    displacement: NDArray[np.float32]  #: (n, 3), displacement in metres
    velocity: NDArray[np.float32]  #: (n, 3), m/s
    foam: NDArray[np.float32]  #: (n,), 0 to 1

class Hits(TypedDict):
    """The first intersection of each ray with the water."""

    hit: NDArray[np.bool_]
    distance: NDArray[np.float64]  #: inf without a hit
    position: NDArray[np.float64]  #: (..., 3), nan without a hit
    normal: NDArray[np.float32]  #: (..., 3), normal of the surface, equal from above and below
    from_below: NDArray[np.bool_]

class Bounds:
    """Extremes of displacements, in metres."""

    @property
    def height_min_m(self) -> float:
        """The lowest trough."""
    @property
    def height_max_m(self) -> float:
        """The highest crest."""
    @property
    def horizontal_x_max_m(self) -> float:
        """The largest |Dx|."""
    @property
    def horizontal_z_max_m(self) -> float:
        """The largest |Dz|."""

class Cascade:
    """A cascade of a frame: a band of waves on a square that repeats over the whole sea. The
    displacements of a frame's cascades add. With cascades=1 a frame has `gradient` and `foam`, and
    its foam is that; otherwise it has `slopes` and `compression`, whose sums have the waves' foam.

    Element [j, i] has the reference position x = (c i - s j) L/N, z = (s i + c j) L/N, where c and
    s are `rotation`, L is `patch_size_m` and N is `resolution`. A view is read-only memory of the
    ocean; a copy belongs to the caller and is writable.
    """

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view: Dx, height, Dz in metres, 0."""
    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy, metres."""
    @property
    def dx(self) -> NDArray[np.float32]:
        """(N, N), a copy: horizontal displacement along x, metres."""
    @property
    def dz(self) -> NDArray[np.float32]:
        """(N, N), a copy: horizontal displacement along z, metres."""
    @property
    def velocity_x(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of dx, m/s. Requires Ocean(velocities=True)."""
    @property
    def velocity_y(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of the height, m/s. Requires Ocean(velocities=True).
        """
    @property
    def velocity_z(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of dz, m/s. Requires Ocean(velocities=True)."""
    @property
    def gradient(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: normal x, normal z, Jacobian, smoothness, of this cascade alone.
        Requires Ocean(gradients=...)."""
    def gradient_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of gradient, 0 to levels - 1."""
    @property
    def slopes(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: h_x, h_z, D_xx, D_zz, each (byte - 128)/127 of slope_range. They add
        to those of other cascades. Requires Ocean(slopes=...)."""
    def slopes_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of slopes, 0 to levels - 1."""
    @property
    def moments(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: D_xz as in slopes, then the variances of h_x and h_z within a texel,
        byte/255 of variance_range, and their covariance, (byte - 128)/127 of it. Requires slopes.
        """
    def moments_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of moments, 0 to levels - 1."""
    @property
    def compression(self) -> Optional[NDArray[np.uint8]]:
        """(N, N), a view: compression q = -3 + 8 byte/255 now. Foam is that of the sum of the
        cascades' q; see snapshots. None if the cascade makes no foam. Requires Ocean(foam=True).
        """
    @property
    def snapshots(self) -> Optional[Tuple[NDArray[np.uint8], ...]]:
        """Four (N, N, 4) views: q at 16 past ticks, snapshot s in image s // 4, byte s % 4. With S
        the sum over the cascades, the foam at a position is the largest of clamp(0.5 + (S -
        foam_threshold)/0.3, 0, 1) of compression, and that minus snapshot_ages[s] of snapshot s.
        None if the cascade makes no foam. Requires Ocean(foam=True)."""
    @property
    def drift(self) -> Tuple[float, float]:
        """Columns and rows: texel (i, j) has the snapshots of texel (i - columns, j - rows)."""
    @property
    def resolution(self) -> int:
        """N, texels along a side."""
    @property
    def levels(self) -> int:
        """Mip levels of gradient, slopes and moments."""
    @property
    def patch_size_m(self) -> float:
        """L, the period of the cascade along its axes, in metres."""
    @property
    def rotation(self) -> Tuple[float, float]:
        """Cosine and sine of the rotation of its axes relative to the world's, from +x towards +z.
        """
    @property
    def slope_range(self) -> float:
        """Range of the bytes of slopes."""
    @property
    def variance_range(self) -> float:
        """Range of the variances in moments."""
    @property
    def bounds(self) -> Bounds:
        """Exact extremes of the cascade's displacements."""

class DynamicWavesView:
    """The dynamic waves of a frame, whose height adds to that of the cascades at the displaced
    position.

    Texel (i, j) of the world is at x = i texel_m, z = j texel_m and is element [j mod N, i mod N].
    The grid has first_x <= i < first_x + N, and j likewise. np.roll(array, (-first_z, -first_x),
    (0, 1)) begins with the lowest texel. Arrays are views; the other values stay valid when the
    frame is over.
    """

    @property
    def height_m(self) -> NDArray[np.float32]:
        """(N, N), a view."""
    @property
    def vertical_velocity_mps(self) -> NDArray[np.float32]:
        """(N, N), a view."""
    @property
    def foam(self) -> NDArray[np.uint8]:
        """(N, N), a view: 0 (no foam) to 255 (covered)."""
    @property
    def resolution(self) -> int:
        """N, texels along a side."""
    @property
    def texel_m(self) -> float:
        """Side of a texel."""
    @property
    def first_x(self) -> int:
        """The lowest texel along x."""
    @property
    def first_z(self) -> int:
        """The lowest texel along z."""
    @property
    def height_min_m(self) -> float:
        """Lower bound of the heights."""
    @property
    def height_max_m(self) -> float:
        """Upper bound of the heights."""
    @property
    def hash(self) -> int:
        """XXH3 of the position and the arrays: dynamic_waves_hash in sea.json."""

class ShoreSurface:
    """The shore of a frame: a rectangle with a sea floor, where cascades are attenuated and waves
    over the floor are added.

    Element [j, i] is at x = x_m + i texel_m, z = z_m + j texel_m. Arrays are views; the other
    values stay valid when the frame is over.
    """

    @property
    def columns(self) -> int:
        """Texels along x."""
    @property
    def rows(self) -> int:
        """Texels along z."""
    @property
    def texel_m(self) -> float:
        """Side of a texel."""
    @property
    def x_m(self) -> float:
        """Position of element [0, 0]."""
    @property
    def z_m(self) -> float:
        """Position of element [0, 0]."""
    @property
    def depth_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: depth of still water, negative on land."""
    @property
    def weights_rgba8(self) -> NDArray[np.uint8]:
        """(rows, columns, 4), a view: weight of cascade t in [..., t], 255 for 1."""
    @property
    def height_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: height that adds to the cascades."""
    @property
    def vertical_velocity_mps(self) -> NDArray[np.float32]:
        """(rows, columns), a view."""
    @property
    def potential_m2ps(self) -> NDArray[np.float32]:
        """(rows, columns), a view: velocity potential of these waves at the surface."""
    @property
    def reach_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: envelope of the crests. Sand below it is wet."""
    @property
    def foam(self) -> NDArray[np.uint8]:
        """(rows, columns), a view: foam of breaking waves, 0 (no foam) to 255 (covered)."""
    @property
    def height_min_m(self) -> float:
        """Lower bound of the heights."""
    @property
    def height_max_m(self) -> float:
        """Upper bound of the heights."""
    @property
    def weights_change_per_m(self) -> float:
        """Upper bound of the change of a weight over a metre."""
    @property
    def hash(self) -> int:
        """XXH3 of the arrays."""

class Frame:
    """The sea at a time. It is valid until the second schedule() or frame_at() after its own, and
    then raises StaleFrame; time_s, sea, bounds and significant_wave_height_m stay valid. Any number
    of threads may query it at the same time."""

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view of the first cascade, which has the longest waves."""
    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy of the first cascade's heights, without those of others; query() includes
        all."""
    @property
    def cascades(self) -> List[Cascade]:
        """The cascades, the coarsest first."""
    @property
    def time_s(self) -> float:
        """The requested time."""
    @property
    def bounds(self) -> Bounds:
        """Sums over the cascades: upper bounds, exact with cascades=1."""
    @property
    def sea(self) -> Sea:
        """The sea at this time."""
    @property
    def significant_wave_height_m(self) -> float:
        """Hs of the waves that the cascades represent, the mean over all seeds."""
    @property
    def is_alive(self) -> bool:
        """False if the frame would raise StaleFrame or its ocean is closed."""
    @property
    def dynamic_waves(self) -> DynamicWavesView:
        """Wakes, ripples and splashes. Requires Ocean(dynamic_waves=...)."""
    @property
    def shore(self) -> ShoreSurface:
        """Depths, weights and waves over the floor. Requires Ocean(shore=...)."""
    @property
    def hash(self) -> int:
        """XXH3 of all of the frame's data, which the command line prints in hexadecimal digits."""
    @property
    def foam_hash(self) -> int:
        """XXH3 of the foam. Requires Ocean(foam=True)."""
    @property
    def droplets(self) -> NDArray[np.void]:
        """A view with the fields position (x, y, z), velocity (x, y, z), radius, opacity and age, in
        the world: droplets of emitters, then of crests, each with the newest first. Droplets below
        the water are not removed. Requires Ocean(spray=...)."""
    @property
    def spray_hash(self) -> int:
        """XXH3 of the droplets. Requires Ocean(spray=...)."""
    @property
    def foam_threshold(self) -> float:
        """The sum of compressions at which half of the water is white; 1000 without whitecaps."""
    @property
    def snapshot_ages(self) -> List[float]:
        """Foam that has decayed since each of the 16 snapshots; 1 and more: it has no effect."""
    def measured_significant_wave_height_m(self) -> float:
        """4 times the standard deviation of the frame's heights."""
    def query(
        self,
        points: ArrayLike,
        z: Optional[ArrayLike] = None,
        *,
        fields: Optional[Iterable[Field]] = None,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "linear",
    ) -> SurfaceSamples:
        """Samples the displaced surface at points of the world: query(points) or query(x, z).

        `fields` names the requested results; the default is all that the ocean's options provide.
        `interpolation` is that between texels: "linear" is the drawn surface, "cubic" preserves the
        heights and slopes of short waves, for measurements. Results are reproducible: they depend
        only on the frame, the point and the options. Warns if the points span more than the repeat
        length of the longest waves.
        """
    def rays(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike, *, tolerance_m: float = 0.001) -> Hits:
        """Returns the first intersection of each ray with the water. Origins and directions are
        (..., 3); reach is in metres, a number or one for each ray."""
    def displaced(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """Returns (..., 3): displaced positions of water by its reference positions, for meshes.
        Includes dynamic waves and a shore."""
    def displaced_foam(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """Returns (...): the foam of that water, 0 to 1. Requires Ocean(foam=True), dynamic waves
        or a shore."""
    def sample_undisplaced(self, points: ArrayLike) -> UndisplacedSamples:
        """Returns displacement, foam and velocity in one call, for meshes of many vertices that
        move every frame. Points are (n, 2), within 1e9 m."""

class WaveInput:
    """Waves that are added to an ocean's cascades: a GerstnerInput or a RippleInput. It belongs to
    one ocean; changes take effect at the next schedule()."""

class GerstnerInput(WaveInput):
    """A list of Gerstner waves, for Ocean(inputs=[...]). Each becomes the nearest wave of a
    cascade's grid, with whole periods in a loop."""

    def __init__(self, waves: Iterable[AnalyticWave] = (), choppiness: float = 1.0) -> None:
        """At most 64 waves; choppiness is in [0, 1], and 0 gives a height field."""
    def set(self, waves: Iterable[AnalyticWave], choppiness: float = 1.0) -> None:
        """Replaces the waves."""

class RippleInput(WaveInput):
    """Rings around a point, for Ocean(inputs=[...])."""

    def __init__(self, ripple: Ripple) -> None:
        """The rings."""
    def set(self, ripple: Ripple) -> None:
        """Replaces the rings."""

class DynamicWaves:
    """The dynamic waves of an ocean. Commands take effect at the next schedule(), in the order of
    the calls. Identical times with identical commands give bit-identical waves. A time before the
    last one does not change the waves, and a jump ahead computes at most half a second."""

    def add_impulse(self, disturbance: Disturbance) -> None:
        """Acts once, in the next tick. At most 4096 impulses can be pending."""
    def add_source(self, source: Disturbance) -> int:
        """Acts in every tick, moving at its velocity, until it is removed. Returns its number. At
        most 4096 sources at once."""
    def set_source(self, number: int, source: Disturbance) -> None:
        """Replaces a source. Does nothing if there is no source of that number."""
    def remove_source(self, number: int) -> None:
        """Does nothing if there is no source of that number."""
    def set_center(self, x_m: float, z_m: float) -> None:
        """Moves the grid's centre to within half a texel of the point. New texels
        are flat."""
    def set_rain(self, rain: Rain) -> None:
        """Sets the rain from the next tick on; drops_per_m2_s = 0 ends it."""
    def save_state(self) -> bytes:
        """Returns everything that later ticks depend on, except commands since the last schedule().
        No frame may be in flight."""
    def restore_state(self, saved: bytes) -> None:
        """Continues from a saved state of waves with equal options, and drops commands since the
        last schedule(). No frame may be in flight."""

class Ocean:
    """A sea that computes frames. Use it in a `with` statement, or call close().

    It has the memory of two frames. While an array views a frame, the second schedule() or
    frame_at() after that frame's raises BufferError instead of overwriting it. close(), or the last
    view after it, frees the memory.
    """

    def __init__(
        self,
        sea: Sea,
        queries: bool = True,
        velocities: bool = False,
        foam: bool = False,
        gradients: Optional[bool] = None,
        slopes: Optional[bool] = None,
        threads: int = 0,
        isa: Optional[str] = None,
        largest_peak_m: float = 0.0,
        dynamic_waves: Optional[DynamicWavesOptions] = None,
        shore: Optional[ShoreOptions] = None,
        inputs: Iterable[WaveInput] = (),
        planes: bool = True,
        spray: Optional[SprayOptions] = None,
    ) -> None:
        """Creates an ocean.

        queries     allow query() and rays() on frames
        velocities  compute velocities; about twice the work
        foam        compute foam, which depends on the last 2.8 seconds
        gradients   normals of each cascade; None: with cascades=1, and without slopes
        slopes      slopes of each cascade; None: with 2 or more cascades, with foam, and without
                    gradients. Foam needs slopes. Slopes and gradients cannot both be False
        threads     maximum threads of a frame, including the calling thread; 0: one per core
        isa         "sse4.2", "avx2", "avx512" or "neon"; None: PELAGIC_ISA, else the strongest.
                    Results are bit-identical
        largest_peak_m  longest peak wavelength that the cascades support, for a sea of a later
                    transition: its report().peak_wavelength_m. 0: that of the first sea. A warning
                    names the shortest wave that is left if it is twice as long as without
        dynamic_waves  the grid of wakes, ripples and splashes; None: no dynamic waves
        shore       a sea floor that affects waves; None: no shore
        inputs      waves that are added to those of the wind, in this order; they change the hash
        planes      displacement as floats. False leaves only textures, for applications that only
                    draw; needs queries=False
        spray       droplets of breaking crests and emitters; None: no spray
        """
    def __enter__(self) -> Ocean: ...
    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None: ...
    def close(self) -> None:
        """Waits for readers of frames and frees the memory. Afterwards frames raise ValueError;
        arrays stay valid."""
    @property
    def is_closed(self) -> bool:
        """True after close(), or after the end of a with statement."""
    def schedule(self, time_s: float) -> None:
        """Starts the frame of a time and returns at once."""
    def is_ready(self) -> bool:
        """True if complete() would not wait for other threads."""
    def complete(self) -> Frame:
        """Waits for the scheduled frame, and helps to compute it."""
    def frame_at(self, time_s: float) -> Frame:
        """Calls schedule() and complete()."""
    def series(
        self,
        points: ArrayLike,
        times: ArrayLike,
        *,
        fields: Optional[Iterable[Field]] = None,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "cubic",
        repeats: bool = False,
    ) -> SurfaceSamples:
        """Returns the results of frame_at(time).query(points) for each of n times, while other
        threads run: arrays of shape (n, ...), vectors of shape (n, ..., 3), for points of shape
        (..., 2). Earlier frames become stale.

        Raises ValueError if the times span more than the sea's loop, unless repeats is True. Warns
        like query().
        """
    def schedule_sea(self, sea: Sea, from_s: float, over_s: float, swell_from_m: float = 0.0) -> None:
        """Schedules a transition to another sea, from a time on and over a number of seconds.
        Cascades, depth, loop and seed must be the same. A transition from before the frame computed
        last starts at that frame's time. If swell_from_m, the distance of the swell's origin in
        metres, is not 0, long waves arrive first."""
    def set_water_frame(self, sea_level_m: float = 0.0, current_mps: Tuple[float, float] = (0.0, 0.0)) -> None:
        """Sets the sea level, [-1000, 1000], and the velocity of a uniform current along x and z,
        each [-10, 10], for frames that are scheduled from now on. Queries and dynamic waves then
        use positions in the world, and the current carries the water; the other data of frames do
        not change. Raises ValueError with a shore."""
    def set_spray_center(self, x_m: float, z_m: float) -> None:
        """Sets the centre of the spray of crests, usually the camera. It takes effect at the next
        schedule(), for the ticks computed from then on. Requires Ocean(spray=...)."""
    def emit(self, emitters: Iterable[SprayEmitter]) -> None:
        """Adds droplets of emitters to frames that are scheduled from now on, at most 8192 in a call.
        Requires Ocean(spray=...)."""
    def save_spray(self) -> bytes:
        """Returns the droplets of emitters. No frame may be in flight."""
    def restore_spray(self, saved: bytes) -> None:
        """Replaces the droplets of emitters. No frame may be in flight."""
    @property
    def dynamic_waves(self) -> DynamicWaves:
        """The dynamic waves. Requires Ocean(dynamic_waves=...)."""
    @property
    def sea(self) -> Sea:
        """The sea after the last transition."""
    @property
    def resolution(self) -> int:
        """Texels along a side of each cascade."""
    @property
    def cascade_count(self) -> int:
        """Number of cascades of every frame."""
    @property
    def threads(self) -> int:
        """Maximum threads of a frame, including the calling thread."""
    @property
    def memory_bytes(self) -> int:
        """Bytes that the ocean allocated."""
    @property
    def isa(self) -> str:
        """The instruction set in use."""

class Hull:
    """Mesh, mass and coefficients of hulls of one kind. Axes: x forward, y up, z to starboard. The
    last properties are those of the hull upright at rest in still water; 0 if it sinks."""

    def __init__(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        mass_kg: float,
        *,
        centre_of_mass_m: Optional[ArrayLike] = None,
        inertia_kgm2: Optional[ArrayLike] = None,
        added_mass: Optional[ArrayLike] = None,
        heave_damping: float = 0.2,
        roll_damping: float = 0.05,
        pressure_coefficient: float = 0.7,
        suction_coefficient: float = 0.35,
        friction_coefficient: float = 0.004,
        air_coefficient: float = 1.0,
        water_density_kgpm3: float = 1025.0,
        air_density_kgpm3: float = 1.225,
        skeg_m2: float = 0,
        skeg_x_m: float = 0,
        skeg_y_m: float = 0,
    ) -> None:
        """Creates a hull from a closed mesh, wound counter-clockwise as seen from outside.

        vertices    (n, 3), in metres; vertices at equal positions are merged
        triangles   (m, 3), numbers of vertices, 4 to 4096 triangles
        mass_kg     [1e-6, 1e10]
        centre_of_mass_m  (3,), in the mesh's axes; None: the centre of its volume
        inertia_kgm2  (3,), about axes through the centre of mass; None: of an even filling
        added_mass  (6, 6), of surge, heave, sway, roll, yaw and pitch at rest; None: derived from
                    the sizes of waterline and draught
        heave_damping, roll_damping  fractions of critical damping; [0, 0.999]
        pressure_coefficient, suction_coefficient  drag of advancing and retreating faces; [0, 10]
        friction_coefficient  [0, 1]
        air_coefficient  drag of faces above the water; [0, 10]
        water_density_kgpm3, air_density_kgpm3  [500, 2000] and [0, 10]
        skeg_m2     lateral area of a skeg, keel or fin, which keeps the course under thrust; [0, 1e4]
        skeg_x_m, skeg_y_m  its middle in the mesh's axes; [-1000, 1000]
        """
    @property
    def volume_m3(self) -> float:
        """The volume of the mesh."""
    @property
    def centre_m(self) -> Tuple[float, float, float]:
        """The centre of the volume, in the mesh's axes."""
    @property
    def mass_kg(self) -> float:
        """The mass."""
    @property
    def centre_of_mass_m(self) -> Tuple[float, float, float]:
        """The centre of mass, in the mesh's axes."""
    @property
    def floats(self) -> bool:
        """False if it is heavier than its volume of water."""
    @property
    def draught_m(self) -> float:
        """The depth of the lowest vertex."""
    @property
    def height_m(self) -> float:
        """The height of the centre of mass above the water."""
    @property
    def waterplane_m2(self) -> float:
        """The area of the section at the water's surface."""
    @property
    def roll_gm_m(self) -> float:
        """The metacentric height of roll."""
    @property
    def pitch_gm_m(self) -> float:
        """The metacentric height of pitch."""
    @property
    def digest(self) -> int:
        """A 64-bit hash of mesh, mass and coefficients: equal hulls move bit-identically."""
    def at_rest(self, x_m: float, z_m: float, heading_rad: float = 0.0) -> HullState:
        """Returns the state of the hull upright at rest in still water, with its x axis rotated
        from +x towards +z by the heading."""

class HullState:
    """A rigid body in world axes, and what the water's forces depend on of the step before. A copy:
    Bodies.set_state() applies changes."""

    @property
    def position_m(self) -> Tuple[float, float, float]:
        """Position of the centre of mass."""
    @position_m.setter
    def position_m(self, value: Tuple[float, float, float]) -> None: ...
    @property
    def orientation(self) -> Tuple[float, float, float, float]:
        """Unit quaternion x, y, z, w: world from hull."""
    @orientation.setter
    def orientation(self, value: Tuple[float, float, float, float]) -> None: ...
    @property
    def velocity_mps(self) -> Tuple[float, float, float]:
        """Velocity of the centre of mass."""
    @velocity_mps.setter
    def velocity_mps(self, value: Tuple[float, float, float]) -> None: ...
    @property
    def angular_velocity_radps(self) -> Tuple[float, float, float]:
        """Angular velocity, in world axes."""
    @angular_velocity_radps.setter
    def angular_velocity_radps(self, value: Tuple[float, float, float]) -> None: ...

class HullLoads(TypedDict):
    """Forces of water and air on a body, and torques about its centre of mass, in world axes. The
    total leaves out weight and inputs."""

    total_force_n: Tuple[float, float, float]
    total_torque_nm: Tuple[float, float, float]
    pressure_force_n: Tuple[float, float, float]  #: of the water's weight and acceleration
    pressure_torque_nm: Tuple[float, float, float]
    added_mass_force_n: Tuple[float, float, float]  #: added mass times the water's acceleration
    added_mass_torque_nm: Tuple[float, float, float]
    drag_force_n: Tuple[float, float, float]  #: drag, radiation damping and air
    drag_torque_nm: Tuple[float, float, float]
    slamming_force_n: Tuple[float, float, float]
    slamming_torque_nm: Tuple[float, float, float]
    displaced_m3: float
    submersion: float  #: displaced over floating volume, at most 1
    water_height_m: float  #: of the surface at the centre of mass
    water_slope: Tuple[float, float]  #: along x and z
    water_velocity_mps: Tuple[float, float, float]

class Bodies:
    """A set of hulls that float in an ocean's water. With wakes they press on its dynamic waves,
    and float on the waves of others. A tick is frame = ocean.complete(), press(frame, tick_s),
    ocean.schedule(next_s), step(frame, tick_s)."""

    def __init__(self, ocean: Ocean, wakes: bool = False, threads: int = 0) -> None:
        """Creates an empty set.

        ocean       needs queries and velocities, and for wakes dynamic_waves
        wakes       bodies press on the dynamic waves
        threads     maximum threads of a step, including the calling thread; 0: one per core
        """
    def add(self, hull: Hull, state: HullState) -> int:
        """Adds a body without inputs. Returns its number, which is never reused."""
    def remove(self, number: int) -> None:
        """Does nothing if there is no body of that number."""
    def set_inputs(
        self,
        number: int,
        force_n: ArrayLike = (0.0, 0.0, 0.0),
        torque_nm: ArrayLike = (0.0, 0.0, 0.0),
        wind_mps: ArrayLike = (0.0, 0.0, 0.0),
    ) -> None:
        """Sets what else acts on a body from now on: engines, tow lines and contacts, about the
        centre of mass in world axes, and the wind."""
    def state(self, number: int) -> HullState:
        """Returns a copy of a body's state."""
    def set_state(self, number: int, state: HullState) -> None:
        """Replaces a body's state."""
    def loads(self, number: int) -> HullLoads:
        """Returns the loads of a body in the last step."""
    def press(self, frame: Frame, tick_s: float) -> None:
        """Moves the pressures of wakes to the bodies. Call it once a frame, between complete() and
        schedule(); tick_s is the time since the last call. Does nothing without wakes."""
    def step(self, frame: Frame, step_s: float) -> bool:
        """Advances all bodies by a step in the water of the frame completed last. More than 0.1 s is
        divided into equal steps. More than 1 s counts as 1 s, and the result is False then. Other
        threads run meanwhile. Results do not depend on the number of threads."""
    def save_state(self) -> bytes:
        """Returns everything that later steps depend on. Call it like DynamicWaves.save_state(),
        before the first command of a tick."""
    def restore_state(self, saved: bytes) -> None:
        """Continues from a saved state, whose hulls were added to this set. With wakes, restore the
        dynamic waves first. A frame of the saved time shows its water again."""

def isas_here() -> List[str]:
    """Returns the instruction sets that this processor supports, weakest first."""

def check_sea(sea: Sea) -> None: ...
def check_analytic_wave(wave: AnalyticWave) -> None: ...
def check_disturbance(disturbance: Disturbance) -> None: ...
def check_dynamic_waves_options(options: DynamicWavesOptions) -> None: ...
def check_rain(rain: Rain) -> None: ...
def check_ripple(ripple: Ripple) -> None: ...
def check_shore_options(options: ShoreOptions) -> None: ...
def check_spray_emitter(emitter: SprayEmitter) -> None: ...
def check_spray_options(options: SprayOptions) -> None: ...
def analytic_wave_fields() -> List[Tuple[str, float, str]]: ...
def disturbance_fields() -> List[Tuple[str, float, str]]: ...
def dynamic_waves_fields() -> List[Tuple[str, float, str]]: ...
def hull_fields() -> List[Tuple[str, float, str]]: ...
def rain_fields() -> List[Tuple[str, float, str]]: ...
def ripple_fields() -> List[Tuple[str, float, str]]: ...
def shore_fields() -> List[Tuple[str, float, str]]: ...
def spray_emitter_fields() -> List[Tuple[str, float, str]]: ...
def spray_fields() -> List[Tuple[str, float, str]]: ...
def sea_fields() -> List[Tuple[str, float, str]]: ...
def preset_list() -> List[Tuple[str, str, Sea]]: ...
def report(sea: Sea) -> Dict[str, Any]: ...
def model_by_frequency(sea: Sea, frequencies_hz: ArrayLike) -> NDArray[np.float64]: ...
def model_by_wave_number(sea: Sea, wave_numbers: ArrayLike) -> NDArray[np.float64]: ...
