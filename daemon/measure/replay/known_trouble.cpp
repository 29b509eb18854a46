#include "daemon/measure/replay/known_trouble.h"

#include <algorithm>
#include <string>

namespace mdof::daemon {

Status add_known_trouble(store::Store& store, Run& run) {
  const Provenance& from = run.header.provenance;
  if (from.recording_kind != "recording") return {};
  MDOF_TRY(const auto same, store.runs_of_recording(from.recording_sha256));
  Notices& notices = run.header.notices;
  for (const std::int64_t id : same) {
    MDOF_TRY(const RunHeader measured, store.run_header(id));
    for (const Notice& each : measured.notices) {
      const bool at_end =
          each.code == NoticeCode::device_trouble || each.code == NoticeCode::blocks_not_recorded;
      if (!at_end || !each.source.empty()) continue;  // a source: of another replay
      const Notice known = inherited("run " + std::to_string(id), each);
      if (std::find(notices.begin(), notices.end(), known) == notices.end())
        notices.push_back(known);
    }
  }
  return {};
}

}  // namespace mdof::daemon
