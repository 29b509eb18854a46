// The distribution of a planned quantity, read from its TOML table.
#pragma once

#include <filesystem>

#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan.h"

namespace mdof {

// Reads `distribution` and its parameters. Paths of sample files start from `folder`. Errors are
// recorded in the table; only errors in a sample file are returned.
Result<Distribution> read_distribution(TomlTable& table, const std::filesystem::path& folder);

// Reads one column of numbers and sorts them in ascending order. The file may have `#` comments and
// a heading. Errors name file and line.
Result<std::vector<double>> load_sample(const std::filesystem::path& file);

}  // namespace mdof
