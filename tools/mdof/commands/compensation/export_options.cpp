// Declares the options that mdof compensation export and mdof compensation check share.
#include <CLI/CLI.hpp>

#include "tools/mdof/commands/compensation/exported.h"
#include "tools/mdof/options.h"

namespace mdof::tools {

void add_export_options(CLI::App& command, ExportRequest& request, const std::string& remark) {
  command.add_option("TABLE", request.tables, "Numbers of tables, one for each axis")
      ->type_name("");
  command
      .add_option(
          "--squareness", request.squareness,
          "Number of a stored squareness, or \"latest\"; for formats that correct squareness")
      ->type_name("NUMBER");
  command
      .add_option("--format", request.format,
                  "Name of the format; to list the formats, use: mdof compensation export --list")
      ->type_name("NAME");
  command
      .add_option(
          "--tolerance-um", request.tolerance_um,
          "Leave out points of the table; linear interpolation between the remaining points "
          "differs from the full table by at most this value in um (for angles: urad)")
      ->check(not_negative_number());
  command
      .add_option("--residual-um", request.residual_um,
                  "Largest permitted error after the correction in um (for angles: urad); mdof "
                  "adds --tolerance-um to this limit")
      ->check(finite_number())
      ->capture_default_str();
  command
      .add_option("--residual-percent", request.residual_percent,
                  "Largest permitted error after the correction, in percent of the error before "
                  "the correction")
      ->check(finite_number())
      ->capture_default_str();
  add_limit_options(command, request.limits);
  command
      .add_option(
          "--home-mm", request.home_mm,
          "Home position of each axis, such as X=10,Y=-20 (for one table, one number is enough); "
          "mdof subtracts the correction at this position from all corrections of the table")
      ->type_name("AXIS=MM,…");
  command.add_flag(
      "--cut-range", request.cut_range,
      "If the table lacks values, export the longest range of positions without a gap");
  command.add_flag(
      "--one-approach", request.one_approach,
      "If a table has values for one approach only, use these values for both approaches. If the "
      "format has one value for both approaches, accept the reversal error that remains");
  command
      .add_option("--joint", request.joints,
                  "linuxcnc: joints of the axes, such as X=0,Z=1; a gantry has two joints, such as "
                  "Y=1,Y=3 [default: X=0,Y=1,Z=2]")
      ->type_name("AXIS=N,…");
  command
      .add_option("--units", request.units,
                  "linuxcnc: length unit in the files, the same as [TRAJ] LINEAR_UNITS")
      ->check(CLI::IsMember({"mm", "inch"}))
      ->capture_default_str();
  auto* acceleration =
      command
          .add_option("--max-acceleration-mm-s2", request.max_acceleration_mm_s2,
                      "linuxcnc: MAX_ACCELERATION of the joints; with this value mdof finds small "
                      "reversal errors that LinuxCNC does not correct")
          ->check(positive_number());
  command
      .add_option(
          "--ini", request.ini,
          "linuxcnc: INI file of LinuxCNC, from which mdof reads the joints (KINEMATICS), "
          "MAX_ACCELERATION, SERVO_PERIOD, LINEAR_UNITS, HOME, soft limits, BACKLASH and COMP_FILE")
      ->type_name("FILE")
      ->excludes(acceleration);
  command
      .add_option("--siemens-points", request.siemens_points,
                  "siemens-lec, siemens-cec: number of points that a table of the control can "
                  "contain (MD38000, MD18342) [default: 200]")
      ->check(CLI::Range(2, 20'000));
  command
      .add_option("--siemens-tables", request.siemens_tables,
                  "siemens-cec: number of CEC tables in the control; mdof refuses an export that "
                  "needs more")
      ->check(CLI::Range(1, 1000));
  add_consent_flags(command, request.consent, "a table" + remark);
  command.add_flag("--not-active", request.not_active,
                   "Accept a table that is not active" + remark);
  command.add_flag("--not-in-force", request.not_active)->group("");  // the former name
  command.add_flag("--unverified-sign", request.unverified_sign,
                   "Export although the sign convention of the controller is not confirmed");
  add_database_option(command, request.database);
}

}  // namespace mdof::tools
