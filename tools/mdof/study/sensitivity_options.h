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
  std::string preset, plan;                              // one of them, or
  std::optional<std::int64_t> continued;                 // a stored study
  std::map<std::string, std::optional<double>> numbers;  // of a preset, by key
  std::vector<double> travel_mm;                         // from, to; empty: as the preset
  std::optional<std::uint64_t> bins;
  std::optional<double> trials;  // may be given as 1e9
  std::optional<std::uint64_t> seed;
  std::optional<double> coverage;
  bool adaptive = false;
  std::optional<int> digits;
  std::vector<std::string> tolerances;  // OUTPUT=VALUE
  std::optional<std::uint64_t> trial;   // this one alone
  unsigned threads = 1;
  std::string database;  // "": the study is not stored
  std::string plots;     // folder; "": none
  bool json = false, csv = false;
  StudyForm form = StudyForm::text;
};

void declare_options(CLI::App& command, SensitivityCommand& o);

// Errors: options that exclude one another, or a number out of its range. Sets command.form.
Status check_usage(SensitivityCommand& command);
// The study they describe; reads the plan's file.
Result<StudyRequest> request_of(const SensitivityCommand& command);
// Before hours of work: that the folder is there, or can be made, and can be written.
Status check_plot_folder(const std::string& folder);

}  // namespace mdof::tools
