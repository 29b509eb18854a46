// Reads MACHINE.toml with the tables that it names, and has the output that all machine commands
// share.
#pragma once

#include <string>
#include <vector>

#include "algo/machine/tool_error.h"
#include "schema/base/json_writer.h"
#include "schema/machine/machine.h"
#include "schema/run_json.h"

namespace CLI {
class App;
}

namespace mdof::tools {

// Reads the machine with the tables in files, whose paths are relative to MACHINE.toml. The errors
// that it names from the database are not included yet.
Result<Machine> described_machine(const std::string& file);
// The same with the text of the file, extended by a comment with the hash of each table file.
struct DescribedMachine {
  Machine machine;
  std::string text;
};
Result<DescribedMachine> described_with_text(const std::string& file);
// Adds the errors that the machine names from the database, and prints their notices. Opens the
// database only if the machine names some. `database`: the argument of --db.
Status add_stored_errors(Machine& machine, const std::string& database);
// Calls described_machine() and add_stored_errors().
Result<Machine> load_machine(const std::string& file, const std::string& database);

void add_machine_argument(CLI::App& command, std::string& file);
void add_approach_option(CLI::App& command, std::string& approach);
algo::MachineApproach approach_from(const std::string& name);

// "10,20,30": X, Y and Z; or "X=10,C=90": mm and degrees, with the other axes at 0. Errors: an axis
// that is not in the chain; not a number.
Result<algo::Command> command_from(const Machine& machine, const std::string& text);

// The six components of an error in µm or µrad, as keys in JSON.
inline constexpr const char* kComponents[] = {"x_um", "y_um", "z_um", "a_urad", "b_urad", "c_urad"};
void write_components(JsonWriter& json, const char* key, const algo::Vector6& error);
// Writes {"X_mm": ..., "C_deg": ...} for the axes of the chain.
void write_command(JsonWriter& json, const char* key, const Machine& machine,
                   const algo::Command& command);

void warn_outside_tables(const std::vector<std::string>& names);
std::string missing_text(const std::vector<std::string>& not_measured,
                         const std::vector<std::string>& no_u, std::size_t width);

}  // namespace mdof::tools
