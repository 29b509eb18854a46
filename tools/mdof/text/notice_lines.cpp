#include "tools/mdof/text/notice_lines.h"

#include <map>
#include <string>
#include <utility>

#include "daemon/words/words.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kKept = 3;

// Whether a notice has a text of its own. Such notices are never summarised.
bool has_individual_text(const Notice& notice) {
  return notice.code == NoticeCode::legacy || notice.code == NoticeCode::failure;
}

}  // namespace

Notices summarised(const Notices& notices, bool all) {
  if (all) return notices;
  using Kind = std::pair<NoticeCode, std::string>;
  std::map<Kind, std::size_t> count, seen;
  for (const Notice& each : notices) ++count[{each.code, each.subject}];
  Notices kept;
  for (const Notice& each : notices) {
    const std::size_t alike = has_individual_text(each) ? 1 : count[{each.code, each.subject}];
    const std::size_t turn = ++seen[{each.code, each.subject}];
    if (alike <= kKept + 1 || turn <= kKept) kept.push_back(each);
    if (alike <= kKept + 1 || turn != kKept) continue;
    Notice more = notice(NoticeCode::not_shown, "", {{"count", alike - kKept}});
    more.severity = each.severity;
    kept.push_back(std::move(more));
  }
  return kept;
}

void show_notices(const Notices& notices, bool all) {
  for (const Notice& each : summarised(notices, all))
    each.severity == Severity::doubtful      ? warn(words::line(each))
    : each.severity == Severity::information ? say("note: " + words::text(each))
                                             : say(words::line(each));
}

}  // namespace mdof::tools
