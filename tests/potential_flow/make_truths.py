#!/usr/bin/env python3
"""Computes the coefficients, wave forces and responses of floating bodies by the boundary element method, for tests of
hulls, and writes them beside itself: one CSV file for each body, and WAMIT's files .1 and .3 of a hemisphere.

usage: make_truths.py [BODY...]        needs Capytaine 3.0 (pip install capytaine==3.0.0)

Capytaine solves linear potential flow by panels: M. Ancellin and F. Dias, "Capytaine: a Python-based linear potential
flow solver", Journal of Open Source Software 4 (36), 2019. The water is deep. Waves of 1 m travel towards +x, or
towards -x for the dinghy (head seas).

Columns are in SI units and in Pelagic's axes, x forward, y up, z starboard, about the centre of mass. Modes are
numbered from 1: surge, heave, sway, roll, yaw, pitch. Complex forces and motions are factors of exp(i omega t); the
elevation at the centre of mass is cos(omega t). Motions are those of the coupled equations without viscous losses.
Sway, roll and yaw are given at zero and infinite frequency only. maccamy_fuchs_force is the surge force on a cylinder
from the sea bed to the surface, integrated to the draught (R. C. MacCamy and R. A. Fuchs, Beach Erosion Board TM 69,
1954).
"""
import csv
import math
import pathlib
import sys

import capytaine as cpt
import capytaine.io.wamit
import numpy as np
import scipy.special

DENSITY, GRAVITY = 1025.0, 9.80665
FOLDER = pathlib.Path(__file__).parent


def grid(f, count_u, count_v):
    """Faces of the surface f(u, v) in the unit square; wound for du x dv to point out of the body."""
    faces = []
    for i in range(count_u):
        for j in range(count_v):
            u, v = (i / count_u, (i + 1) / count_u), (j / count_v, (j + 1) / count_v)
            faces.append([f(u[0], v[0]), f(u[1], v[0]), f(u[1], v[1]), f(u[0], v[1])])
    return faces


def cosine(t):
    """Clusters points at both ends of [0, 1]: edges need small panels."""
    return (1 - math.cos(math.pi * t)) / 2


def hemisphere():
    def f(u, v):
        a, b = 2 * math.pi * u, math.pi / 2 * v
        return [math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), -math.sin(b)]
    return [face[::-1] for face in grid(f, 40, 14)]


def cylinder(radius, draught, around=32, down=24):
    def side(u, v):
        a = 2 * math.pi * u
        return [radius * math.cos(a), radius * math.sin(a), -draught * cosine(v)]
    def bottom(u, v):
        a, r = 2 * math.pi * u, radius * math.cos(math.pi / 2 * v)
        return [r * math.cos(a), r * math.sin(a), -draught]
    return [face[::-1] for face in grid(side, around, down) + grid(bottom, around, 8)]


def box(length, beam, draught, counts):
    nx, ny, nz = counts
    x, y = (lambda t: length * (cosine(t) - 0.5)), (lambda t: beam * (cosine(t) - 0.5))
    z = lambda t: -draught * cosine(t)
    faces = grid(lambda u, v: [x(u), y(v), -draught], nx, ny)
    for side in (-1, 1):
        faces += grid(lambda u, v: [x(u), side * beam / 2, z(v)], nx, nz)
        faces += grid(lambda u, v: [side * length / 2, y(u), z(v)], ny, nz)
    return outward(faces, np.array([0, 0, -draught / 2]))


