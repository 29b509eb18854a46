// Formats notices for comparisons in tests. The text contains codes and values, but no sentences.
#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "schema/base/number/number_text.h"
#include "schema/notice/notice.h"

namespace mdof::test {

// "run 3: probe_stepped E step_um=0.5 time_s=2": source, code, subject, and values with six digits.
inline std::string shown(const Notice& notice) {
  std::string out = notice.source.empty() ? "" : notice.source + ": ";
  out += to_string(notice.code);
  if (!notice.subject.empty()) out += " " + notice.subject;
  for (const auto& [key, x] : notice.values) {
    const double* number = std::get_if<double>(&x);
    out += " " + key + "=" + (number ? plain_number(*number, 6) : std::get<std::string>(x));
  }
  return out;
}

// One line for each notice.
inline std::string shown(const Notices& notices) {
  std::string out;
  for (const Notice& each : notices) out += shown(each) + "\n";
  return out;
}

inline bool has(const Notices& notices, NoticeCode code) {
  return std::any_of(notices.begin(), notices.end(),
                     [code](const Notice& each) { return each.code == code; });
}

// The value of a key; NaN if the notice has no number with this key.
inline double number(const Notice& notice, std::string_view key) {
  const NoticeValue* x = value(notice, key);
  const double* found = x ? std::get_if<double>(x) : nullptr;
  return found ? *found : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mdof::test
