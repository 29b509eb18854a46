// mdof milling --sensitivity: the share of each input in the variation of force and wall.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/milling/milling_trials.h"
#include "schema/base/json_writer.h"
#include "schema/study/study.h"

namespace mdof::tools {

struct MillingSensitivityRequest {
  std::uint64_t trials = 64,
                seed = 1;  // `trials` for the indices; each trial solves the cut 2 + inputs times
  unsigned threads = 1;
};

struct MillingSensitivity {
  std::vector<algo::VaryingInput> inputs;
  std::vector<std::vector<double>> effects;  // [input][output], effect of one u
  std::vector<OutputSummary> outputs;        // By Monte Carlo.
  std::vector<OutputIndices> indices;
};

// The figures do not depend on the number of threads.
Result<MillingSensitivity> find_milling_sensitivity(const DeclaredMillingPlan& declared,
                                                    const MillingSensitivityRequest& request);

void write_milling_sensitivity(JsonWriter& json, const MillingSensitivityRequest& request,
                               const MillingSensitivity& found);
std::string milling_sensitivity_text(const MillingSensitivity& found);

}  // namespace mdof::tools
