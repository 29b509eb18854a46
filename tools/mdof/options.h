// Options that several commands have, said the same way by each.
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
void add_csv_and_json_flags(CLI::App& command, bool& csv, bool& json);  // one or the other
void add_all_warnings_flag(CLI::App& command, bool& all);
// --limit-um and --limit-um-per-mm, as of algo::TableLimits::asked().
struct LimitOptions {
  std::optional<double> um, um_per_mm;
  Result<algo::TableLimits> limits() const;
};
void add_limit_options(CLI::App& command, LimitOptions& limits);
// --simulated and --despite-warnings: what passes the gate all the same. `what`: "a table".
void add_consent_flags(CLI::App& command, daemon::Consent& consent, const std::string& what);
void add_database_option(CLI::App& command, std::string& database);
void add_socket_option(CLI::App& command, std::string& socket);      // sets the default
void add_only_axis_option(CLI::App& command, std::string& axis);     // X, Y or Z
void add_model_option(CLI::App& command, std::string& model);        // one of the three names
void add_plot_option(CLI::App& command, std::string& folder);        // --plot DIR; empty: none
void add_language_option(CLI::App& command, std::string& language);  // "en" or "de"
// Writes what --plot asks for, and names the files on the standard error.
Status write_plots(const std::vector<charts::NamedChart>& charts, const std::string& folder);
// One of the names of schema/rig/reference.h.
CLI::Option* add_reference_option(CLI::App& command, std::string& reference);

// What an option's number may be. Those of CLI11 take nan and print limits of 309 digits.
CLI::Validator finite_number();
CLI::Validator positive_number();
CLI::Validator not_negative_number();
CLI::Validator number_in(double least, double most);

}  // namespace mdof::tools
