// How much a sentence about a run weighs (DESIGN §2). Whoever makes the sentence says it; it is
// kept as the sentence's first word, so that it goes wherever the sentence goes: the database,
// replies, the screen. A sentence without such a word is doubtful, as are all of older databases.
#pragma once

#include <string>
#include <string_view>

namespace mdof {

enum class Severity {
  information,  // a reader should know it; it keeps no result from a controller
  doubtful,     // activation and export ask whether it is meant
  invalid       // what is made of it is refused
};

// The first word of a sentence; "" where it is doubtful.
constexpr std::string_view word_of(Severity severity) {
  switch (severity) {
    case Severity::information:
      return "information: ";
    case Severity::invalid:
      return "invalid: ";
    case Severity::doubtful:
      break;
  }
  return "";
}

inline Severity severity_of(std::string_view sentence) {
  for (const Severity severity : {Severity::information, Severity::invalid})
    if (sentence.starts_with(word_of(severity))) return severity;
  return Severity::doubtful;
}
// Without the word of its severity.
inline std::string_view words_of_sentence(std::string_view sentence) {
  return sentence.substr(word_of(severity_of(sentence)).size());
}

inline std::string with_severity(Severity severity, const std::string& sentence) {
  return std::string(word_of(severity)) + sentence;
}
// "information: the axis was parked ..."
inline std::string information(const std::string& sentence) {
  return with_severity(Severity::information, sentence);
}
inline std::string invalid(const std::string& sentence) {
  return with_severity(Severity::invalid, sentence);
}
// "run 3: the probe ...", the severity as before.
inline std::string said_of(const std::string& subject, const std::string& sentence) {
  return with_severity(severity_of(sentence),
                       subject + ": " + std::string(words_of_sentence(sentence)));
}

}  // namespace mdof
