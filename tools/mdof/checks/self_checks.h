// Checks the whole chain against generated data with known results.
#pragma once

#include <string>
#include <vector>

namespace mdof::tools {

struct SelfCheck {
  std::string what;
  double figure = 0, bound = 0;  // The check passes if figure <= bound.
  std::string unit;
  std::string problem;  // Why there is no figure; empty if there is one.
  bool passed() const { return problem.empty() && figure <= bound; }
};

// Checks the models in both directions, the point detection with a synthetic log, and a store in a
// temporary folder. The figures are the same in each call.
std::vector<SelfCheck> run_self_checks();

}  // namespace mdof::tools
