#include "algo/sequence/ranges_text.h"

#include <cstddef>

namespace mdof::algo {

std::string ranges_text(const std::vector<int>& ascending) {
  std::string out;
  for (std::size_t i = 0; i < ascending.size();) {
    std::size_t last = i;
    while (last + 1 < ascending.size() && ascending[last + 1] == ascending[last] + 1) ++last;
    if (!out.empty()) out += ", ";
    out += std::to_string(ascending[i]);
    if (last > i) out += (last == i + 1 ? ", " : " to ") + std::to_string(ascending[last]);
    i = last + 1;
  }
  return out;
}

std::string numbered(const char* what, const std::vector<int>& ascending) {
  return what + std::string(ascending.size() == 1 ? " " : "s ") + ranges_text(ascending);
}

}  // namespace mdof::algo
