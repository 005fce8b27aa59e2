"""What the module of C++ has. Arrays are NumPy's; points are (..., 2), x and z in metres, and may also be given as x and z apart."""

from types import TracebackType
from typing import Any, Dict, Iterable, List, Literal, Optional, Tuple, Type, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._options import AnalyticWave, Disturbance, DynamicWavesOptions, Rain, Ripple, ShoreOptions
from ._sea import Sea

version: str

Field = Literal["height", "normal", "jacobian", "velocity", "foam", "converged", "error"]
Interpolation = Literal["linear", "cubic"]

class StaleFrame(RuntimeError):
    """The frame's memory holds a later one."""

class Answers(TypedDict, total=False):
    """What a query tells of each point."""

    height: NDArray[np.float32]  #: metres
    normal: NDArray[np.float32]  #: (..., 3), of length 1
    jacobian: NDArray[np.float32]  #: 1 at rest, small at sharp crests, negative where the sheet is overturned
    velocity: NDArray[np.float32]  #: (..., 3), m/s, of the water that is there; with Ocean(velocities=True)
    foam: NDArray[np.float32]  #: 0 to 1; with Ocean(foam=True)
    converged: NDArray[np.bool_]  #: the error is within the tolerance
    error: NDArray[np.float32]  #: how far horizontally from the point the sampled one is, metres

class UndisplacedSamples(TypedDict, total=False):
    """What a frame does to points of water, n of them; velocity and foam only of oceans that have them."""

    displacement: NDArray[np.float32]  #: (n, 3), metres from where each rests to where it is drawn
    velocity: NDArray[np.float32]  #: (n, 3), how fast it moves, metres a second
    foam: NDArray[np.float32]  #: (n,), how much of it is white, 0 to 1

class Hits(TypedDict):
    """Where each ray meets the water first."""

    hit: NDArray[np.bool_]
    distance: NDArray[np.float64]  #: inf without a hit
    position: NDArray[np.float64]  #: (..., 3), nan without a hit
    normal: NDArray[np.float32]  #: (..., 3), of the surface, whichever side is hit
    from_below: NDArray[np.bool_]

