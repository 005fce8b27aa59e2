"""Hulls, and sets of them that float in an ocean's water."""

from __future__ import annotations

import ctypes
import math
import threading
from typing import TYPE_CHECKING, Any, Optional, Tuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as c
from ._frame import Frame
from ._library import call, library, saved_by
from ._numbers import bytes_of, doubles_of, identifier_of, instance_of, invalid, number_of, number_text, numbers_of
from ._ocean import Ocean, executor_of

_XYZ = "x, y and z"
_A_BODY = "a number that add() returned"


def _triple(numbers: Any) -> Tuple[float, float, float]:
    x, y, z = numbers
    return x, y, z


def _triangles_of(given: Any, vertex_count: int) -> NDArray[np.uint32]:
    try:
        array = np.asarray(given)
    except ValueError:
        array = np.empty(0)
    if array.dtype.kind not in "iu":
        raise ValueError("triangles can't be made an array of whole numbers")
    _need_rows_of_three(array, "triangles", "the numbers of the vertices of each triangle")
    wrong = (array < 0) | (array >= vertex_count)
    if wrong.any():
        triangle = int(np.argmax(wrong.any(axis=1)))
        raise ValueError(f"triangle {triangle} of the hull has vertex {array[triangle][wrong[triangle]][0]}, expected 0 to {vertex_count - 1}")
    return np.ascontiguousarray(array, np.uint32)


