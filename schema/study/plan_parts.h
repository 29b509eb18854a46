// The parts of a plan's document, each read by its own function; for plan.cpp only. What is
// wrong is recorded in the table.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/toml/toml_reader.h"
#include "schema/study/plan.h"

namespace mdof::plan_parts {

// In this order: each needs what those before it have read.
void read_outputs(TomlTable& table, StudyPlan& plan);
Status read_quantities(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);
void read_dependence(TomlTable& table, StudyPlan& plan);  // correlations and bins
void read_settings(TomlTable& table, StudyPlan& plan);    // series, expansion, flatness, run
void read_analyses(TomlTable& table, const std::filesystem::path& folder, StudyPlan& plan);

// The rig that `key` names; an empty one where it cannot be read, with the reason recorded.
Rig read_rig(TomlTable& table, std::string_view key, const std::filesystem::path& folder);

// "did you mean ..." or the list.
std::string known_or_list(const std::string& word, const std::vector<std::string>& known);
std::uint64_t read_count(TomlTable& table, std::string_view key, std::uint64_t fallback,
                         std::int64_t least, std::int64_t most);
double read_share(TomlTable& table, std::string_view key, double fallback);  // (0, 1)
double read_above_zero(TomlTable& table, std::string_view key, double fallback);

bool has_quantity(const StudyPlan& plan, const std::string& name);

}  // namespace mdof::plan_parts
