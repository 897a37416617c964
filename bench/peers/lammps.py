"""Runs tube.lmp with LAMMPS and reads what it says."""

import os
import re
import shutil
import subprocess
from pathlib import Path

INPUT = Path(__file__).resolve().parent / "tube.lmp"


class NotInstalled(Exception):
    """A program that is needed is not there."""


def output_of(command):
    """What a program that may fail prints."""
    return subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def installed_version(program):
    """As LAMMPS calls itself, and as Debian does where it is from there."""
    own = re.search(r"Simulator - (.*)", output_of([program, "-h"]))
    debian = output_of(["dpkg-query", "-W", "-f=${Version}", "lammps"])
    return (own.group(1).strip() if own else "of unknown version") + (f", Debian package {debian}" if debian else "")


class Lammps:
    """`pinned` turns a command into one that stays on one core."""

    def __init__(self, pinned):
        self.program = os.environ.get("LMP", "lmp")
        for needed in (self.program, "mpirun", "taskset"):
            if shutil.which(needed) is None:
                raise NotInstalled(f"{needed} is not installed; on Debian, `./setup.sh peers` installs it")
        self.pinned = pinned
        self.version = installed_version(self.program)
        self.skin, self.every = 0.2e-3, 5  # until tuned

    def advance(self, start, ranks, warm_up, steps):
        """Steps the state in start["data"]: the time of the last `steps` steps, and the state after them."""
        variables = {name: start[name] for name in ("data", "gravity", "k_n", "gamma_n", "gamma_t", "mu")}
        variables |= {"dt": start["time_step"], "skin": self.skin, "every": self.every, "warm_up": warm_up, "steps": steps}
        command = [self.program, "-in", str(INPUT), "-log", "none"]
        for name, value in variables.items():
            command += ["-var", name, value if isinstance(value, str) else repr(value)]
        command = self.pinned(command) if ranks == 1 else ["mpirun", "-np", str(ranks), "--bind-to", "core", *command]
        environment = os.environ | {"OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                                    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(command, check=False, env=environment, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
        return read_answer(done.stdout, start["grains"], steps)


def read_answer(text, grains, steps):
    """What the log of a run says of its last `steps` steps."""
    seconds = float(re.findall(r"^Loop time of (\S+)", text, re.MULTILINE)[-1])
    # One row of numbers at the beginning of each run, one at its end: step, mean v_x, mean v_y, energy, contacts.
    last = [row.split() for row in text.splitlines() if re.fullmatch(r"\s*\d+(\s+[-+.e\d]+){4}\s*", row)][-1]
    dangerous = re.findall(r"^Dangerous builds = (\d+)", text, re.MULTILINE)
    return {"seconds": seconds,
            "particle_steps_per_second": grains * steps / seconds,
            "dangerous_builds": sum(map(int, dangerous)),
            "state": {"mean_vx": float(last[1]), "mean_vy": float(last[2]), "kinetic_energy": float(last[3]),
                      "contacts_of_grains": float(last[4])}}