def _need_rows_of_three(array: NDArray[Any], name: str, meaning: str) -> None:
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has another shape, expected (n, 3): {meaning}")


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
        radiation_text: Optional[str] = None,
        excitation_text: Optional[str] = None,
        heave_damping: float = 0.0,
        roll_damping: float = 0.05,
        pressure_coefficient: float = 0.7,
        suction_coefficient: float = 0.35,
        friction_coefficient: float = 0.004,
        air_coefficient: float = 1.0,
        water_density_kgpm3: float = 1025.0,
        air_density_kgpm3: float = 1.225,
        skeg_m2: float = 0.0,
        skeg_x_m: float = 0.0,
        skeg_y_m: float = 0.0,
    ) -> None:
        """Creates a hull from a closed mesh, wound counter-clockwise as seen from outside.

        vertices    (n, 3), in metres; vertices at equal positions are merged
        triangles   (m, 3), numbers of vertices, 4 to 4096 triangles
        mass_kg     [1e-6, 1e10]
        centre_of_mass_m  (3,), in the mesh's axes; None: the centre of its volume
        inertia_kgm2  (3,), about axes through the centre of mass; None: of an even filling
        added_mass  (6, 6), of surge, heave, sway, roll, yaw and pitch at rest; None: derived from
                    the sizes of waterline and draught
        radiation_text, excitation_text  of WAMIT's files .1 and .3, which Capytaine writes: about the
            mesh's origin at the water's surface, ULEN 1 m. Such hulls move in Bodies only
        heave_damping, roll_damping  fractions of critical damping; [0, 0.999]. Heave 0: by the
            waves that the hull's sections make
        pressure_coefficient, suction_coefficient  drag of advancing and retreating faces; [0, 10]
        friction_coefficient  [0, 1]
        air_coefficient  drag of faces above the water; [0, 10]
        water_density_kgpm3, air_density_kgpm3  [500, 2000] and [0, 10]
        skeg_m2     lateral area of a skeg, keel or fin, which keeps the course under thrust; [0, 1e4]
        skeg_x_m, skeg_y_m  its middle in the mesh's axes; [-1000, 1000]
        """
        numbers = {"mass_kg": mass_kg, "heave_damping": heave_damping, "roll_damping": roll_damping, "pressure_coefficient": pressure_coefficient,
                   "suction_coefficient": suction_coefficient, "friction_coefficient": friction_coefficient, "air_coefficient": air_coefficient,
                   "water_density_kgpm3": water_density_kgpm3, "air_density_kgpm3": air_density_kgpm3, "skeg_m2": skeg_m2, "skeg_x_m": skeg_x_m,
                   "skeg_y_m": skeg_y_m}
        options = c.sized(c.pelagic_hull_options, **{name: number_of(value, name) for name, value in numbers.items()})
        kept = {}
        if centre_of_mass_m is not None:
            kept["centre_of_mass_m"] = np.array(numbers_of(centre_of_mass_m, "centre_of_mass_m", 3, _XYZ))
        if inertia_kgm2 is not None:
            kept["inertia_kgm2"] = np.array(numbers_of(inertia_kgm2, "inertia_kgm2", 3, _XYZ))
        if added_mass is not None:
            kept["added_mass"] = np.ascontiguousarray(doubles_of(added_mass, "added_mass"))
            if kept["added_mass"].shape != (6, 6):
                raise ValueError("added_mass has another shape, expected (6, 6)")
        for name, array in kept.items():
            setattr(options, name, array.ctypes.data)
        for name, text in (("radiation_text", radiation_text), ("excitation_text", excitation_text)):
            if text is not None:
                setattr(options, name, text.encode())
        positions = np.ascontiguousarray(doubles_of(vertices, "vertices"))
        _need_rows_of_three(positions, "vertices", "x, y and z of each vertex")
        corners = _triangles_of(triangles, len(positions))
        mesh = c.sized(c.pelagic_hull_mesh, vertex_count=len(positions), vertices_m=positions.ctypes.data, triangle_count=len(corners),
                       triangles=corners.ctypes.data)
        self._handle = ctypes.c_void_p()
        call(library.pelagic_hull_create, mesh, options, ctypes.byref(self._handle))
        self._info = c.sized(c.pelagic_hull_info)
        call(library.pelagic_hull_describe, self._handle, self._info)

    def __del__(self, destroy: Any = library.pelagic_hull_destroy) -> None:
        if "_handle" in vars(self):
            destroy(self._handle)

    @property
    def volume_m3(self) -> float:
        """The volume of the mesh."""
        return float(self._info.volume_m3)

    @property
    def centre_m(self) -> Tuple[float, float, float]:
        """The centre of the volume, in the mesh's axes."""
        return _triple(self._info.centre_m)

    @property
    def mass_kg(self) -> float:
        """The mass."""
        return float(self._info.mass_kg)

    @property
    def centre_of_mass_m(self) -> Tuple[float, float, float]:
        """The centre of mass, in the mesh's axes."""
        return _triple(self._info.centre_of_mass_m)

    @property
    def floats(self) -> bool:
        """False if it is heavier than its volume of water."""
        return bool(self._info.floats)

    @property
    def draught_m(self) -> float:
        """The depth of the lowest vertex."""
        return float(self._info.draught_m)

    @property
    def height_m(self) -> float:
        """The height of the centre of mass above the water."""
        return float(self._info.height_m)

    @property
    def waterplane_m2(self) -> float:
        """The area of the section at the water's surface."""
        return float(self._info.waterplane_m2)

    @property
    def roll_gm_m(self) -> float:
        """The metacentric height of roll."""
        return float(self._info.roll_gm_m)

    @property
    def pitch_gm_m(self) -> float:
        """The metacentric height of pitch."""
        return float(self._info.pitch_gm_m)

    @property
    def digest(self) -> int:
        """A 64-bit hash of mesh, mass and coefficients: equal hulls move bit-identically."""
        return int(self._info.digest)

    def at_rest(self, x_m: float, z_m: float, heading_rad: float = 0.0) -> HullState:
        """Returns the state of the hull upright at rest in still water, with its x axis rotated
        from +x towards +z by the heading."""
        state = c.sized(c.pelagic_hull_state)
        call(library.pelagic_hull_at_rest, self._handle, number_of(x_m, "x_m"), number_of(z_m, "z_m"), number_of(heading_rad, "heading_rad"), state)
        return HullState._of(state)


