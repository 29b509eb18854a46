// An entry of the history (audit trail): a change of stored data and the client that requested it.
// The table in the database and the member in the RPC have the older name "deed".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

// A client process, as the kernel reports it. `user`: name of the user at that time.
struct Actor {
  std::int64_t uid = 0, gid = 0, pid = 0;
  std::string user;
};

struct HistoryEntry {
  std::string name;  // "run.start", "run.resume", "run.stop", "run.abort", "run.replay",
                     // "run.import", "squareness.fit", "compensation.build", ".build_volume",
                     // ".activate", ".deactivate", "encoder.set"
  Actor by;
  std::string utc;
  // Both are set when the entry is stored.
  std::int64_t id = 0, row = 0;
  // Name of the database table that contains this row: run, squareness, compensation_table,
  // activation, deactivation, encoder_datum, volumetric_table, volumetric_activation.
  std::string subject = {};
  std::string detail = {};  // text for people, if there are details: setting_text()
};

}  // namespace mdof
