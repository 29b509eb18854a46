// Numbers for people, shortly.
#pragma once

#include <string>
#include <vector>

namespace mdof::algo {

// "1 to 5, 7, 8" of ascending numbers.
std::string ranges_text(const std::vector<int>& ascending);
// "target 7", "targets 1 to 5, 7": `what` and at least one number.
std::string numbered(const char* what, const std::vector<int>& ascending);

}  // namespace mdof::algo
