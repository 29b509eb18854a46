// Warnings of a run as people read them: a hundred of one kind are three and a count.
#pragma once

#include <string>
#include <vector>

namespace mdof::tools {

// Two are of one kind where they differ in numbers only. Of a kind with more than a few the first
// ones are kept and the last of these says how many more there are. `all`: nothing is left out.
std::vector<std::string> summarised(const std::vector<std::string>& warnings, bool all = false);

}  // namespace mdof::tools
