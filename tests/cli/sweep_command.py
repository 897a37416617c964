"""What tests of sweeps share: small sweeps of a small tube, and how to run and read them."""

import csv
import json

from riesel_command import SMALL_TUBE, CommandTest

GRID = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes:
  - contact.restitution: [0.7, 0.9]
    contact.friction: {from: 0.1, to: 0.4, points: 2, spacing: log}
branches:
  slow: {start.axial_velocity: 1 m/s}
  fast: {start.axial_velocity: 8 m/s}
seeds: [1, 5]
"""

CHAIN = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes:
  contact.restitution: [0.7, 0.8, 0.9]
continue_along: contact.restitution
"""

ONE_POINT = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes: {contact.stiffness: [2000 N/m]}
"""

# The second point has contacts so soft that grains go through the walls.
ONE_FAILS = """\
base: tube.yaml
set: {run.duration: 4 ms}
axes: {contact.stiffness: [2000 N/m, 0.5 N/m, 1000 N/m]}
"""


class SweepTest(CommandTest):

    def setUp(self):
        super().setUp()
        self.write("tube.yaml", SMALL_TUBE)

    def arguments_for(self, text, out="out", *options):
        self.write("sweep.yaml", text)
        return ["sweep", "sweep.yaml", "--out", out, *options]

    def sweep(self, text, out="out", *options):
        return self.riesel(*self.arguments_for(text, out, *options))

    def sweep_to_end(self, text, out="out", *options):
        self.assert_done(self.sweep(text, out, *options))
        return self.home / out

    def manifest(self, out="out"):
        return json.loads((self.home / out / "manifest.json").read_text(encoding="utf-8"))

    def points(self, out="out"):
        return self.manifest(out)["points"]

    def rows(self, out="out"):
        with open(self.home / out / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def hashes(self, out="out"):
        """{name of the point: state hash}"""
        hashes = {row["point"]: row["state_hash"] for row in self.rows(out)}
        self.assertNotIn("", hashes.values())
        return hashes
