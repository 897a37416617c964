"""Reads what riesel writes: the directory of a run, and that of a sweep.

    import riesel
    run = riesel.Run("runs/e09")
    run.summary["state"], run.estimate("mean_axial_velocity")
    run.series["time"], run.series["mean_vy"]

Everything is in SI units, names are those of docs/files.md, and arrays are numpy's. Nothing is
written, and nothing is read before it is asked for.
"""

from .estimate import Estimate, mean_of
from .files import NotThere, Unreadable
from .run import FinalState, Finding, Histogram, Run, Validity
from .sweep import Mean, MeanProfiles, Point, Sweep
from .table import Table
from .trajectory import Frame, Trajectory
from .tree import Tree

__all__ = ["Estimate", "FinalState", "Finding", "Frame", "Histogram", "Mean", "MeanProfiles",
           "NotThere", "Point", "Run", "Sweep", "Table", "Trajectory", "Tree", "Unreadable",
           "Validity", "mean_of"]
