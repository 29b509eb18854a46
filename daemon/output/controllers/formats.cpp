// The table of formats: one row each. A new one: a file beside this one, and its row here.
#include <algorithm>

#include "daemon/output/controllers/error_rows.h"
#include "daemon/output/controllers/export.h"
#include "daemon/output/controllers/linuxcnc.h"
#include "daemon/output/controllers/siemens_cec.h"
#include "daemon/output/controllers/table_json.h"

namespace mdof::controllers {

const std::vector<Format>& formats() {
  static const std::vector<Format> rows = {
      {.name = "linuxcnc",
       .of = "LinuxCNC 2.9, COMP_FILE",
       .holds = "positioning (EXX, EYY, EZZ), forward and reverse; a table an axis",
       .limits = "256 points a joint; linear between them, end values hold",
       .sense = "trim = -E in mm, added to the motor command (COMP_FILE_TYPE 1)",
       .source = "source of LinuxCNC, and run in one",
       .sign_confirmed = true,
       .quantum_m = 1e-12,
       .takes_home = true,
       .write = write_linuxcnc,
       .read = read_linuxcnc},
      {.name = "json",
       .of = "any program",
       .holds = "all errors of the table with their uncertainty",
       .limits = "none",
       .sense = "E = actual - nominal; correction = factor * E, where the chain is known",
       .source = "mdof's own",
       .sign_confirmed = true,
       .quantum_m = 1e-15,
       .takes_home = false,
       .write = write_table_json,
       .read = read_table_json},
      {.name = "siemens-lec",
       .of = "Siemens SINUMERIK, encoder error compensation (ENC_COMP)",
       .holds = "positioning, one value for both approaches; a file an axis",
       .limits = "200 points at equal steps; linear between them, end values hold",
       .sense = "value = +E in mm: a positive value moves the axis in the negative direction",
       .source = "manual of the 808D, 01/2017; not run on a control",
       .sign_confirmed = true,
       .quantum_m = 2e-9,
       .takes_home = false,
       .write = write_lec,
       .read = read_lec},
      {.name = "siemens-cec",
       .of = "Siemens SINUMERIK, cross error compensation (sag, CEC)",
       .holds = "positioning and straightness, both approaches; one file of all axes",
       .limits = "200 points at equal steps, 8 tables in an 828D; linear between them, end values "
                 "hold",
       .sense = "value = correction in mm, added to the command of the output axis",
       .source = "form: manual of the 828D and 840D sl, 03/2013, which does not state the sign; "
                 "another program writes nominal - measured; not run on a control",
       .sign_confirmed = false,
       .quantum_m = 2e-9,
       .takes_home = false,
       .write = write_cec,
       .read = read_cec},
      {.name = "beckhoff-ssfk",
       .of = "Beckhoff TwinCAT CNC, lead screw compensation (kw.ssfk)",
       .holds = "positioning, positive and negative travel; a file an axis",
       .limits = "1500 rows; whole numbers of 0.1 um; unit and interval are not written",
       .sense = "value = actual - set = +E in 0.1 um",
       .source = "worked example of the manual; not run on a control",
       .sign_confirmed = true,
       .quantum_m = 1e-7,
       .takes_home = false,
       .write = write_ssfk,
       .read = read_ssfk},
      {.name = "weihong",
       .of = "Weihong NcStudio, NK: axeserr.dat",
       .holds = "positioning, forward and backward; one file of all axes",
       .limits = "10000 rows an axis, a limit of mdof's own",
       .sense = "forward and backward error = +E in mm",
       .source = "inferred from the backlash example of the manual",
       .sign_confirmed = false,
       .quantum_m = 2e-9,
       .takes_home = false,
       .write = write_weihong,
       .read = read_weihong},
  };
  return rows;
}

Result<const Format*> format_named(const std::string& name) {
  std::string known;
  for (const Format& format : formats()) {
    if (name == format.name) return &format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  return fail(ErrorCode::usage, "\"" + name + "\" is no format; there are " + known);
}

}  // namespace mdof::controllers
