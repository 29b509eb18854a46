// Checks the evaluation and the storage of data with generated data whose results are known.
#pragma once

#include <string>
#include <vector>

namespace mdof::tools {

struct SelfCheck {
  std::string what;
  double figure = 0, bound = 0;  // The check passes if `figure` <= `bound`.
  std::string unit;
  std::string problem;  // Why `figure` is unknown; empty: it is known.
  bool passed() const { return problem.empty() && figure <= bound; }
};

// Checks the models (errors to readings, and readings to errors), the detection of points in a
// synthetic log, and a database in a temporary folder. Each call returns the same figures.
std::vector<SelfCheck> run_self_checks();

}  // namespace mdof::tools
