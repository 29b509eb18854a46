// Functions for plan.cpp only. Each function reads one part of a plan's TOML document. Errors are
// recorded in the table.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan.h"

namespace mdof::plan_parts {

// Call these functions in this order: each function uses the results of the functions before it.
void read_outputs(TomlTable& table, StudyPlan& plan);
Status read_quantities(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);
void read_dependence(TomlTable& table, StudyPlan& plan);  // reads correlations and bins
// Reads the settings of series, expansion, flatness and run.
void read_settings(TomlTable& table, StudyPlan& plan);
void read_analyses(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);

// Reads the rig in the file that `key` names. If it cannot be read, records the error and returns
// an empty rig.
Rig read_rig(TomlTable& table, std::string_view key, const std::filesystem::path& folder);

// Returns "did you mean ..." or the list of known words.
std::string known_words_hint(const std::string& word, const std::vector<std::string>& known);
std::uint64_t read_count(TomlTable& table, std::string_view key, std::uint64_t fallback,
                         std::int64_t least, std::int64_t most);
double read_share(TomlTable& table, std::string_view key, double fallback);  // must be in (0, 1)
double read_above_zero(TomlTable& table, std::string_view key, double fallback);

bool has_quantity(const StudyPlan& plan, const std::string& name);

}  // namespace mdof::plan_parts
