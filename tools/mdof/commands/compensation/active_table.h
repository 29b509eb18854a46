// Options, generation numbers and output of the commands that activate or deactivate a compensation
// table.
#pragma once

#include <optional>

#include "daemon/store/store.h"

namespace CLI {
class App;
}

namespace mdof::tools {

void add_expected_generation_option(CLI::App& command, std::optional<std::int64_t>& generation);

// The generation number of an active table; 0: the table is not active.
Result<std::int64_t> generation_of(store::Store& store, const CompensationTable& table);
Result<std::int64_t> generation_of(store::Store& store, const VolumetricTable& table);

// Prints the result of an activation. `reply` is the JSON text from mdofd or
// store::activation_json(). If `json` is true, the output is `reply`. Otherwise the output is
// `done` and the generation number, or `already` and the generation number if nothing changed.
Status print_activation(const std::string& reply, const std::string& done,
                        const std::string& already, bool json);

}  // namespace mdof::tools
