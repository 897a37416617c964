"""Runs the tube with YADE."""

import json
import tempfile
from pathlib import Path

import numpy as np
from peer import find_program, pinned, run, version_of

INPUT = Path(__file__).resolve().parent / "tube_yade.py"


class Yade:
    """Its only setting is the skin (m), which it calls verletDist. It finds out itself when to look for neighbours, never
    too late."""
    name, law, about = "yade", "spring", 4e6
    least_steps = 500
    usual = {"skin": 0.2e-3}
    choices = {"skin": (0.0125e-3, 0.025e-3, 0.05e-3, 0.1e-3, 0.2e-3, 0.4e-3)}

    def __init__(self):
        self.program = find_program("yade", "YADE", "taskset")
        self.version = version_of([self.program, "--version"], r"Yade version: (\S+)", "yade")

    def write(self, start):
        values = {name: start[name] for name in ("time_step", "gravity", "k_n", "k_t", "gamma_n", "mu")}
        state = start["grains_state"]
        half_step_velocity = state.velocity - 0.5 * start["time_step"] * state.acceleration  # it has that of half a step before
        with open(start["files"][self.name], "wb") as file:  # given a name, numpy would add to it
            np.savez(file, **state._asdict(), **values, half_step_velocity=half_step_velocity)

    def advance(self, start, settings, cores, warm_up, steps):
        with tempfile.NamedTemporaryFile(suffix=".json") as answer:
            command = [self.program, "-n", "-x", "-j", str(cores), str(INPUT), start["files"][self.name],
                       answer.name, str(warm_up), str(steps), repr(settings["skin"])]
            said = run(pinned(command) if cores == 1 else command)
            text = Path(answer.name).read_text(encoding="utf-8")
        if not text:  # YADE ends with status 0 when its script has failed
            raise RuntimeError(f"{' '.join(command)} failed:\n{said[-2000:]}")
        return json.loads(text)
