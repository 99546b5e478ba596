# A Bambu P1S's file as its slicer writes it, without that slicer: start and end block of the machine's own profile, which
# the Python package bambox carries, filled in; around them the marks of Bambu Studio and one square bead on each layer.
# Usage: bambu_donor.py OUT.gcode
import sys

from bambox.settings import build_project_settings
from bambox.templates import orca_to_jinja2
from jinja2 import Environment, Undefined


class Nothing(Undefined):
    def __str__(self):
        return "0"


class Values(list):
    """A value for each filament: alone it stands for the first, as in the slicer."""

    def __str__(self):
        return str(self[0]) if self else ""


settings = build_project_settings(["PLA"])
known = dict(settings)
known.update({
    "initial_extruder": 0, "initial_no_support_extruder": 0, "nozzle_temperature_initial_layer": [220] * 5,
    "nozzle_temperature": [220] * 5, "nozzle_temperature_range_high": [240] * 5, "bed_temperature": [55] * 5,
    "bed_temperature_initial_layer": [55] * 5, "filament_type": ["PLA"] * 5, "filament_max_volumetric_speed": [21] * 5,
    "first_layer_print_min": [118, 118], "first_layer_print_size": [20, 20], "outer_wall_volumetric_speed": 5.67,
    "flush_volumetric_speeds": [12] * 5, "flush_temperatures": [240] * 5,
    "bed_temperature_initial_layer_single": 55, "max_layer_z": 0.4, "curr_bed_type": "Textured PEI Plate",
})


def filled(key):
    values = {name: Values(value) if isinstance(value, list) else value for name, value in known.items()}
    return Environment(undefined=Nothing).from_string(orca_to_jinja2(settings[key])).render(values)


lines = ["; HEADER_BLOCK_START", "; BambuStudio 02.00.00.00", "; total layer number: 2", "; max_z_height: 0.40",
         "; HEADER_BLOCK_END", "; EXECUTABLE_BLOCK_START", "M73 P0 R5", "; FEATURE: Custom", filled("machine_start_gcode"),
         "G90", "G21", "M83"]
for k in range(2):
    z = 0.2 * (k + 1)
    lines += ["; CHANGE_LAYER", f"; Z_HEIGHT: {z:.1f}", "; LAYER_HEIGHT: 0.2", "G1 E-.8 F1800", f"G1 Z{z + 0.4:.1f} F600",
              "G1 X118 Y118 F30000", f"G1 Z{z:.1f}", "G1 E.8 F1800", "; FEATURE: Outer wall", "; LINE_WIDTH: 0.42"]
    for x, y in [(138, 118), (138, 138), (118, 138), (118, 118)]:
        lines.append(f"G1 X{x} Y{y} E.66 F3000")
lines += ["; FEATURE: Custom", filled("machine_end_gcode"), "M73 P100 R0", "; EXECUTABLE_BLOCK_END", "",
          "; CONFIG_BLOCK_START", "; printer_model = Bambu Lab P1S", "; nozzle_diameter = 0.4", "; filament_diameter = 1.75",
          "; filament_type = PLA", "; printable_area = 0x0,256x0,256x256,0x256", "; printable_height = 250",
          "; gcode_flavor = marlin", "; CONFIG_BLOCK_END"]
with open(sys.argv[1], "w") as file:
    file.write("\n".join(lines) + "\n")
