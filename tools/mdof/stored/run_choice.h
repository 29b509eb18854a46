// Finds the run that a command names by its number or by "latest".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/store/store.h"
#include "schema/axis.h"
#include "schema/base/result.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mdof::tools {

// Validator for CLI11: accepts a number from 1, or "latest".
std::string run_argument_error(const std::string& word);  // empty: valid

// Adds a required argument RUN, or several of them.
CLI::Option* add_run_argument(CLI::App& command, const char* name, std::string& run,
                              const char* what);
CLI::Option* add_run_arguments(CLI::App& command, std::vector<std::string>& runs, const char* what);
void add_latest_axis_option(CLI::App& command, std::string& axis);

// Returns the number of a run. `run` is a number or "latest", the newest run that has ended (of
// `axis`, if it is not nullopt). Error (bad_input): the run measures another axis.
Result<std::int64_t> run_number(store::Store& store, const std::string& run,
                                std::optional<Axis> axis = std::nullopt);

// The same with the argument of --db. Opens the database only if necessary.
Result<std::int64_t> run_number(const std::string& database, const std::string& run,
                                std::optional<Axis> axis = std::nullopt);

// Returns the numbers of the runs of two axes. `axes`: for example "XZ". If `axes` is empty, the
// runs may measure any axes; then "latest" is the newest run of X as the first run, and of Y as the
// second run. Error (bad_input): a run measures another axis.
Result<std::array<std::int64_t, 2>> run_pair(const std::string& database,
                                             const std::array<std::string, 2>& runs,
                                             const std::string& axes = "");
void add_axes_option(CLI::App& command, std::string& axes);

}  // namespace mdof::tools
