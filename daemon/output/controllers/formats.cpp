// The table of formats: one row each. A new one: a file beside this one, and its row here.
#include <algorithm>

#include "daemon/output/controllers/export.h"
#include "daemon/output/controllers/linuxcnc.h"
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
