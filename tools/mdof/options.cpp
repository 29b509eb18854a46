#include "tools/mdof/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/paths.h"
#include "schema/base/number/number_text.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// A validator that accepts a finite number x if right(x) is true. `must`: the message for other
// numbers. `in_help`: the text in the help.
CLI::Validator number_validator(const std::function<bool(double)>& right, const std::string& must,
                                const std::string& in_help) {
  return {[=](const std::string& word) {
            double x = std::numeric_limits<double>::quiet_NaN();
            if (!CLI::detail::lexical_cast(word, x)) return "\"" + word + "\" is not a number";
            if (!std::isfinite(x)) return word + " is not a finite number";
            return right(x) ? std::string() : word + " must be " + must;
          },
          in_help};
}

}  // namespace

void add_json_flag(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "Print one JSON document");
}

void add_csv_and_json_flags(CLI::App& command, bool& csv, bool& json) {
  auto* first = command.add_flag("--csv", csv,
                                 "Print CSV with units in the header and numbers with 17 digits");
  command.add_flag("--json", json, "Print one JSON document")->excludes(first);
}

void add_all_warnings_flag(CLI::App& command, bool& all) {
  command.add_flag("--all-warnings", all,
                   "Print every warning; do not summarise repeated warnings");
}

Result<algo::TableLimits> LimitOptions::limits() const {
  return algo::TableLimits::asked(um ? &*um : nullptr, um_per_mm ? &*um_per_mm : nullptr);
}

void add_limit_options(CLI::App& command, LimitOptions& limits) {
  command
      .add_option("--limit-um", limits.um,
                  "Largest permitted error or correction in um (for angles: urad) [default: 1000 "
                  "um, 10000 urad]")
      ->check(positive_number())
      ->type_name("UM");
  command
      .add_option("--limit-um-per-mm", limits.um_per_mm,
                  "Largest permitted slope of an error or correction in um/mm (for angles: "
                  "urad/mm) [default: 50 um/mm, 500 urad/mm]")
      ->check(positive_number())
      ->type_name("UM");
}

void add_consent_flags(CLI::App& command, daemon::Consent& consent, const std::string& what) {
  command.add_flag("--simulated", consent.simulated, "Accept simulated data in " + what);
  command.add_flag("--despite-warnings", consent.despite_warnings,
                   "Accept warnings about the source runs of " + what);
}

void add_database_option(CLI::App& command, std::string& database) {
  command
      .add_option("--db", database,
                  "Database of runs [default: $STATE_DIRECTORY/mdof.db, else "
                  "$XDG_STATE_HOME/mdof/mdof.db]")
      ->type_name("FILE");
}

void add_socket_option(CLI::App& command, std::string& socket) {
  socket = daemon::default_socket();
  command
      .add_option("--socket", socket,
                  "Socket of mdofd [default: $RUNTIME_DIRECTORY/mdof.sock, else "
                  "$XDG_RUNTIME_DIR/mdof.sock]")
      ->type_name("PATH");
}

void add_only_axis_option(CLI::App& command, std::string& axis) {
  command.add_option("--axis", axis, "Only this axis")->check(CLI::IsMember({"X", "Y", "Z"}));
}

void add_model_option(CLI::App& command, std::string& model) {
  command
      .add_option("--model", model,
                  "Model that calculates the errors from the readings: simplified, exact or rigid")
      ->check(CLI::IsMember({"simplified", "exact", "rigid"}))
      ->type_name("MODEL")
      ->capture_default_str();
}

void add_plot_option(CLI::App& command, std::string& folder) {
  command
      .add_option("--plot", folder, "Draw charts as SVG files in this folder (created if missing)")
      ->type_name("DIR");
}

Status write_plots(const std::vector<charts::NamedChart>& charts, const std::string& folder) {
  if (folder.empty() || charts.empty()) return {};
  MDOF_TRY(const auto files, charts::write_charts(charts, folder));
  for (const std::string& file : files) say("plot: " + file);
  return {};
}

void add_language_option(CLI::App& command, std::string& language) {
  command.add_option("--language", language, "Language of the text in the files: en or de")
      ->check(CLI::IsMember({"en", "de"}))
      ->type_name("NAME")
      ->capture_default_str();
}

CLI::Option* add_reference_option(CLI::App& command, std::string& reference) {
  return command
      .add_option("--reference", reference,
                  "Point to which straightness refers: fixture, carriage or tool")
      ->check(CLI::IsMember({"fixture", "carriage", "tool"}))
      ->type_name("POINT");
}

void add_square_options(CLI::App& command, std::optional<double>& angle_error_urad,
                        std::optional<double>& u_urad) {
  command.add_option("--artefact-urad", angle_error_urad,
                     "Angle error of the reference square [default: value in the rigs]");
  command
      .add_option("--u-artefact-urad", u_urad,
                  "Standard uncertainty of the angle error of the reference square")
      ->check(not_negative_number());
}

CLI::Validator finite_number() {
  return number_validator([](double) { return true; }, "", "");
}

CLI::Validator positive_number() {
  return number_validator([](double x) { return x > 0; }, "greater than 0", "POSITIVE");
}

CLI::Validator not_negative_number() {
  return number_validator([](double x) { return x >= 0; }, "0 or greater", "NONNEGATIVE");
}

CLI::Validator number_in(double least, double most) {
  const std::string range = plain_number(least) + " to " + plain_number(most);
  return number_validator([=](double x) { return x >= least && x <= most; }, "from " + range,
                          "in [" + range + "]");
}

}  // namespace mdof::tools
