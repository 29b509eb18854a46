#include "tools/mdof/text/warnings.h"

#include <cctype>
#include <map>

#include "schema/severity.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kKept = 3;

// The text with "0" for each number.
std::string kind_of(const std::string& warning) {
  std::string kind;
  for (const char c : warning) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool inside = !kind.empty() && kind.back() == '0';
    if (!(inside && (digit || c == '.'))) kind += digit ? '0' : c;
  }
  return kind;
}

}  // namespace

std::vector<std::string> summarised(const std::vector<std::string>& warnings, bool all) {
  if (all) return warnings;
  std::map<std::string, std::size_t> count, seen;
  for (const auto& warning : warnings) ++count[kind_of(warning)];
  std::vector<std::string> kept;
  for (const auto& warning : warnings) {
    const std::string kind = kind_of(warning);
    const std::size_t of_kind = count[kind], turn = ++seen[kind];
    if (of_kind <= kKept + 1 || turn <= kKept) kept.push_back(warning);
    if (of_kind > kKept + 1 && turn == kKept)
      kept.push_back(with_severity(
          severity_of(warning),
          "and " + std::to_string(of_kind - kKept) + " more like it; --all-warnings shows them"));
  }
  return kept;
}

}  // namespace mdof::tools
