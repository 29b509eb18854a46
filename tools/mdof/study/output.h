// The result of a study as text and CSV.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// Tables with units, and the uncertainty of the figures.
std::string study_text(const StudyResult& result);

// One row for each output over all trials, then one row for each output in each bin. Numbers have
// 17 digits.
std::string study_csv(const StudyResult& result);

enum class StudyForm { text, json, csv };
// Prints to the standard output. `study`: its number in the database.
Status print_study(const StudyResult& result, const std::string& figures_json,
                   std::optional<std::int64_t> study, StudyForm form);

// The title of a column: "EBX/µrad" for "EBX_urad".
std::string with_unit(const std::string& key);

}  // namespace mdof::tools
