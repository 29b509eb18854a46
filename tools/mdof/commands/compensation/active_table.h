// The active compensation tables, and the output of a change.
#pragma once

#include <optional>

#include "daemon/store/store.h"

namespace CLI {
class App;
}

namespace mdof::tools {

void add_expected_generation_option(CLI::App& command, std::optional<std::int64_t>& generation);

// The generation of an active table; 0: the table is not active.
Result<std::int64_t> generation_of(store::Store& store, const CompensationTable& table);
Result<std::int64_t> generation_of(store::Store& store, const VolumetricTable& table);

// Prints the result of an activation. `reply` is the JSON that mdofd and store::activation_json()
// return. The output is this JSON, or `done` with the generation, or `already` with the generation
// if nothing changed.
Status print_activation(const std::string& reply, const std::string& done,
                        const std::string& already, bool json);

}  // namespace mdof::tools
