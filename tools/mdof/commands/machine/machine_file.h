// MACHINE.toml with the tables that it names, and what all commands of a machine say.
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

// With the tables of its files, which stand relative to MACHINE.toml; what it names of the database
// is not in it yet.
Result<Machine> described_machine(const std::string& file);
// The same with its text, to which a comment with the hash of each file is added.
struct DescribedMachine {
  Machine machine;
  std::string text;
};
Result<DescribedMachine> described_with_text(const std::string& file);
// Adds the rows of the database that it names, and the notices of them are shown; opened only where
// it names some. `database`: what --db gave.
Status add_stored_errors(Machine& machine, const std::string& database);
// Both.
Result<Machine> load_machine(const std::string& file, const std::string& database);

void add_machine_argument(CLI::App& command, std::string& file);
void add_approach_option(CLI::App& command, std::string& approach);
algo::MachineApproach approach_from(const std::string& name);

// "10,20,30": X, Y and Z; or "X=10,C=90": mm and degrees, the others at 0. Error: an axis that the
// chain has not, what is no number.
Result<algo::Command> command_from(const Machine& machine, const std::string& text);

// The six components of an error, as keys of JSON and in µm or µrad.
inline constexpr const char* kComponents[] = {"x_um", "y_um", "z_um", "a_urad", "b_urad", "c_urad"};
void write_components(JsonWriter& json, const char* key, const algo::Vector6& error);
// {"X_mm": ..., "C_deg": ...} of the axes of the chain.
void write_command(JsonWriter& json, const char* key, const Machine& machine,
                   const algo::Command& command);

void warn_beyond(const std::vector<std::string>& names);
std::string missing_text(const std::vector<std::string>& not_measured,
                         const std::vector<std::string>& no_u, std::size_t width);

}  // namespace mdof::tools
