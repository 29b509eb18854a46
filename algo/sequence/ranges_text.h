// Short texts of numbers.
#pragma once

#include <string>
#include <vector>

namespace mdof::algo {

// "1 to 5, 7, 8"; the numbers are ascending.
std::string ranges_text(const std::vector<int>& ascending);
// "target 7", "targets 1 to 5, 7"; with `what` and at least one number.
std::string numbered(const char* what, const std::vector<int>& ascending);

}  // namespace mdof::algo
