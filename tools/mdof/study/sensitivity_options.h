// The options of mdof sensitivity.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "tools/mdof/study/output.h"
#include "tools/mdof/study/running/study_request.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct SensitivityCommand {
  std::string preset, plan;  // The user states exactly one of preset, plan and continued.
  std::optional<std::int64_t> continued;                 // Number of a stored study.
  std::map<std::string, std::optional<double>> numbers;  // Options of a preset, by key.
  std::vector<double> travel_mm;  // Begin and end of the travel; empty: the preset decides.
  std::optional<std::uint64_t> bins;
  std::optional<double> trials;  // double, so that the user can write 1e9
  std::optional<std::uint64_t> seed;
  std::optional<double> coverage;
  bool adaptive = false;
  std::optional<int> digits;
  std::vector<std::string> tolerances;  // OUTPUT=VALUE
  std::optional<std::uint64_t> trial;   // If set, only the trial with this number runs.
  unsigned threads = 1;
  std::string database;  // Empty: the study is not stored.
  std::string plots;     // Folder; empty: no plots.
  bool json = false, csv = false;
  StudyForm form = StudyForm::text;
};

void declare_options(CLI::App& command, SensitivityCommand& o);

// Checks the options and sets command.form. Errors: two options exclude each other; a number is
// outside its range.
Status check_usage(SensitivityCommand& command);
// The study that the options describe. Reads the file of the plan.
Result<StudyRequest> request_of(const SensitivityCommand& command);
// Checks that the folder exists or can be created, and is writable. Called before a long
// calculation.
Status check_plot_folder(const std::string& folder);

}  // namespace mdof::tools
