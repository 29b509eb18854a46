#include "daemon/output/phrases.h"

#include <array>
#include <cstddef>

namespace mdof::output {
namespace {

struct Row {
  const char *english, *german;
};
constexpr std::array kRows = {
#define PHRASE(key, english, german) Row{english, german},
#include "daemon/output/phrases.inc"
#undef PHRASE
};

}  // namespace

bool language_from(std::string_view name, Language& language) {
  if (name != "en" && name != "de") return false;
  language = name == "en" ? Language::english : Language::german;
  return true;
}

const char* code_of(Language language) {
  return language == Language::english ? "en" : "de";
}

const char* phrase(Phrase phrase, Language language) {
  const Row& row = kRows[static_cast<std::size_t>(phrase)];
  return language == Language::english ? row.english : row.german;
}

std::string phrase(Phrase wanted, Language language, std::initializer_list<std::string> values) {
  const std::string pattern = phrase(wanted, language);
  std::string text;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{' || i + 2 >= pattern.size() || pattern[i + 2] != '}') {
      text += pattern[i];
      continue;
    }
    const auto at = static_cast<std::size_t>(pattern[i + 1] - '0');
    if (at < values.size()) text += *(values.begin() + at);
    i += 2;
  }
  return text;
}

const char* state_text(RunState state, Language language) {
  switch (state) {
    case RunState::open:
      return phrase(Phrase::state_open, language);
    case RunState::complete:
      return phrase(Phrase::state_complete, language);
    case RunState::partial:
      return phrase(Phrase::state_partial, language);
    case RunState::aborted:
      return phrase(Phrase::state_aborted, language);
    case RunState::ended:
      return phrase(Phrase::state_ended, language);
    case RunState::failed:
      break;
  }
  return phrase(Phrase::state_failed, language);
}

}  // namespace mdof::output