class HullState:
    """A rigid body in world axes, and what the water's forces depend on of the step before. A copy:
    Bodies.set_state() applies changes."""

    def __init__(self) -> None:
        raise TypeError("HullState cannot be created: use Hull.at_rest() or Bodies.state()")

    @classmethod
    def _of(cls, struct: Any) -> HullState:
        state = object.__new__(cls)
        state._struct = struct
        return state

    _struct: Any

    def _set(self, name: str, value: Any, largest: float) -> None:
        numbers = numbers_of(value, name, 3, _XYZ)
        if not all(abs(number) <= largest for number in numbers):
            raise ValueError(f"the hull's {name} is out of range [-{largest:.0e}, {largest:.0e}]".replace("e+0", "e"))
        setattr(self._struct, name, type(getattr(self._struct, name))(*numbers))

    @property
    def position_m(self) -> Tuple[float, float, float]:
        """Position of the centre of mass."""
        return _triple(self._struct.position_m)

    @position_m.setter
    def position_m(self, value: Tuple[float, float, float]) -> None:
        self._set("position_m", value, 1e8)

    @property
    def orientation(self) -> Tuple[float, float, float, float]:
        """Unit quaternion x, y, z, w: world from hull."""
        x, y, z, w = self._struct.orientation
        return x, y, z, w

    @orientation.setter
    def orientation(self, value: Tuple[float, float, float, float]) -> None:
        numbers = numbers_of(value, "orientation", 4, "x, y, z and w")
        if not abs(sum(number * number for number in numbers) - 1) < 1e-3:
            raise ValueError("the hull's orientation is not a unit quaternion")
        self._struct.orientation = type(self._struct.orientation)(*numbers)

    @property
    def velocity_mps(self) -> Tuple[float, float, float]:
        """Velocity of the centre of mass."""
        return _triple(self._struct.velocity_mps)

    @velocity_mps.setter
    def velocity_mps(self, value: Tuple[float, float, float]) -> None:
        self._set("velocity_mps", value, 1e4)

    @property
    def angular_velocity_radps(self) -> Tuple[float, float, float]:
        """Angular velocity, in world axes."""
        return _triple(self._struct.angular_velocity_radps)

    @angular_velocity_radps.setter
    def angular_velocity_radps(self, value: Tuple[float, float, float]) -> None:
        self._set("angular_velocity_radps", value, 1e4)


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

        ocean       needs queries and depth, and for wakes dynamic_waves
        wakes       bodies press on the dynamic waves
        threads     maximum threads of a step, including the calling thread; 0: one per core
        """
        instance_of(Ocean, ocean, "ocean")
        ocean._need_open()
        if not ocean._has_depth:
            raise ValueError("the ocean has no depth: create it with depth=True")
        if wakes and not ocean._has_dynamic_waves:
            raise ValueError("the ocean has no dynamic waves: create it with dynamic_waves=pelagic.DynamicWavesOptions()")
        self._ocean, self._wakes = ocean, bool(wakes)
        self._lock = threading.Lock()  # taken before the ocean's
        handle, executor = ctypes.c_void_p(), executor_of(threads)
        try:
            with ocean._turn:
                ocean._need_open()
                call(library.pelagic_bodies_create, ocean._handle, c.sized(c.pelagic_bodies_options, wakes=self._wakes, executor=executor),
                     ctypes.byref(handle))
        finally:
            library.pelagic_executor_destroy(executor)
        self._handle = handle

    def __del__(self) -> None:
        if "_handle" in vars(self):
            self._ocean._left.append(self._handle)

    def _call(self, function: Any, *arguments: Any) -> None:
        """Calls a function that reads the frame completed last."""
        with self._lock:
            newest = self._ocean._newest
            self._ocean._enter(newest)
            try:
                call(function, self._handle, *arguments)
            finally:
                self._ocean._leave(newest)

    def _command(self, function: Any, *arguments: Any) -> None:
        """Calls a function that enqueues commands for the waves."""
        if not self._wakes:
            return self._call(function, *arguments)
        with self._lock, self._ocean._turn:
            self._ocean._need_open()
            call(function, self._handle, *arguments)

    def _need_frame(self, frame: Frame) -> None:
        instance_of(Frame, frame, "frame")
        if frame._ocean is not self._ocean:
            raise ValueError("the frame is one of another ocean than the bodies'")
        frame._need_alive()
        if frame._number != self._ocean._newest:
            raise ValueError("the frame is not the one completed last, in whose water the bodies move")

    def add(self, hull: Hull, state: HullState) -> int:
        """Adds a body without inputs. Returns its number, which is never reused."""
        number = ctypes.c_uint32()
        self._command(library.pelagic_bodies_add, instance_of(Hull, hull, "hull")._handle, instance_of(HullState, state, "state")._struct,
                      ctypes.byref(number))
        return number.value

    def remove(self, number: int) -> None:
        """Does nothing if there is no body of that number."""
        self._command(library.pelagic_bodies_remove, identifier_of(number, _A_BODY))

    def set_inputs(
        self,
        number: int,
        force_n: ArrayLike = (0.0, 0.0, 0.0),
        torque_nm: ArrayLike = (0.0, 0.0, 0.0),
        wind_mps: ArrayLike = (0.0, 0.0, 0.0),
    ) -> None:
        """Sets what else acts on a body from now on: engines, tow lines and contacts, about the
        centre of mass in world axes, and the wind."""
        number = identifier_of(number, _A_BODY)
        inputs = c.sized(c.pelagic_hull_inputs)
        inputs.force.force_n[:] = numbers_of(force_n, "force_n", 3, _XYZ)
        inputs.force.torque_nm[:] = numbers_of(torque_nm, "torque_nm", 3, _XYZ)
        inputs.wind_mps[:] = numbers_of(wind_mps, "wind_mps", 3, _XYZ)
        self._call(library.pelagic_bodies_set_inputs, number, inputs)

    def state(self, number: int) -> HullState:
        """Returns a copy of a body's state."""
        state = c.sized(c.pelagic_hull_state)
        self._call(library.pelagic_bodies_get_state, identifier_of(number, _A_BODY), state)
        return HullState._of(state)

    def set_state(self, number: int, state: HullState) -> None:
        """Replaces a body's state."""
        self._call(library.pelagic_bodies_set_state, identifier_of(number, _A_BODY), instance_of(HullState, state, "state")._struct)

    def loads(self, number: int) -> HullLoads:
        """Returns the loads of a body in the last step."""
        loads = c.sized(c.pelagic_hull_loads)
        self._call(library.pelagic_bodies_get_loads, identifier_of(number, _A_BODY), loads)
        result: Any = {}
        for name in ("total", "pressure", "added_mass", "drag", "slamming"):
            force = getattr(loads, name)
            result[f"{name}_force_n"], result[f"{name}_torque_nm"] = _triple(force.force_n), _triple(force.torque_nm)
        result.update(displaced_m3=loads.displaced_m3, submersion=loads.submersion, water_height_m=loads.water_height_m,
                      water_slope=(loads.water_slope_x, loads.water_slope_z), water_velocity_mps=_triple(loads.water_velocity_mps))
        return result  # type: ignore[no-any-return]

    def shift(self, x_m: float, z_m: float) -> None:
        """Moves all bodies and their wakes, after a shift of the world's origin
        (Ocean.set_origin()) by (-x_m, -z_m). Call it when the first frame with the new origin is
        complete, before that frame's press() and step()."""
        self._call(library.pelagic_bodies_shift, number_of(x_m, "x_m"), number_of(z_m, "z_m"))

    def press(self, frame: Frame, tick_s: float) -> None:
        """Moves the pressures of wakes to the bodies. Call it once a frame, between complete() and
        schedule(); tick_s is the time since the last call. Does nothing without wakes."""
        self._need_frame(frame)
        tick = number_of(tick_s, "tick_s")
        if not (tick >= 0 and math.isfinite(tick)):
            raise ValueError(invalid("tick_s", number_text(tick), "[0, inf) s"))
        if not self._wakes:
            return
        with self._lock, self._ocean._turn:
            self._ocean._need_no_frame_in_flight()
            call(library.pelagic_bodies_press, self._handle, tick)

    def step(self, frame: Frame, step_s: float) -> bool:
        """Advances all bodies by a step in the water of the frame completed last. More than 0.1 s is
        divided into equal steps. More than 1 s counts as 1 s, and the result is False then. Other
        threads run meanwhile. Results do not depend on the number of threads."""
        self._need_frame(frame)
        are_all = ctypes.c_int32()
        self._call(library.pelagic_bodies_step, number_of(step_s, "step_s"), ctypes.byref(are_all))
        return bool(are_all.value)

    def save_state(self) -> bytes:
        """Returns everything that later steps depend on. Call it like DynamicWaves.save_state(),
        before the first command of a tick."""
        with self._lock:
            newest = self._ocean._newest
            self._ocean._enter(newest)
            try:
                return saved_by(library.pelagic_bodies_save_state, self._handle)
            finally:
                self._ocean._leave(newest)

    def restore_state(self, saved: bytes) -> None:
        """Continues from a saved state, whose hulls were added to this set. With wakes, restore the
        dynamic waves first. A frame of the saved time shows its water again."""
        saved = bytes_of(saved, "save_state")
        self._call(library.pelagic_bodies_restore_state, saved, len(saved))
