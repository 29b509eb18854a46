// Options that several commands have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algo/compensation/table_limits.h"
#include "schema/base/result.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace mdof::daemon {
struct Consent;
}

namespace mdof::charts {
struct NamedChart;
}

namespace mdof::tools {

void add_json_flag(CLI::App& command, bool& json);
// --csv and --json, of which only one may be used.
void add_csv_and_json_flags(CLI::App& command, bool& csv, bool& json);
void add_all_warnings_flag(CLI::App& command, bool& all);
// --limit-um and --limit-um-per-mm, for the limits in algo::TableLimits.
struct LimitOptions {
  std::optional<double> um, um_per_mm;
  Result<algo::TableLimits> limits() const;
};
void add_limit_options(CLI::App& command, LimitOptions& limits);
// --simulated and --despite-warnings accept data that a check would reject. `what`: what the
// command makes, for example "a table".
void add_consent_flags(CLI::App& command, daemon::Consent& consent, const std::string& what);
void add_database_option(CLI::App& command, std::string& database);
void add_socket_option(CLI::App& command, std::string& socket);   // --socket; sets the default
void add_only_axis_option(CLI::App& command, std::string& axis);  // --axis: X, Y or Z
// --model: name of one of the three models.
void add_model_option(CLI::App& command, std::string& model);
void add_plot_option(CLI::App& command, std::string& folder);        // --plot DIR; empty: no plots.
void add_language_option(CLI::App& command, std::string& language);  // "en" or "de".
// Writes the charts to `folder` and prints the file names to the standard error.
Status write_plots(const std::vector<charts::NamedChart>& charts, const std::string& folder);
// Accepts the names in schema/rig/reference.h.
CLI::Option* add_reference_option(CLI::App& command, std::string& reference);
// --artefact-urad and --u-artefact-urad, which replace the values of the reference square in the
// rigs.
void add_square_options(CLI::App& command, std::optional<double>& angle_error_urad,
                        std::optional<double>& u_urad);

// Validators for numbers, used instead of the validators of CLI11, which accept nan and print the
// largest double with 309 digits.
CLI::Validator finite_number();
CLI::Validator positive_number();
CLI::Validator not_negative_number();
CLI::Validator number_in(double least, double most);

}  // namespace mdof::tools
