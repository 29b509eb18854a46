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
void add_csv_and_json_flags(CLI::App& command, bool& csv, bool& json);  // exclusive flags
void add_all_warnings_flag(CLI::App& command, bool& all);
// --limit-um and --limit-um-per-mm, for algo::TableLimits::asked().
struct LimitOptions {
  std::optional<double> um, um_per_mm;
  Result<algo::TableLimits> limits() const;
};
void add_limit_options(CLI::App& command, LimitOptions& limits);
// --simulated and --despite-warnings let data pass a check that would reject it. `what`: "a table".
void add_consent_flags(CLI::App& command, daemon::Consent& consent, const std::string& what);
void add_database_option(CLI::App& command, std::string& database);
void add_socket_option(CLI::App& command, std::string& socket);   // Sets the default.
void add_only_axis_option(CLI::App& command, std::string& axis);  // X, Y or Z.
void add_model_option(CLI::App& command, std::string& model);     // One of the three model names.
void add_plot_option(CLI::App& command, std::string& folder);     // --plot DIR; empty: no plots.
void add_language_option(CLI::App& command, std::string& language);  // "en" or "de".
// Writes the charts to `folder` and names the files on the standard error.
Status write_plots(const std::vector<charts::NamedChart>& charts, const std::string& folder);
// Accepts the names in schema/rig/reference.h.
CLI::Option* add_reference_option(CLI::App& command, std::string& reference);

// Validators for numbers. The validators of CLI11 accept nan and print limits with 309 digits.
CLI::Validator finite_number();
CLI::Validator positive_number();
CLI::Validator not_negative_number();
CLI::Validator number_in(double least, double most);

}  // namespace mdof::tools