class Bounds:
    """Extremes of displacements, metres."""

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
    """One square of waves of a frame, which repeats over the whole sea; displacements of a frame's cascades add.

    Element [j, i] rests at x = (c i - s j) L/N, z = (s i + c j) L/N, c and s being `rotation`, L `patch_size_m` and N `resolution`. What
    is called a view is read-only memory of the ocean's; the others are copies, yours to write.
    """

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view: Dx, height, Dz in metres, and foam from 0 to 1."""
    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy, metres."""
    @property
    def dx(self) -> NDArray[np.float32]:
        """(N, N), a copy: how far horizontally the point is drawn from where it rests, metres."""
    @property
    def dz(self) -> NDArray[np.float32]:
        """As dx, along z."""
    @property
    def velocity_x(self) -> NDArray[np.float32]:
        """(N, N), a copy: the derivative of dx in time, m/s. With Ocean(velocities=True)."""
    @property
    def velocity_y(self) -> NDArray[np.float32]:
        """As velocity_x, of the height."""
    @property
    def velocity_z(self) -> NDArray[np.float32]:
        """As velocity_x, of dz."""
    @property
    def gradient(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: normal x, normal z, Jacobian, smoothness, of the cascade alone. Of a frame of one cascade, or with
        Ocean(gradients=True)."""
    def gradient_level(self, level: int) -> NDArray[np.uint8]:
        """The same of a mip level, 0 to levels - 1."""
    @property
    def slopes(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: h_x, h_z, D_xx, D_zz, each (byte - 128)/127 of slope_range, which add to other cascades'. Of a frame of
        several cascades, or with Ocean(slopes=True)."""
    def slopes_level(self, level: int) -> NDArray[np.uint8]:
        """The same of a mip level, 0 to levels - 1."""
    @property
    def moments(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: D_xz as in slopes, then the variances of h_x and h_z within a texel, byte/255 of variance_range, and
        their covariance, (byte - 128)/127 of it. Where there are slopes."""
    def moments_level(self, level: int) -> NDArray[np.uint8]:
        """The same of a mip level, 0 to levels - 1."""
    @property
    def foam(self) -> NDArray[np.uint8]:
        """(N, N), a view: 0 none to 255 covered. With Ocean(foam=True)."""
    def foam_level(self, level: int) -> NDArray[np.uint8]:
        """The same of a mip level, 0 to levels - 1."""
    @property
    def resolution(self) -> int:
        """N, texels along a side."""
    @property
    def levels(self) -> int:
        """Mip levels of gradient, slopes, moments and foam."""
    @property
    def patch_size_m(self) -> float:
        """L, after which the cascade repeats along its axes."""
    @property
    def rotation(self) -> Tuple[float, float]:
        """Cosine and sine of the turn of its axes against the world's, from +x towards +z."""
    @property
    def slope_range(self) -> float:
        """What the bytes of slopes count in."""
    @property
    def variance_range(self) -> float:
        """What the variances in moments count in."""
    @property
    def bounds(self) -> Bounds:
        """Exact."""

class DynamicWavesView:
    """The dynamic waves of a frame, whose height adds to that of the cascades where water is drawn.

    Texel (i, j) of the world stands at x = i texel_m, z = j texel_m and is element [j mod N, i mod N]; the grid has
    first_x <= i < first_x + N, and j likewise. np.roll(array, (-first_z, -first_x), (0, 1)) begins with the lowest texel. Arrays are
    views; the other values stay when the frame is over.
    """

    @property
    def height_m(self) -> NDArray[np.float32]:
        """(N, N), a view."""
    @property
    def vertical_velocity_mps(self) -> NDArray[np.float32]:
        """(N, N), a view."""
    @property
    def foam(self) -> NDArray[np.uint8]:
        """(N, N), a view: 0 none to 255 covered."""
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
    """The shore of a frame: a rectangle with a floor, where cascades are attenuated and waves that feel the floor add to them.

    Element [j, i] stands at x = x_m + i texel_m, z = z_m + j texel_m. Arrays are views; the other values stay when the frame is over.
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
        """(rows, columns), a view: depth of still water, below 0 on land."""
    @property
    def parts_rgba8(self) -> NDArray[np.uint8]:
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
        """(rows, columns), a view: foam of breaking waves, 0 none to 255 covered."""
    @property
    def height_min_m(self) -> float:
        """Lower bound of the heights."""
    @property
    def height_max_m(self) -> float:
        """Upper bound of the heights."""
    @property
    def parts_change_per_m(self) -> float:
        """Upper bound of the change of a weight over a metre."""
    @property
    def hash(self) -> int:
        """XXH3 of the arrays."""

class Frame:
    """The sea at a moment. It lasts until the second schedule() or frame_at() after its own, and then raises StaleFrame; time_s,
    sea, bounds and significant_wave_height_m stay. Any number of threads may ask it at once.
    """

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view, of the first cascade, the one with the longest waves."""
    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy, of the first cascade: of a frame of several the others' heights are not in it, query() has them all."""
    @property
    def cascades(self) -> List[Cascade]:
        """The coarsest first."""
    @property
    def time_s(self) -> float:
        """As it was asked for."""
    @property
    def bounds(self) -> Bounds:
        """Of one cascade exact, of several upper bounds."""
    @property
    def sea(self) -> Sea:
        """That there is at that time."""
    @property
    def significant_wave_height_m(self) -> float:
        """Of the waves that the cascades hold, the mean over all seeds."""
    @property
    def is_alive(self) -> bool:
        """It would not raise StaleFrame, nor is its ocean closed."""
    @property
    def dynamic_waves(self) -> DynamicWavesView:
        """Wakes, ripples and splashes. With Ocean(dynamic_waves=...)."""
    @property
    def shore(self) -> ShoreSurface:
        """Depths, weights and waves over the floor. With Ocean(shore=...)."""
    @property
    def hash(self) -> int:
        """XXH3 of all of its bits, which the command line prints in hexadecimal digits."""
    @property
    def foam_hash(self) -> int:
        """The same of foam. With Ocean(foam=True)."""
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
    ) -> Answers:
        """What the water is like at points of the world: query(points) or query(x, z).

        The surface is what is drawn: at crests water stands where it was moved to. `fields` names what is wanted, by default all
        that the ocean was made with. `interpolation` is that between texels: "linear" is the drawn surface, "cubic" keeps the heights
        and slopes of short waves, for measurements. The bits depend on the frame, the point and the options alone. Warns if the
        points span more than the longest waves, which repeat.
        """
    def rays(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike, *, tolerance_m: float = 0.001) -> Hits:
        """Where rays meet the water. Origins and directions are (..., 3), reach is in metres, a number or one a ray."""
    def displaced(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """(..., 3): drawn positions of water by its undisplaced positions, for meshes. Includes dynamic waves and a shore."""
    def displaced_foam(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """(...): foam of that water, 0 to 1. With Ocean(foam=True), dynamic waves or a shore."""
    def sample_undisplaced(self, points: ArrayLike) -> UndisplacedSamples:
        """The same and velocities in one go, for meshes of many vertices that move every frame. Points are (n, 2), within 1e9 m."""

class WaveInput:
    """Waves that are added to an ocean's cascades: a GerstnerInput or a RippleInput. It belongs to one ocean; changes take effect at
    the next schedule().
    """

class GerstnerInput(WaveInput):
    """A list of Gerstner waves, for Ocean(inputs=[...]). Each becomes the nearest wave of a cascade's grid, with whole periods in a
    loop.
    """

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
    """The dynamic waves of an ocean: its dynamic_waves. Commands take effect at the next schedule(), in the order of the calls. Equal
    times with equal commands between them give bit-identical waves. A time before the last one leaves the waves as they are, and a
    jump ahead computes half a second at most.
    """

    def add_impulse(self, disturbance: Disturbance) -> None:
        """Acts once, in the next tick. At most 4096 impulses wait for a tick."""
    def add_source(self, source: Disturbance) -> int:
        """Acts in every tick, moving at its velocity, until it is removed. Returns its number. At most 4096 sources at once."""
    def set_source(self, number: int, source: Disturbance) -> None:
        """Replaces a source. Does nothing if there is no source of that number."""
    def remove_source(self, number: int) -> None:
        """Does nothing if there is no source of that number."""
    def set_center(self, x_m: float, z_m: float) -> None:
        """Moves the grid's centre to within half a texel of the point. Texels that enter are flat."""
    def set_rain(self, rain: Rain) -> None:
        """Rain from the next tick on; 0 drops end it."""
    def save_state(self) -> bytes:
        """Returns all that ticks to come depend on, but for commands since the last schedule(). No frame may be in flight."""
    def restore_state(self, saved: bytes) -> None:
        """Continues from a saved state of waves with equal options, and drops commands since the last schedule(). No frame may be in
        flight."""

class Ocean:
    """A sea that computes frames. Use it in a `with` statement, or close() it.

    It has the memory of two frames. While an array views a frame, the second schedule() or frame_at() after that frame's raises
    BufferError instead of writing over it. Close gives the memory back, or the last view after that.
    """

    def __init__(
        self,
        sea: Sea,
        queries: bool = True,
        velocities: bool = False,
        foam: bool = False,
        gradients: bool = False,
        slopes: bool = False,
        threads: int = 0,
        isa: Optional[str] = None,
        largest_peak_m: float = 0.0,
        dynamic_waves: Optional[DynamicWavesOptions] = None,
        shore: Optional[ShoreOptions] = None,
        inputs: Iterable[WaveInput] = (),
    ) -> None:
        """
        queries     frames can be asked by query() and rays()
        velocities  frames have velocities; about twice the work
        foam        frames remember foam, which lasts for 2.9 seconds
        gradients   cascades of several have normals of their own; one cascade always has
        slopes      a frame of one cascade has slopes; those of several always have
        threads     at work on a frame, the calling one included; 0: one per core
        isa         "sse4.2", "avx2", "avx512" or "neon"; None: PELAGIC_ISA, else the strongest. All have the same bits
        largest_peak_m  cascades are laid out for waves with peaks up to this long, which a sea to come may have: its
                    report().peak_wavelength_m. 0: the first sea's
        dynamic_waves  the grid of wakes, ripples and splashes; None: no dynamic waves
        shore       a floor that waves feel; None: no shore
        inputs      waves that are added to those of the wind, in this order; they change the hash
        """
    def __enter__(self) -> Ocean: ...
    def __exit__(
        self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None: ...
    def close(self) -> None:
        """Waits for whoever reads frames, and gives the memory back. Frames of it raise ValueError from then on; arrays stay."""
    @property
    def is_closed(self) -> bool:
        """After close(), or the end of a with statement."""
    def schedule(self, time_s: float) -> None:
        """Starts the frame of that time and returns at once."""
    def is_ready(self) -> bool:
        """complete() would not wait for other threads."""
    def complete(self) -> Frame:
        """Waits for the scheduled frame, helping."""
    def frame_at(self, time_s: float) -> Frame:
        """schedule() and complete() in one."""
    def series(
        self,
        points: ArrayLike,
        times: ArrayLike,
        *,
        fields: Optional[Iterable[Field]] = None,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "cubic",
        repeats: bool = False,
    ) -> Answers:
        """What frame_at(time).query(points) has for each of n times, while other threads run: arrays of shape (n, ...), of vectors
        (n, ..., 3), for points of shape (..., 2). Frames made before are over afterwards.

        Raises ValueError if the times span more than the sea's loop, unless repeats is True. Warns as query().
        """
    def schedule_sea(self, sea: Sea, from_s: float, over_s: float, swell_from_m: float = 0.0) -> None:
        """The sea turns into another one, from a time on and over so many seconds; the same cascades, depth, loop and seed. If its swell
        was raised so many metres away, long waves come first."""
    @property
    def dynamic_waves(self) -> DynamicWaves:
        """With Ocean(dynamic_waves=...)."""
    @property
    def sea(self) -> Sea:
        """That there will be after the last change."""
    @property
    def resolution(self) -> int:
        """Texels along a side of each cascade."""
    @property
    def cascade_count(self) -> int:
        """Of every frame."""
    @property
    def threads(self) -> int:
        """Most that work on a frame, the calling one included."""
    @property
    def memory_bytes(self) -> int:
        """All that it allocated."""
    @property
    def isa(self) -> str:
        """The instruction set that computes it."""

def isas_here() -> List[str]:
    """The instruction sets that this processor runs, weakest first."""

def check_sea(sea: Sea) -> None: ...
def check_analytic_wave(wave: AnalyticWave) -> None: ...
def check_disturbance(disturbance: Disturbance) -> None: ...
def check_dynamic_waves_options(options: DynamicWavesOptions) -> None: ...
def check_rain(rain: Rain) -> None: ...
def check_ripple(ripple: Ripple) -> None: ...
def check_shore_options(options: ShoreOptions) -> None: ...
def analytic_wave_fields() -> List[Tuple[str, float, str]]: ...
def disturbance_fields() -> List[Tuple[str, float, str]]: ...
def dynamic_waves_fields() -> List[Tuple[str, float, str]]: ...
def rain_fields() -> List[Tuple[str, float, str]]: ...
def ripple_fields() -> List[Tuple[str, float, str]]: ...
def shore_fields() -> List[Tuple[str, float, str]]: ...
def sea_fields() -> List[Tuple[str, float, str]]: ...
def preset_list() -> List[Tuple[str, str, Sea]]: ...
def report(sea: Sea) -> Dict[str, Any]: ...
def model_by_frequency(sea: Sea, frequencies_hz: ArrayLike) -> NDArray[np.float64]: ...
def model_by_wave_number(sea: Sea, wave_numbers: ArrayLike) -> NDArray[np.float64]: ...
