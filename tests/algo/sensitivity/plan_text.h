// Texts of plans for tests.
#pragma once

#include <string>

namespace mdof::algo {

inline std::string quantity(const std::string& name, const std::string& distribution) {
  return "[[quantity]]\nname = \"" + name + "\"\n" + distribution + "\n";
}

}  // namespace mdof::algo
