// The result of a study for people and for spreadsheets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::tools {

// Tables with units; says how far the figures can be trusted.
std::string study_text(const StudyResult& result);

// One row an output, first over all trials and then for each bin; 17 digits.
std::string study_csv(const StudyResult& result);

enum class StudyForm { text, json, csv };
// On the standard output. `study`: its number in the database.
Status print_study(const StudyResult& result, const std::string& figures_json,
                   std::optional<std::int64_t> study, StudyForm form);

// "EBX_urad" as a head of a table: "EBX/µrad".
std::string with_unit(const std::string& key);

}  // namespace mdof::tools
