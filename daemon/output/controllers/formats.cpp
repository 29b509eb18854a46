// The list of all formats. To add a format, add a file to this folder and a row to this list.
#include <algorithm>

#include "daemon/output/controllers/error_rows.h"
#include "daemon/output/controllers/export.h"
#include "daemon/output/controllers/linuxcnc/linuxcnc.h"
#include "daemon/output/controllers/siemens/siemens_cec.h"
#include "daemon/output/controllers/square_files.h"
#include "daemon/output/controllers/table_json.h"
#include "daemon/output/controllers/volume_files.h"

namespace mdof::controllers {

const std::vector<Format>& formats() {
  static const std::vector<Format> rows = {
      {.name = "linuxcnc",
       .of = "LinuxCNC 2.9, COMP_FILE",
       .holds = "positioning (EXX, EYY, EZZ), forward and reverse; one table per axis",
       .limits = "256 points per joint; linear interpolation between the points; constant value "
                 "beyond the first and last points",
       .sense = "trim = -E in mm or inches, added to the motor command (COMP_FILE_TYPE 1)",
       .source = "source code of LinuxCNC; tested in LinuxCNC",
       .sign_confirmed = true,
       .quantum_m = 1e-12,
       .takes_home = true,
       .axes = {write_linuxcnc, read_linuxcnc},
       .volume = {},
       .square = {},
       .takes_joints = true,
       .both_approaches = true},
      {.name = "json",
       .of = "any program",
       .holds = "all errors of the table with their uncertainty",
       .limits = "tables of one axis; compensation.grid returns volumetric tables as JSON",
       .sense = "E = actual - nominal; correction = factor * E, if the kinematic chain of the "
                "machine is known",
       .source = "format of mdof",
       .sign_confirmed = true,
       .quantum_m = 1e-15,
       .takes_home = false,
       .axes = {write_table_json, read_table_json},
       .volume = {},
       .square = {}},
      {.name = "siemens-lec",
       .of = "Siemens SINUMERIK, encoder error compensation (ENC_COMP)",
       .holds = "positioning (one value for both approaches, one file per axis)",
       .limits =
           "200 points at equal steps (if MD38000 of the control has another limit, use the option "
           "siemens-points); linear interpolation between the points; constant value beyond "
           "the first and last points",
       .sense = "value = +E in mm: a positive value moves the axis in the negative direction",
       .source = "manual of the 808D, 01/2017; not tested on a control",
       .sign_confirmed = true,
       .quantum_m = 2e-9,
       .takes_home = true,
       .axes = {write_lec, read_lec},
       .volume = {},
       .square = {}},
      {.name = "siemens-cec",
       .of = "Siemens SINUMERIK, cross error compensation (sag, CEC)",
       .holds = "positioning and straightness, both approaches; or a volumetric table as sums and "
                "products of one-axis tables; one file",
       .limits =
           "200 points at equal steps, and 8 tables in an 828D (if MD18342 of the control has "
           "another limit, use the options siemens-points and siemens-tables); linear "
           "interpolation between the points; constant value beyond the first and last points",
       .sense = "value = correction in mm, added to the command of the output axis",
       .source = "format: manual of the 828D and 840D sl, 03/2013; this manual does not state the "
                 "sign; another program uses the sign nominal - measured; not tested on a control",
       .sign_confirmed = false,
       .quantum_m = 2e-9,
       .takes_home = false,
       .axes = {write_cec, read_cec},
       .volume = {write_cec_volume, read_cec_volume},
       .square = {},
       .both_approaches = true},
      {.name = "beckhoff-ssfk",
       .of = "Beckhoff TwinCAT CNC, lead screw compensation (kw.ssfk)",
       .holds = "positioning, positive and negative travel; one file per axis",
       .limits = "1499 rows, each with its own position (key kw.ssfk.interval = 0); all values are "
                 "integers in units of 0.1 um (key kw.ssfk.unit = 1)",
       .sense = "value = actual - set = +E in 0.1 um",
       .source = "from a worked example in the manual of the control; not tested on a control",
       .sign_confirmed = true,
       .quantum_m = 1e-7,
       .takes_home = false,
       .axes = {write_ssfk, read_ssfk},
       .volume = {},
       .square = {},
       .both_approaches = true},
      {.name = "weihong",
       .of = "Weihong NcStudio, NK: axeserr.dat",
       .holds = "positioning, forward and backward; one file for all axes",
       .limits = "10000 rows per axis (limit of mdof)",
       .sense = "forward and backward error = +E in mm",
       .source = "inferred from the backlash example of the manual",
       .sign_confirmed = false,
       .quantum_m = 2e-9,
       .takes_home = false,
       .axes = {write_weihong, read_weihong},
       .volume = {},
       .square = {},
       .both_approaches = true},
      {.name = "isg-csv",
       .of = "Beckhoff TwinCAT CNC (TF5280) and ISG kernel, volumetric compensation",
       .holds = "volumetric table: corrections of X, Y and Z over a plane or a volume",
       .limits = "all nodes of the table, if max_records of the control is large enough; linear "
                 "interpolation between nodes",
       .sense = "columns EXX, EYX, EZX in mm = actual - nominal position of the tool = -correction",
       .source = "format: manual of the TF5280; this manual uses the errors of ISO 230-1 and has "
                 "the key \"negate\" for the opposite sign; not tested on a control",
       .sign_confirmed = false,
       .quantum_m = 2e-12,
       .takes_home = false,
       .axes = {},
       .volume = {write_isg_csv, read_isg_csv},
       .square = {}},
      {.name = "dynomotion",
       .of = "DynoMotion KFLOP and Kogna, geometric correction table",
       .holds = "volumetric table: corrections of X, Y and Z over the plane XY",
       .limits = "4000 rows and columns at equal steps; bilinear interpolation; beyond the grid, "
                 "the last cell is extrapolated",
       .sense =
           "X and Y: corrected commands; Z: correction that is added to the command; all in inch",
       .source = "manual and published source code of KMotion; not tested on a control",
       .sign_confirmed = true,
       .quantum_m = 1e-12,
       .takes_home = false,
       .axes = {},
       .volume = {write_dynomotion, read_dynomotion},
       .square = {}},
      {.name = "klipper",
       .of = "Klipper, skew_correction",
       .holds = "the squareness of X and Y",
       .limits = "the format stores one angle only and assumes that both axes are straight",
       .sense = "diagonals AC, BD and side AD (mm) of a square that the uncorrected machine draws",
       .source = "published source code of Klipper; not tested on a machine",
       .sign_confirmed = true,
       .quantum_m = 1e-10,
       .takes_home = false,
       .axes = {},
       .volume = {},
       .square = {write_klipper, read_klipper}},
      {.name = "marlin",
       .of = "Marlin, M852",
       .holds = "the squareness of X and Y",
       .limits = "the format stores one angle only and assumes that both axes are straight",
       .sense = "parameter I: for the command x, y, axis X moves to x - I * y",
       .source = "published source code of Marlin; not tested on a machine",
       .sign_confirmed = true,
       .quantum_m = 1e-9,
       .takes_home = false,
       .axes = {},
       .volume = {},
       .square = {write_marlin, read_marlin}},
      {.name = "reprapfirmware",
       .of = "RepRapFirmware (Duet), M556",
       .holds = "the squareness of X and Y",
       .limits = "the format stores one angle only and assumes that both axes are straight",
       .sense = "the parameter X of M556 divided by its parameter S is the tangent of the "
                "squareness error; positive if the angle from +X to +Y is above 90 deg",
       .source = "manual of M556; not tested on a machine",
       .sign_confirmed = true,
       .quantum_m = 1e-9,
       .takes_home = false,
       .axes = {},
       .volume = {},
       .square = {write_reprapfirmware, read_reprapfirmware}},
      {.name = "matrixkins",
       .of = "LinuxCNC 2.10, matrixkins (not in 2.9)",
       .holds = "the squareness of X and Y",
       .limits = "the format stores one angle only and assumes that both axes are straight",
       .sense = "parameter C_xy: for the command x, y, joint X moves to x + C_xy * y",
       .source = "manual and test code of the component matrixkins; not tested in LinuxCNC",
       .sign_confirmed = true,
       .quantum_m = 1e-10,
       .takes_home = false,
       .axes = {},
       .volume = {},
       .square = {write_matrixkins, read_matrixkins}},
  };
  return rows;
}

const std::vector<UnsupportedController>& not_written() {
  static const std::vector<UnsupportedController> rows = {
      {.name = "heidenhain",
       .of = "Heidenhain TNC, compensation value tables (.COM and .CMA)",
       .reason = "the public technical manuals show the columns of the tables, but they do not "
                 "state the sign of the values",
       .instead = "export in the format json (E = actual - nominal), and convert the values as the "
                  "manual of the machine manufacturer describes"},
      {.name = "fanuc",
       .of = "Fanuc, pitch error and straightness compensation parameters",
       .reason =
           "each value is the increment over one interval, in detection units multiplied by a "
           "magnification. The detection unit and the magnification are parameters of the machine. "
           "No known public manual completely states the sign and the format of the parameter "
           "file",
       .instead = "export in the format json (E = actual - nominal), and enter the increments as "
                  "the manual of the machine manufacturer describes"},
  };
  return rows;
}

Result<const Format*> format_named(const std::string& name) {
  for (const UnsupportedController& one : not_written())
    if (name == one.name)
      return fail(ErrorCode::usage, std::string(one.of) +
                                        ": mdof does not write this format, because " + one.reason +
                                        "; instead: " + one.instead);
  std::string known;
  for (const Format& format : formats()) {
    if (name == format.name) return &format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  return fail(ErrorCode::usage, "\"" + name + "\" is not a format; the formats are " + known);
}

}  // namespace mdof::controllers
