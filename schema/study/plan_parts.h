// Functions that each read one part of a plan's document; for plan.cpp only. Errors are recorded in
// the table.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan.h"

namespace mdof::plan_parts {

// Call in this order: each function needs the results of those before it.
void read_outputs(TomlTable& table, StudyPlan& plan);
Status read_quantities(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);
void read_dependence(TomlTable& table, StudyPlan& plan);  // correlations and bins
void read_settings(TomlTable& table, StudyPlan& plan);    // series, expansion, flatness, run
void read_analyses(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);

// Reads the rig that `key` names; an empty rig, with the error recorded, if it cannot be read.
Rig read_rig(TomlTable& table, std::string_view key, const std::filesystem::path& folder);

// "did you mean ..." or the list of known words.
std::string known_words_hint(const std::string& word, const std::vector<std::string>& known);
std::uint64_t read_count(TomlTable& table, std::string_view key, std::uint64_t fallback,
                         std::int64_t least, std::int64_t most);
double read_share(TomlTable& table, std::string_view key, double fallback);  // (0, 1)
double read_above_zero(TomlTable& table, std::string_view key, double fallback);

bool has_quantity(const StudyPlan& plan, const std::string& name);

}  // namespace mdof::plan_parts
