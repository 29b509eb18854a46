// What a reader of a result should know, as data: a code, how much it weighs, what it is about and
// named numbers. The words stand in daemon/words, so that a client branches on the code and a word
// may change without changing what is stored.
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
  information,  // a reader should know it; it keeps no result from a controller
  doubtful,     // activation and export ask whether it is meant
  invalid       // what is made of it is refused
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

// A number in the unit at the end of its key, or a name.
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
  // Of its code; of `legacy`, `more_alike`, `not_shown` and a table's `datum_missing` its own.
  Severity severity = Severity::doubtful;
  std::string subject;  // a probe, a plane, a device by its name; empty: the whole
  std::vector<std::pair<std::string, NoticeValue>> values;
  std::string source;  // the result that it is inherited from, "run 3"; empty: this one

  bool operator==(const Notice&) const = default;
};
using Notices = std::vector<Notice>;

// With the severity of the code, and its keys in their order: else a bug, which is asserted.
Notice notice(NoticeCode code, const std::string& subject = "",
              std::initializer_list<std::pair<std::string_view, NoticeValue>> values = {});

// The same notice of another result: inherited from `source`, which comes before its own.
Notice inherited(const std::string& source, Notice notice);

// nullptr: it has no such value.
const NoticeValue* value(const Notice& notice, std::string_view key);

// What each code carries, one blank between keys.
std::string_view keys(NoticeCode code);
Severity severity(NoticeCode code);

void append(Notices& to, Notices more);
// Those of one code: at most ten, then `more_alike` with their code and how many are left out.
void append_first(Notices& to, Notices alike);

}  // namespace mdof
