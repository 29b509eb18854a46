#include "schema/notice/notice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

namespace mdof {
namespace {

constexpr std::size_t kMaxNoticesPerCode = 10;

struct CodeRow {
  const char* name;
  Severity severity;
  std::string_view keys;
};
constexpr CodeRow kCodes[] = {
#define NOTICE(code, severity, keys) {#code, Severity::severity, keys},
#include "schema/notice/notice_codes.inc"
#undef NOTICE
};

const CodeRow& row_of(NoticeCode code) {
  return kCodes[static_cast<std::size_t>(code)];
}

[[maybe_unused]] std::string keys_of(const Notice& notice) {
  std::string all;
  for (const auto& [key, x] : notice.values) all += (all.empty() ? "" : " ") + key;
  return all;
}

}  // namespace

const char* to_string(Severity severity) {
  switch (severity) {
    case Severity::information:
      return "information";
    case Severity::doubtful:
      return "doubtful";
    case Severity::invalid:
      break;
  }
  return "invalid";
}

const char* to_string(NoticeCode code) {
  return row_of(code).name;
}

std::optional<NoticeCode> notice_code_from(std::string_view name) {
  const auto at = std::find_if(std::begin(kCodes), std::end(kCodes),
                               [&](const CodeRow& row) { return row.name == name; });
  if (at == std::end(kCodes)) return {};
  return static_cast<NoticeCode>(at - std::begin(kCodes));
}

std::string_view keys(NoticeCode code) {
  return row_of(code).keys;
}

Severity severity(NoticeCode code) {
  return row_of(code).severity;
}

Notice notice(NoticeCode code, const std::string& subject,
              std::initializer_list<std::pair<std::string_view, NoticeValue>> values) {
  Notice made{code, row_of(code).severity, subject, {}, ""};
  for (const auto& [key, x] : values) made.values.emplace_back(key, x);
  assert(keys_of(made) == keys(code));
  return made;
}

Notice inherited(const std::string& source, Notice notice) {
  notice.source = notice.source.empty() ? source : source + ": " + notice.source;
  return notice;
}

const NoticeValue* value(const Notice& notice, std::string_view key) {
  const auto at = std::find_if(notice.values.begin(), notice.values.end(),
                               [&](const auto& pair) { return pair.first == key; });
  return at == notice.values.end() ? nullptr : &at->second;
}

void append(Notices& to, Notices more) {
  std::move(more.begin(), more.end(), std::back_inserter(to));
}

void append_first(Notices& to, Notices alike) {
  const std::size_t more = alike.size() - std::min(alike.size(), kMaxNoticesPerCode);
  alike.resize(alike.size() - more);
  if (more > 0) {
    const Notice& last = alike.back();
    Notice left_out = notice(NoticeCode::more_alike, last.subject,
                             {{"count", more}, {"alike", to_string(last.code)}});
    left_out.severity = last.severity;
    alike.push_back(std::move(left_out));
  }
  append(to, std::move(alike));
}

}  // namespace mdof
