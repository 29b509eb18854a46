// A notice for the reader of a result. It is stored as data: a code, a severity, a subject and
// named values. The texts are in daemon/words. Therefore a client can decide by the code, and a
// text may change without a change of stored data.
#pragma once

#include <concepts>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace mdof {

enum class Severity {
  information,  // the result can be activated and exported
  doubtful,     // activation and export require confirmation
  invalid       // results that are built from this result are rejected
};
const char* to_string(Severity severity);

enum class NoticeCode {
#define NOTICE(code, severity, keys) code,
#include "schema/notice/notice_codes.inc"
#undef NOTICE
};
// "probe_frozen"
const char* to_string(NoticeCode code);
std::optional<NoticeCode> notice_code_from(std::string_view name);

// A number in the unit at the end of its key, or a text.
struct NoticeValue : std::variant<double, std::string> {
  NoticeValue() = default;
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> NoticeValue(Number x)
      : variant(static_cast<double>(x)) {}
  NoticeValue(std::string name) : variant(std::move(name)) {}
  NoticeValue(const char* name) : variant(std::string(name)) {}
};

struct Notice {
  NoticeCode code = NoticeCode::legacy;
  // The severity of the code. The codes `legacy`, `more_alike` and `not_shown`, and `datum_missing`
  // and `position_lost` of a table, may have another severity.
  Severity severity = Severity::doubtful;
  std::string subject;  // name of a probe, a plane or a device; empty: the whole result
  std::vector<std::pair<std::string, NoticeValue>> values;
  // The result from which the notice was taken over, "run 3"; empty: this result.
  std::string source;

  bool operator==(const Notice&) const = default;
};
using Notices = std::vector<Notice>;

// Makes a notice with the severity of the code. The keys of `values` must be the keys of the code,
// in the same order (asserted).
Notice notice(NoticeCode code, const std::string& subject = "",
              std::initializer_list<std::pair<std::string_view, NoticeValue>> values = {});

// Returns the notice for a result that takes it over from `source` ("run 3"). If the notice already
// has a source, the result has both: "table 2: run 3".
Notice inherited(const std::string& source, Notice notice);

// Returns the value with this key; nullptr: the notice has no such value.
const NoticeValue* value(const Notice& notice, std::string_view key);

// Keys of a code, separated by one space.
std::string_view keys(NoticeCode code);
Severity severity(NoticeCode code);

void append(Notices& to, Notices more);
// Appends notices that all have the same code: at most ten, then the notice `more_alike` with this
// code and the number of omitted notices.
void append_first(Notices& to, Notices alike);

}  // namespace mdof
