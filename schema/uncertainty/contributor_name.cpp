#include "schema/uncertainty/contributor_name.h"

#include <array>

namespace mdof {
namespace {

constexpr std::array kContributorWords = {
#define CONTRIBUTOR(code, english, german) english,
#include "schema/uncertainty/contributor_names.inc"
#undef CONTRIBUTOR
};

}  // namespace

std::string contributor_text(const ContributorName& name, std::string_view pattern,
                             std::string_view and_word) {
  constexpr std::string_view kSubject = "{subject}";
  std::string text;
  for (const std::string& run : name.runs) {
    if (!text.empty()) text += " " + std::string(and_word) + " ";
    text += run;
  }
  if (!text.empty()) text += ", ";
  const std::size_t at = pattern.find(kSubject);
  text += pattern.substr(0, at);
  if (at != std::string_view::npos)
    text += name.subject + std::string(pattern.substr(at + kSubject.size()));
  return text;
}

std::string contributor_text(const ContributorName& name) {
  return contributor_text(name, kContributorWords[static_cast<std::size_t>(name.kind)], "and");
}

}  // namespace mdof
