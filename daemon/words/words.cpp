#include "daemon/words/words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <span>
#include <string_view>

#include "schema/base/number/number_text.h"

namespace mdof::words {
namespace {

constexpr NoticeCode kAll[] = {
#define NOTICE(code, severity, keys) NoticeCode::code,
#include "schema/notice/notice_codes.inc"
#undef NOTICE
};
constexpr std::size_t kCodes = std::size(kAll);

struct Pattern {
  const char* english;
  const char* german;
};
constexpr std::array<Pattern, kCodes> kPatterns = [] {
  std::array<Pattern, kCodes> all{};
#define WORDS(code, english, german) \
  all[static_cast<std::size_t>(NoticeCode::code)] = {english, german};
#include "daemon/words/notices.inc"
#undef WORDS
  return all;
}();
static_assert(std::none_of(kPatterns.begin(), kPatterns.end(),
                           [](const Pattern& p) { return p.english == nullptr; }),
              "a code of schema/notice/notice_codes.inc has no row in daemon/words/notices/");

// English words in values of notices, and their German words. Examples of values: "targets 1 to 3",
// "forward", "the end" (of a log).
struct GermanName {
  std::string_view english, german;
};
constexpr GermanName kNames[] = {
    {"forward", "vorwärts"},
    {"reverse", "rückwärts"},
    {"any target", "irgendeiner Sollposition"},
    {"target ", "Sollposition "},
    {"targets ", "Sollpositionen "},
    {"run ", "Lauf "},
    {"runs ", "Läufe "},
    {"the end", "zum Ende"},
    {"no drift can be distinguished from noise, steps and a variation whose period is about the "
     "duration of one run",
     "keine Drift lässt sich von Rauschen, Sprüngen und einer Schwankung unterscheiden, deren "
     "Periode etwa die Dauer eines Laufs ist"},
    {"no change is significant", "keine Änderung ist signifikant"}};
// Words within a list of numbers or names, and within the text of a drift.
constexpr GermanName kInList[] = {{" to ", " bis "}, {" and ", " und "}};
constexpr GermanName kInDrift[] = {
    {" from the first point to the last (", " vom ersten Messpunkt bis zum letzten ("}};

std::string with_german(std::string text, std::span<const GermanName> words) {
  for (const auto& [english, german] : words)
    for (auto at = text.find(english); at != std::string::npos; at = text.find(english, at + 1))
      text.replace(at, english.size(), german);
  return text;
}

std::string german_name(const std::string& name) {
  for (const auto& [english, german] : kNames) {
    const bool whole = !english.ends_with(' ');
    if (whole ? name == english : name.starts_with(english))
      return std::string(german) + with_german(name.substr(english.size()), kInList);
  }
  const bool is_list = !name.empty() && name[0] >= '0' && name[0] <= '9';
  return is_list ? with_german(name, kInList) : with_german(name, kInDrift);
}

// The source "run 3" is a stored run ("Messung"). In values of notices, a run is one pass over the
// targets ("Lauf").
std::string source_text(const std::string& source, Language language) {
  const bool is_run = source.starts_with("run ");
  return language == Language::german && is_run ? "Messung " + source.substr(4) : source;
}

std::string number_text(double x, const std::string& format) {
  if (format.empty()) return plain_number(x);
  if (format.find('.') == std::string::npos) return plain_number(x, std::atoi(format.c_str()));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), ("%" + format).c_str(), x);
  return text.data();
}

bool is_one_or_named(const NoticeValue& x) {
  const double* number = std::get_if<double>(&x);
  return number ? *number == 1 : !std::get<std::string>(x).empty();
}

std::string value_text(const NoticeValue& x, const std::string& format, Language language) {
  if (format.starts_with('?')) {
    const auto bar = format.find('|');
    return is_one_or_named(x) ? format.substr(1, bar - 1) : format.substr(bar + 1);
  }
  const double* number = std::get_if<double>(&x);
  if (number) return number_text(*number, format);
  const std::string& name = std::get<std::string>(x);
  return language == Language::german ? german_name(name) : name;
}

// The text of a field. `field`: "key" or "key:format".
std::string field_text(const Notice& notice, const std::string& field, Language language) {
  const auto colon = field.find(':');
  const std::string key = field.substr(0, colon);
  const std::string format = colon == std::string::npos ? "" : field.substr(colon + 1);
  if (key == "subject") return value_text(NoticeValue(notice.subject), format, Language::english);
  if (const NoticeValue* x = value(notice, key)) return value_text(*x, format, language);
  return language == Language::german ? "unbekannt" : "unknown";
}

}  // namespace

const char* pattern(NoticeCode code, Language language) {
  const Pattern& row = kPatterns[static_cast<std::size_t>(code)];
  return language == Language::german ? row.german : row.english;
}

std::string filled(const char* pattern, const Notice& notice, Language language) {
  std::string out;
  for (std::string rest = pattern; !rest.empty();) {
    const auto open = rest.find('{');
    out += rest.substr(0, open);
    if (open == std::string::npos) break;
    const auto close = rest.find('}', open);
    out += field_text(notice, rest.substr(open + 1, close - open - 1), language);
    rest.erase(0, close + 1);
  }
  return out;
}

std::string text(const Notice& notice) {
  return text(notice, Language::english);
}

std::string text(const Notice& notice, Language language) {
  const std::string own = filled(pattern(notice.code, language), notice, language);
  return notice.source.empty() ? own : source_text(notice.source, language) + ": " + own;
}

std::string line(const Notice& notice, Language language) {
  std::string own = text(notice, language);
  if (notice.severity == Severity::doubtful) return own;
  if (language == Language::english) return std::string(to_string(notice.severity)) + ": " + own;
  return (notice.severity == Severity::invalid ? "ungültig: " : "Hinweis: ") + own;
}

std::string text(const Covers& covers, Language language) {
  static constexpr std::array kGerman = {
#define COVERED(code, english, german) german,
#include "schema/uncertainty/covers.inc"
#undef COVERED
  };
  if (language == Language::english) return covers_text(covers);
  std::string sentence;
  for (const Covered each : covers) sentence += kGerman[static_cast<std::size_t>(each)];
  return sentence;
}

std::string text(const ContributorName& name, Language language) {
  static constexpr std::array kGerman = {
#define CONTRIBUTOR(code, english, german) german,
#include "schema/uncertainty/contributor_names.inc"
#undef CONTRIBUTOR
  };
  if (language == Language::english) return contributor_text(name);
  return contributor_text(name, kGerman[static_cast<std::size_t>(name.kind)], "und");
}

}  // namespace mdof::words
