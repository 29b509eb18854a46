// Checks of the whole chain against data made on the spot, with known answers.
#pragma once

#include <string>
#include <vector>

namespace mdof::tools {

struct SelfCheck {
  std::string what;
  double figure = 0, bound = 0;  // passed where figure <= bound
  std::string unit;
  std::string problem;  // why there is no figure; empty: there is one
  bool passed() const { return problem.empty() && figure <= bound; }
};

// The models there and back, a synthetic log through detection, a store in a temporary folder.
// The same figures every time.
std::vector<SelfCheck> run_self_checks();

}  // namespace mdof::tools
