"""The X rig of the five-probe logs. It declares every uncertainty that a rig can declare, so that tolerances are
decided."""
from mdof_runner import DATA

OF_PROBES = "u_calibration_um = 0.02\nu_sensitivity_ppm = 500\nu_position_mm = 0.05\nu_direction_mrad = 2\n"
OF_RIG = """
[installation]
u_angle_mrad = 2
u_offset_mm = 0
[drift]
u_um_per_h = 0.1
[encoder]
u_um = 0
[[plane]]
normal = "+Z"
u_flatness_um = 0
[[plane]]
normal = "+Y"
offset_mm = 15
u_flatness_um = 0
[temperature]
u_scale_K = 0
u_fixture_K = 0
u_square_gradient_K_per_m = 0
"""


def complete_rig():
    return (DATA / "five-probe/rig_X.toml").read_text().replace("range_um", OF_PROBES + "range_um") + OF_RIG
