"""What the codes beside which riesel is measured have in common.

A peer is an object with

    name, version        texts; "lammps 2" is LAMMPS on two cores
    law                  the contact law that it shares with riesel: a key of LAWS in run.py
    about                particle-steps/s on one core, roughly: how long a first try may be
    least_steps          fewer tell little, as neighbours are looked for now and then
    usual, choices       its settings, and for each that is tuned what is tried, one after the other
    write(start)         writes start["grains_state"] as the peer reads it, into start["files"][name]
    advance(start, settings, cores, warm_up, steps)
                         steps it: {"seconds" of the last `steps` steps, "too_late": how often neighbours were looked for too
                         late, "state" after them}; Failed if it cannot

`start` is what `speed state` says of a state, besides "grains_state" (State) and "files".
"""

import os
import re
import shutil
import subprocess
import tempfile


class NotInstalled(Exception):
    """A program that is needed is not there."""


class Failed(RuntimeError):
    """A program has failed."""


def find_program(name, variable, *others):
    """The path of the program that the environment's `variable` names, or else `name`; it needs `others`, too."""
    program = os.environ.get(variable, name)
    for needed in (program, *others):
        if shutil.which(needed) is None:
            raise NotInstalled(f"{needed} is not installed; on Debian, `./setup.sh peers` installs it")
    return os.path.abspath(shutil.which(program))


def output_of(command):
    """What a program prints that may fail, and may write files where it is."""
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run(command, check=False, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True).stdout


def version_of(command, pattern, package):
    """As the program calls itself when it is asked by this command, and as Debian does where it is from there."""
    own = re.search(pattern, output_of(command))
    debian = output_of(["dpkg-query", "-W", "-f=${Version}", package])
    return (own[1].strip() if own else "of unknown version") + (f", Debian package {debian}" if debian else "")


def pinned(command):
    """On one core, so that nothing moves it about: the first that this process may use."""
    return ["taskset", "-c", str(min(os.sched_getaffinity(0))), *command]


def run(command, **environment):
    """What a program prints that must not fail."""
    done = subprocess.run(command, check=False, env=os.environ | environment, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)} failed:\n{done.stdout[-2000:]}")
    return done.stdout


def riesel_name(variant, law):
    """Of a row of riesel: all rows of one case and size have names of their own."""
    return f"riesel {variant}" + ("" if law == "viscous" else f", {law}")
