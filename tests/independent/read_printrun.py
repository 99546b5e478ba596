# What printrun reads of a G-code file, as JSON: filament [mm], box of the layers' beads, heights of the beads, time [s].
import json
import logging
import sys

logging.disable(logging.WARNING)
from printrun import gcoder  # noqa: E402

with open(sys.argv[1]) as file:
    read = gcoder.GCode(file)
# The start block's purge lies beside the plate.
first = next(k for k, line in enumerate(read.lines) if line.raw.startswith(";LAYER_CHANGE"))
# What a start block of others purges is theirs; ours begins behind it, with the speed set back.
own = max(k for k, line in enumerate(read.lines[:first]) if line.raw == "M220 S100")
block = gcoder.GCode([line.raw for line in read.lines[:own]]).filament_length
beads = [line for line in read.lines[first:] if line.extruding and (line.x is not None or line.y is not None)]
xs, ys = [line.current_x for line in beads], [line.current_y for line in beads]

print(json.dumps({
    "filament": read.filament_length - block,
    "box": [min(xs), min(ys), max(xs), max(ys)],
    "heights": sorted({line.current_z for line in beads}),
    "seconds": read.duration.total_seconds(),
}))
