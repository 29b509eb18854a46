#include "daemon/words/error_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

namespace mdof::words {
namespace {

constexpr Remedy kRemedy[] = {
#define REMEDY(code) Remedy::code,
#include "schema/base/remedy/remedies.inc"
#undef REMEDY
};
constexpr std::size_t kRemedies = std::size(kRemedy);

struct RemedyWords {
  const char* english;
  const char* german;
};
constexpr std::array<RemedyWords, kRemedies + 1> kWords = [] {
  std::array<RemedyWords, kRemedies + 1> all{};
  all[0] = {"", ""};
#define REMEDY_WORDS(code, english, german) \
  all[static_cast<std::size_t>(Remedy::code)] = {english, german};
#include "daemon/words/remedies.inc"
#undef REMEDY_WORDS
  return all;
}();
static_assert(std::none_of(kWords.begin(), kWords.end(),
                           [](const RemedyWords& row) { return row.english == nullptr; }),
              "a code of schema/base/remedy/remedies.inc has no row in daemon/words/remedies.inc");

}  // namespace

std::string remedy(Remedy remedy, const std::string& what_for, Language language) {
  const RemedyWords& row = kWords[static_cast<std::size_t>(remedy)];
  Notice subject;
  subject.subject = what_for;
  return filled(language == Language::german ? row.german : row.english, subject, language);
}

std::string text(const Error& error, Language language) {
  if (error.remedy == Remedy::none) return error.message;
  return error.message + "; " + remedy(error.remedy, error.remedy_for, language);
}

}  // namespace mdof::words
