"""Run by pvpython: prints what ParaView finds in a trajectory, in JSON."""

import json
import sys

from paraview import servermanager
from paraview.simple import OpenDataFile
from vtkmodules.util.numpy_support import vtk_to_numpy

reader = OpenDataFile(sys.argv[1])
times = list(reader.TimestepValues)
found = {"times": times, "frames": []}
for time in times:
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    frame = {}
    for number in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(number)
        name = data.GetMetaData(number).Get(data.NAME()).split("[")[0]
        arrays = block.GetPointData()
        frame[name] = {"position": vtk_to_numpy(block.GetPoints().GetData()).tolist()}
        for i in range(arrays.GetNumberOfArrays()):
            frame[name][arrays.GetArrayName(i)] = vtk_to_numpy(arrays.GetArray(i)).tolist()
    found["frames"].append(frame)
print(json.dumps(found))
