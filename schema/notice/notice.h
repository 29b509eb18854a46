// A notice for the reader of a result, as data: a code, a severity, a subject and named numbers.
// The texts are in daemon/words, so that a client branches on the code and a text may change
// without a change of stored data.
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
  information,  // information for the reader; the result can still be activated and exported
  doubtful,     // activation and export require confirmation
  invalid       // results built from it are rejected
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
  // Severity of the code; `legacy`, `more_alike`, `not_shown` and the `datum_missing` of a table
  // have their own.
  Severity severity = Severity::doubtful;
  std::string subject;  // name of a probe, a plane or a device; empty: the whole result
  std::vector<std::pair<std::string, NoticeValue>> values;
  std::string source;  // result that the notice was inherited from, "run 3"; empty: this result

  bool operator==(const Notice&) const = default;
};
using Notices = std::vector<Notice>;

// A notice with the severity of the code. The keys must be those of the code in their order
// (asserted).
Notice notice(NoticeCode code, const std::string& subject = "",
              std::initializer_list<std::pair<std::string_view, NoticeValue>> values = {});

// The same notice for another result; `source` is put before its own source.
Notice inherited(const std::string& source, Notice notice);

// nullptr: the notice has no value of this key.
const NoticeValue* value(const Notice& notice, std::string_view key);

// Keys of a code, separated by one blank.
std::string_view keys(NoticeCode code);
Severity severity(NoticeCode code);

void append(Notices& to, Notices more);
// Appends notices of one code: at most ten, then `more_alike` with their code and the number
// omitted.
void append_first(Notices& to, Notices alike);

}  // namespace mdof
