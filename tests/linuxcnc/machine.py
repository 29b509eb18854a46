"""The files of a LinuxCNC without a machine: three joints whose motors follow their commands exactly."""
HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net x joint.0.motor-pos-cmd => joint.0.motor-pos-fb
net y joint.1.motor-pos-cmd => joint.1.motor-pos-fb
net z joint.2.motor-pos-cmd => joint.2.motor-pos-fb
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
"""
GENERAL = """[EMC]
VERSION = 1.1
MACHINE = compensation
[DISPLAY]
DISPLAY = ./drive.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[RS274NGC]
PARAMETER_FILE = parameters.var
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = tools.tbl
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 4.0
SERVO_PERIOD = 1000000
[HAL]
HALFILE = machine.hal
[TRAJ]
COORDINATES = XYZ
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = 200
DEFAULT_LINEAR_VELOCITY = 100
NO_FORCE_HOMING = 0
[KINS]
JOINTS = 3
KINEMATICS = trivkins coordinates=XYZ
"""
LIMITS = "MIN_LIMIT = -20\nMAX_LIMIT = 330\nMAX_VELOCITY = 200\nMAX_ACCELERATION = 2000\n"
JOINT = "TYPE = LINEAR\nHOME = 0\nHOME_SEQUENCE = 0\nFERROR = 1\nMIN_FERROR = 1\n"


def ini(compensation):
    """Returns the ini file. The section of each joint has the lines of an exported compensation.ini."""
    text = GENERAL + "".join(f"[AXIS_{axis}]\n{LIMITS}" for axis in "XYZ")
    sections, joint = {}, None
    for line in compensation.splitlines():
        if line.startswith("["):
            joint = line
        elif joint and not line.startswith("#"):
            sections[joint] = sections.get(joint, "") + line + "\n"
    for j in range(3):
        text += f"[JOINT_{j}]\n{LIMITS}{JOINT}{sections.get(f'[JOINT_{j}]', '')}"
    return text
