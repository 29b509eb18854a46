// Which run a command means: its number, or "latest".
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

// What the validators of CLI11 accept as a run: a number from 1 on, or "latest".
std::string run_word_error(const std::string& word);  // empty: right

// A required argument RUN, or many of it.
CLI::Option* add_run_argument(CLI::App& command, const char* name, std::string& run,
                              const char* what);
CLI::Option* add_run_arguments(CLI::App& command, std::vector<std::string>& runs, const char* what);
void add_axis_of_latest(CLI::App& command, std::string& axis);

// The number; of "latest" that of the newest run (of `axis`, where given) that has ended. Error
// bad_input: the run is of another axis.
Result<std::int64_t> run_number(store::Store& store, const std::string& run,
                                std::optional<Axis> axis = std::nullopt);

// The same; of what --db gave the database is opened only where it must be looked into.
Result<std::int64_t> run_number(const std::string& database, const std::string& run,
                                std::optional<Axis> axis = std::nullopt);

// Of two axes, "XZ"; empty: those of the runs, of a latest one X in the first and Y in the second
// place. Error bad_input: a run is of another axis.
Result<std::array<std::int64_t, 2>> run_pair(const std::string& database,
                                             const std::array<std::string, 2>& runs,
                                             const std::string& axes = "");
void add_axes_option(CLI::App& command, std::string& axes);

}  // namespace mdof::tools
