#include "daemon/words/words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include "schema/base/number/number_text.h"

namespace mdof::words {
namespace {

constexpr NoticeCode kAll[] = {
#define NOTICE(code, severity, keys) NoticeCode::code,
#include "schema/notice/notice_codes.inc"
#undef NOTICE
};
constexpr std::size_t kCodes = std::size(kAll);

constexpr std::array<const char*, kCodes> kPatterns = [] {
  std::array<const char*, kCodes> all{};
#define WORDS(code, english) all[static_cast<std::size_t>(NoticeCode::code)] = english;
#include "daemon/words/notices.inc"
#undef WORDS
  return all;
}();
static_assert(std::find(kPatterns.begin(), kPatterns.end(), nullptr) == kPatterns.end(),
              "each code of notice_codes.inc has its words in notices.inc");

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

std::string value_text(const NoticeValue& x, const std::string& format) {
  if (format.starts_with('?')) {
    const auto bar = format.find('|');
    return is_one_or_named(x) ? format.substr(1, bar - 1) : format.substr(bar + 1);
  }
  const double* number = std::get_if<double>(&x);
  return number ? number_text(*number, format) : std::get<std::string>(x);
}

// "key" or "key:format".
std::string field_text(const Notice& notice, const std::string& field) {
  const auto colon = field.find(':');
  const std::string key = field.substr(0, colon);
  const std::string format = colon == std::string::npos ? "" : field.substr(colon + 1);
  if (key == "subject") return value_text(NoticeValue(notice.subject), format);
  const NoticeValue* x = value(notice, key);
  return x ? value_text(*x, format) : "unknown";
}

}  // namespace

const char* pattern(NoticeCode code) {
  return kPatterns[static_cast<std::size_t>(code)];
}

std::string filled(const char* pattern, const Notice& notice) {
  std::string out;
  for (std::string rest = pattern; !rest.empty();) {
    const auto open = rest.find('{');
    out += rest.substr(0, open);
    if (open == std::string::npos) break;
    const auto close = rest.find('}', open);
    out += field_text(notice, rest.substr(open + 1, close - open - 1));
    rest.erase(0, close + 1);
  }
  return out;
}

std::string text(const Notice& notice) {
  const std::string own = filled(pattern(notice.code), notice);
  return notice.source.empty() ? own : notice.source + ": " + own;
}

std::string line(const Notice& notice) {
  const bool marked = notice.severity != Severity::doubtful;
  return marked ? std::string(to_string(notice.severity)) + ": " + text(notice) : text(notice);
}

}  // namespace mdof::words
