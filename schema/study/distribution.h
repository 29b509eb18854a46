// The distribution of a planned quantity, read from its TOML table.
#pragma once

#include <filesystem>

#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan.h"

namespace mdof {

// Reads `distribution` and its parameters; paths of samples are relative to `folder`. Errors are
// recorded in the table, except those of a sample file, which are returned.
Result<Distribution> read_distribution(TomlTable& table, const std::filesystem::path& folder);

// One column of numbers with `#` comments and an optional heading; ascending. Errors name file and
// line.
Result<std::vector<double>> load_sample(const std::filesystem::path& file);

}  // namespace mdof
