# What printrun reads of a G-code file, as JSON: filament [mm], box of the beads, heights, time [s].
import json
import logging
import sys

logging.disable(logging.WARNING)
from printrun import gcoder  # noqa: E402

with open(sys.argv[1]) as file:
    read = gcoder.GCode(file)
print(json.dumps({
    "filament": read.filament_length,
    "box": [read.xmin, read.ymin, read.xmax, read.ymax],
    "heights": sorted(read.all_zs),
    "seconds": read.duration.total_seconds(),
}))
