#include "daemon/measure/replay/known_trouble.h"

#include <algorithm>
#include <string>

namespace mdof::daemon {
namespace {

// A replay is the remedy for a damaged run, so the damage is a notice and no error.
Result<Notices> notices_of(store::Store& store, std::int64_t run) {
  auto header = store.run_header(run);
  if (header) return std::move(header->notices);
  if (header.error().code != ErrorCode::bad_input) return tl::unexpected(header.error());
  return Notices{notice(NoticeCode::row_damaged, "", {{"reason", header.error().message}})};
}

}  // namespace

Status add_known_trouble(store::Store& store, Run& run) {
  const Provenance& from = run.header.provenance;
  if (from.recording_kind != "recording") return {};
  MDOF_TRY(const auto same, store.runs_of_recording(from.recording_sha256));
  Notices& notices = run.header.notices;
  for (const std::int64_t id : same) {
    MDOF_TRY(const Notices measured, notices_of(store, id));
    for (const Notice& each : measured) {
      const bool applies = each.code == NoticeCode::device_trouble ||
                           each.code == NoticeCode::blocks_not_recorded ||
                           each.code == NoticeCode::row_damaged;
      if (!applies || !each.source.empty()) continue;  // with a source: inherited by a replay
      const Notice known = inherited("run " + std::to_string(id), each);
      if (std::find(notices.begin(), notices.end(), known) == notices.end())
        notices.push_back(known);
    }
  }
  return {};
}

}  // namespace mdof::daemon
