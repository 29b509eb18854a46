// mdof milling --sensitivity: calculates how much the variation of each input contributes to the
// variation of the force and of the wall.
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
                seed = 1;  // `trials`: for the indices; each trial calculates the cut 2 + (number
                           // of inputs) times
  unsigned threads = 1;
};

struct MillingSensitivity {
  std::vector<algo::VaryingInput> inputs;
  // [input][output], change of the output if the input changes by its u.
  std::vector<std::vector<double>> effects;
  std::vector<OutputSummary> outputs;  // Distribution of each output by Monte Carlo.
  std::vector<OutputIndices> indices;
};

// The figures do not depend on the number of threads.
Result<MillingSensitivity> find_milling_sensitivity(const DeclaredMillingPlan& declared,
                                                    const MillingSensitivityRequest& request);

void write_milling_sensitivity(JsonWriter& json, const MillingSensitivityRequest& request,
                               const MillingSensitivity& found);
std::string milling_sensitivity_text(const MillingSensitivityRequest& request,
                                     const MillingSensitivity& found);

}  // namespace mdof::tools
