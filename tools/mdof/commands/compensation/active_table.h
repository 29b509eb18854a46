// Which compensation tables are active, and what a change of that says.
#pragma once

#include <optional>

#include "daemon/store/store.h"

namespace CLI {
class App;
}

namespace mdof::tools {

void add_expected_generation_option(CLI::App& command, std::optional<std::int64_t>& generation);

// The generation of a table that is active, else 0.
Result<std::int64_t> generation_of(store::Store& store, const CompensationTable& table);
Result<std::int64_t> generation_of(store::Store& store, const VolumetricTable& table);

// What came of an activation, from the JSON that mdofd and store::activation_json() give alike:
// that JSON, or `done` or, where nothing changed, `already`, with the generation.
Status print_activation(const std::string& reply, const std::string& done,
                        const std::string& already, bool json);

}  // namespace mdof::tools
