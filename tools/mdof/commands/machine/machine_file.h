// Reads MACHINE.toml and the tables that it names. Contains the options and output that all machine
// commands share.
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

// Reads MACHINE.toml and the tables in files. File paths are relative to MACHINE.toml. The result
// does not contain errors from the database; see add_stored_errors().
Result<Machine> described_machine(const std::string& file);
// Result of described_with_text(). `text`: the text of MACHINE.toml, followed by a comment with the
// hash of each table file.
struct DescribedMachine {
  Machine machine;
  std::string text;
};
Result<DescribedMachine> described_with_text(const std::string& file);
// If MACHINE.toml names errors in the database, opens the database, adds these errors to `machine`,
// prints their notices and stores them in `machine`. `database`: the argument of --db.
Status add_stored_errors(Machine& machine, const std::string& database);
// Calls described_machine() and add_stored_errors().
Result<Machine> load_machine(const std::string& file, const std::string& database);

void add_machine_argument(CLI::App& command, std::string& file);
void add_approach_option(CLI::App& command, std::string& approach);
algo::MachineApproach approach_from(const std::string& name);
// A line that states the approach; empty if no error of the machine depends on the approach.
std::string approach_text(const Machine& machine, algo::MachineApproach approach);

// Reads positions of the axes in mm and degrees: "10,20,30" for X, Y and Z, or "X=10,C=90" with all
// other axes at 0. Errors: an axis is not in the chain of the machine; a value is not a number.
Result<algo::Command> command_from(const Machine& machine, const std::string& text);

// JSON keys of the six components of an error motion, in µm and µrad.
inline constexpr const char* kComponents[] = {"x_um", "y_um", "z_um", "a_urad", "b_urad", "c_urad"};
void write_components(JsonWriter& json, const char* key, const algo::Vector6& error);
// Writes {"X_mm": ..., "C_deg": ...} for the axes of the chain.
void write_command(JsonWriter& json, const char* key, const Machine& machine,
                   const algo::Command& command);

// Writes "notices": the notices about the errors from the database.
void write_stored_notices(JsonWriter& json, const Machine& machine);

void warn_outside_tables(const std::vector<std::string>& names);
std::string missing_text(const std::vector<std::string>& not_measured,
                         const std::vector<std::string>& no_u, std::size_t width);

}  // namespace mdof::tools