def boat(length, beam, height, keel_z, parts=4):
    """examples/boat/boat_mesh.hpp, below the water, with the keel at z = keel_z."""
    ring_y, ring_z = (0, 0.4, 1, 1.05, 1, 0.4), (0, 0.75, 1, 0, -1, -0.75)
    def vertex(i, j):
        along = i / 10
        half_beam = beam / 2 * (1 - 0.8 * along * along)
        return np.array([length * (along - 0.5), -half_beam * ring_z[j], height * ring_y[j] + keel_z])
    triangles = []
    for i in range(10):
        for j in range(6):
            a, b, c, d = vertex(i, j), vertex(i, (j + 1) % 6), vertex(i + 1, j), vertex(i + 1, (j + 1) % 6)
            triangles += [(a, c, b), (b, c, d)]
    for j in range(1, 5):
        triangles += [(vertex(0, 0), vertex(0, j), vertex(0, j + 1)), (vertex(10, 0), vertex(10, j + 1), vertex(10, j))]
    faces = []
    for a, b, c in triangles:
        at = lambda i, j: list(a + (b - a) * i / parts + (c - a) * j / parts)
        for i in range(parts):
            for j in range(parts - i):
                faces.append([at(i, j), at(i + 1, j), at(i, j + 1)])
                if i + j + 2 <= parts:
                    faces.append([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
    return faces


def outward(faces, inside):
    """Winds the faces of a convex body counter-clockwise as seen from outside."""
    result = []
    for face in faces:
        a, b, c, d = (np.array(p) for p in face)
        is_outward = np.cross(c - a, d - b) @ ((a + c) / 2 - inside) > 0
        result.append(face if is_outward else face[::-1])
    return result


def mesh_of(faces):
    vertices, indices = [], []
    for face in faces:
        indices.append([len(vertices) + i for i in (0, 1, 2, min(3, len(face) - 1))])
        vertices += face
    return cpt.Mesh(vertices=np.array(vertices, dtype=float), faces=np.array(indices))


def of_lengths(*wavelengths):
    return [2 * math.pi / wavelength for wavelength in wavelengths]


BOAT = dict(length=4, beam=1.7, height=0.8)
# Hull::afloat() of boat_mesh(4, 1.7, 0.8) and 350 kg, and the mesh's centre; the radius of gyration is that of
# an evenly filled mesh.
BODIES = {
    "hemisphere": lambda: dict(
        faces=hemisphere(), radius_of_gyration=0.5,
        wave_numbers=[0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 4]),
    "spar": lambda: dict(
        faces=cylinder(2, 20), centre_z=-12, radius_of_gyration=7, cylinder=(2, 20),
        wave_numbers=of_lengths(400, 300, 250, 200, 170, 150, 130, 115, 100, 90, 80, 70, 60, 50, 40, 30, 20, 12, 8)),
    "barge": lambda: dict(
        faces=box(100, 20, 6, (40, 14, 7)), radius_of_gyration=math.sqrt((100 ** 2 + 12 ** 2) / 12),
        wave_numbers=of_lengths(800, 500, 400, 300, 250, 200, 170, 150, 130, 115, 100, 90, 80, 70, 60, 50, 40)),
    "dinghy": lambda: dict(
        faces=boat(**BOAT, keel_z=DINGHY_KEEL_Z), centre_x=DINGHY_CENTRE[0], centre_z=DINGHY_CENTRE[1],
        radius_of_gyration=DINGHY_RADIUS, towards=math.pi,
        wave_numbers=of_lengths(48, 32, 24, 20, 16, 14, 12, 10, 8.8, 8, 7, 6, 5, 4, 3.2, 2.4, 2)),
}
DINGHY_KEEL_Z, DINGHY_CENTRE, DINGHY_RADIUS = -0.25, (-0.5, 0.2), 1.0  # set by place_dinghy()


def volume_moments(faces):
    """Volume, centre and the integral of (x^2 + z^2) of a closed surface, from triangles and the origin."""
    volume, centre, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for face in faces:
        p = [np.array(v) for v in face]
        for k in range(1, len(p) - 1):
            a, b, c = p[0], p[k], p[k + 1]
            six, total = a @ np.cross(b, c), a + b + c
            volume += six / 6
            centre += six / 24 * total
            second += six / 120 * (np.outer(a, a) + np.outer(b, b) + np.outer(c, c) + np.outer(total, total))
    return volume, centre / volume, second


def place_dinghy(mass_kg=350):
    """Finds the draught of the boat by bisection."""
    global DINGHY_KEEL_Z, DINGHY_CENTRE, DINGHY_RADIUS
    volume, centre, second = volume_moments(boat(**BOAT, keel_z=0, parts=1))
    second -= volume * np.outer(centre, centre)
    low, high = 0.0, BOAT["height"]
    for _ in range(40):
        middle = (low + high) / 2
        mesh = mesh_of(boat(**BOAT, keel_z=-middle, parts=1))
        displaced = cpt.FloatingBody(mesh=mesh).immersed_part().volume
        low, high = (low, middle) if displaced * DENSITY > mass_kg else (middle, high)
    DINGHY_KEEL_Z, DINGHY_CENTRE = -high, (centre[0], centre[2] - high)
    DINGHY_RADIUS = math.sqrt((second[0, 0] + second[2, 2]) / volume)
    print("dinghy: draught", high, "centre", DINGHY_CENTRE, "radius of gyration", DINGHY_RADIUS)


def conjugate_ours(vector):
    """To exp(i omega t), and from pitch about port to pitch about starboard."""
    return np.conj(vector) * np.array([1, 1, -1])


MODES = ["Surge", "Heave", "Pitch"]


def floating(name, body):
    centre = (body.get("centre_x", 0.0), 0.0, body.get("centre_z", 0.0))
    mesh = mesh_of(body["faces"]).immersed_part()
    return cpt.FloatingBody(mesh=mesh, lid_mesh=mesh.generate_lid(z=0.0), center_of_mass=centre, name=name,
                            dofs=cpt.rigid_body_dofs(rotation_center=centre))


def radiated(solver, mode, common):
    return solver.solve(cpt.RadiationProblem(radiating_dof=mode, **common), keep_details=False)


def truths(name, body):
    floater = floating(name, body)
    towards = body.get("towards", 0.0)
    solver = cpt.BEMSolver()
    volume = floater.volume
    mass = DENSITY * volume
    stiffness = floater.compute_hydrostatic_stiffness(rho=DENSITY, g=GRAVITY)
    c = np.array([[float(stiffness.sel(influenced_dof=i, radiating_dof=j)) for j in MODES] for i in MODES])
    m = np.diag([mass, mass, mass * body["radius_of_gyration"] ** 2])
    turn = np.diag([1, 1, -1])
    print(f"{name}: {floater.mesh.nb_faces} panels, {volume:.5f} m^3, GM {c[2, 2] / mass / GRAVITY:.4f} m", flush=True)
    rows = []
    for k in [math.inf, 0.0] + list(body["wave_numbers"]):
        common = dict(body=floater, wavenumber=k, water_depth=math.inf, rho=DENSITY, g=GRAVITY)
        results = {mode: radiated(solver, mode, common) for mode in MODES}
        a = turn @ np.array([[results[j].added_masses[i] for j in MODES] for i in MODES]) @ turn
        b = turn @ np.array([[results[j].radiation_dampings[i] for j in MODES] for i in MODES]) @ turn
        row = dict(wave_number_radpm=k)
        limit = not 0 < k < math.inf
        omega = math.sqrt(GRAVITY * k)
        x = motion = np.zeros(3, dtype=complex)
        if not limit:
            done = solver.solve(cpt.DiffractionProblem(wave_direction=towards, **common), keep_details=False)
            fk = cpt.bem.airy_waves.froude_krylov_force(cpt.DiffractionProblem(wave_direction=towards, **common))
            # the wave's phase is that of the origin: move it to the centre of mass
            phase = np.exp(-1j * k * math.cos(towards) * body.get("centre_x", 0.0))
            x = conjugate_ours(np.array([done.forces[i] + fk[i] for i in MODES]) * phase)
            motion = np.linalg.solve(-omega ** 2 * (m + a) + 1j * omega * b + turn @ c @ turn, x)
        for i, j in ((0, 0), (1, 1), (2, 2), (0, 2), (1, 2)):
            pair = f"{(1, 2, 6)[i]}{(1, 2, 6)[j]}"
            row["a" + pair], row["b" + pair] = (a[i, j] + a[j, i]) / 2, 0.0 if limit else (b[i, j] + b[j, i]) / 2
        for i, mode in enumerate(("surge", "heave", "pitch")):
            row[f"{mode}_force_re"], row[f"{mode}_force_im"] = x[i].real, x[i].imag
        for i, mode in enumerate(("surge", "heave", "pitch")):
            row[f"{mode}_re"], row[f"{mode}_im"] = motion[i].real, motion[i].imag
        sideways = sideways_masses(solver, common) if limit else np.zeros((3, 3))
        for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2)):
            row[f"a{i + 3}{j + 3}"] = sideways[i, j]
        if "cylinder" in body:
            row["maccamy_fuchs_force"] = 0.0 if limit else maccamy_fuchs(k, *body["cylinder"])
        rows.append(row)
    with open(FOLDER / f"{name}.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(rows[0])
        for row in rows:
            writer.writerow([text_of(value, 1e-7 * (mass if key[0] in "ab" or "force" in key else 1))
                             for key, value in row.items()])


def text_of(value, noise):
    return "inf" if value == math.inf else f"{0.0 if abs(value) < noise else value:.6g}"


def sideways_masses(solver, common):
    """Added mass of sway, roll and yaw; from port and up to up and starboard: sway changes its sign."""
    modes, turn = ["Sway", "Roll", "Yaw"], np.diag([-1, 1, 1])
    results = [radiated(solver, mode, common).added_masses for mode in modes]
    a = np.array([[result[mode] for mode in modes] for result in results])
    return turn @ (a + a.T) / 2 @ turn


def maccamy_fuchs(k, radius, draught):
    slope = scipy.special.h1vp(1, k * radius)
    return 4 * DENSITY * GRAVITY * (1 - math.exp(-k * draught)) / (k * k * abs(slope))


def wamit(name, body):
    """Writes WAMIT's files with all modes, as functions of the period; zeros by symmetry are left out."""
    floater = floating(name, body)
    omegas = [0, *(0.3 * i for i in range(1, 27)), math.inf]
    common = dict(body=floater, water_depth=math.inf, rho=DENSITY, g=GRAVITY)
    problems = [cpt.RadiationProblem(radiating_dof=mode, omega=omega, **common)
                for omega in omegas for mode in floater.dofs]
    problems += [cpt.DiffractionProblem(wave_direction=math.radians(heading), omega=omega, **common)
                 for omega in omegas[1:-1] for heading in (0, 90, 180, 270)]
    results = cpt.BEMSolver().solve_all(problems, keep_details=False, progress_bar=False)
    data = cpt.assemble_dataset(results)
    capytaine.io.wamit.export_to_wamit(data, str(FOLDER / name), exports=("1", "3"))
    path = FOLDER / f"{name}.1"
    lines = [line.split() for line in path.read_text().splitlines()]
    kept = [line for line in lines if line[1] == line[2] or max(abs(float(value)) for value in line[3:]) > 1e-5]
    path.write_text("".join(" ".join(line) + "\n" for line in kept))
    path = FOLDER / f"{name}.3"
    path.write_text("".join(" ".join(line.split()) + "\n" for line in path.read_text().splitlines()))


if __name__ == "__main__":
    cpt.set_logging("ERROR")
    place_dinghy()
    for name in sys.argv[1:] or BODIES:
        truths(name, BODIES[name]())
        if name == "hemisphere":
            wamit(name, BODIES[name]())
