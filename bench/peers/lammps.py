"""Runs the tube with LAMMPS and with LIGGGHTS, which began as a copy of it: both read the same data file, and say the same."""

import re
from pathlib import Path

import numpy as np
from peer import NotInstalled, find_program, pinned, run, version_of

HERE = Path(__file__).resolve().parent


def with_ranks(count, command):
    """What `count` MPI ranks print, each on a core of its own."""
    return run(["mpirun", "-np", str(count), "--bind-to", "core", *command], OMP_NUM_THREADS="1",
               OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def require_two_cores():
    """Before anything is measured: Open MPI counts cores, of which one may look like two."""
    try:
        with_ranks(2, ["true"])
    except RuntimeError as problem:
        raise NotInstalled(f"two ranks do not start here: {problem}") from problem


class Lammps:
    """Settings are the skin (m) and the steps between two looks at the neighbour list."""
    name, law, about = "lammps", "viscous", 4e7
    least_steps = 200
    usual = {"skin": 0.2e-3, "every": 5}
    choices = {"skin": (0.0125e-3, 0.025e-3, 0.05e-3, 0.1e-3, 0.2e-3, 0.3e-3, 0.45e-3, 0.6e-3), "every": (1, 5, 10, 20, 40)}

    def __init__(self):
        self.program = find_program("lmp", "LMP", "mpirun", "taskset")
        require_two_cores()
        self.version = version_of([self.program, "-h"], r"Simulator - (.*)", "lammps")

    @staticmethod
    def density(mass, radius):
        """kg/m^3, of which it makes the mass: all are spheres."""
        return mass / (4.0 / 3.0 * np.pi * radius**3)

    def write(self, start):
        write_data(start["grains_state"], self.density, start["files"][self.name])

    def advance(self, start, settings, cores, warm_up, steps):
        variables = {name: start[name] for name in ("gravity", "k_n", "gamma_n", "gamma_t", "mu")}
        variables |= settings | {"data": start["files"][self.name], "dt": start["time_step"], "warm_up": warm_up, "steps": steps}
        command = [self.program, "-in", str(HERE / f"tube.{self.name}"), "-log", "none"]
        for name, value in variables.items():
            command += ["-var", name, value if isinstance(value, str) else repr(value)]
        return read_answer(run(pinned(command), OMP_NUM_THREADS="1") if cores == 1 else with_ranks(cores, command))


class Liggghts(Lammps):
    """The same, but for its grains in two dimensions and how it is called."""
    name, about = "liggghts", 2e7

    def __init__(self):
        self.program = find_program("liggghts", "LIGGGHTS", "mpirun", "taskset")
        require_two_cores()
        self.version = version_of([self.program, "-h"], r"Version LIGGGHTS-PUBLIC ([0-9.]+)", "liggghts")

    @staticmethod
    def density(mass, radius):
        """kg/m^2, of which it makes the mass: all are discs."""
        return mass / (np.pi * radius**2)


def write_data(state, density, path):
    """Atoms as `atom_style sphere` wants them: id, type, diameter, density, x, y, z. Free grains are atoms 1 ... N of type 1,
    the wall grains follow as type 2."""
    free, walls = len(state.radius), len(state.wall_radius)
    radius = np.concatenate([state.radius, state.wall_radius])
    mass = np.concatenate([state.mass, np.full(walls, state.mass.mean())])  # of frozen grains: of no consequence
    position = np.concatenate([state.position, state.wall_position])
    ids, zeros = np.arange(1, free + walls + 1), np.zeros(free + walls)
    margin = 2.0 * radius.max()  # across the tube, where the box ends beyond the walls
    with open(path, "w", encoding="ascii") as file:
        file.write(f"tube\n\n{free + walls} atoms\n2 atom types\n\n"
                   f"{-margin:.17g} {state.width + margin:.17g} xlo xhi\n0 {state.length:.17g} ylo yhi\n"
                   f"{-margin:.17g} {margin:.17g} zlo zhi\n\nAtoms # sphere\n\n")
        kind = np.where(ids <= free, 1, 2)
        np.savetxt(file, np.column_stack([ids, kind, 2.0 * radius, density(mass, radius), position, zeros]),
                   fmt="%d %d %.17g %.17g %.17g %.17g %g")
        file.write("\nVelocities\n\n")
        velocity = np.concatenate([state.velocity, np.zeros((walls, 2))])
        np.savetxt(file, np.column_stack([ids, velocity, zeros, zeros, zeros, zeros]), fmt="%d %.17g %.17g %g %g %g %g")


def read_answer(text):
    """What the log of a run says of its last steps."""
    # One row of numbers at the beginning of each run, one at its end: step, mean v_x, mean v_y, energy, contacts.
    rows = [row.split() for row in text.splitlines() if re.fullmatch(r"\s*\d+(\s+[-+.e\d]+){4}\s*", row)]
    if not rows:
        raise RuntimeError("lammps: told no mean velocities that are numbers")
    last = rows[-1]
    return {"seconds": float(re.findall(r"^Loop time of (\S+)", text, re.MULTILINE)[-1]),
            "too_late": sum(map(int, re.findall(r"^Dangerous builds = (\d+)", text, re.MULTILINE))),
            "state": {"mean_vx": float(last[1]), "mean_vy": float(last[2]), "kinetic_energy": float(last[3]),
                      "contacts_of_grains": float(last[4])}}
