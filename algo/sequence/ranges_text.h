// Short texts for lists of numbers.
#pragma once

#include <string>
#include <vector>

namespace mdof::algo {

// Returns for example "1 to 5, 7, 8". The numbers must be ascending.
std::string ranges_text(const std::vector<int>& ascending);
// Returns for example "target 7" or "targets 1 to 5, 7" for `what` = "target" and at least one
// number.
std::string numbered(const char* what, const std::vector<int>& ascending);

}  // namespace mdof::algo
