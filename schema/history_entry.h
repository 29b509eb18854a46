// An entry of the history (an audit trail): a change of stored data, and who requested it. The
// table of the database and the member of the RPC keep their first name, "deed".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

// A client process as reported by the kernel; `user` is the name of the user at that time.
struct Actor {
  std::int64_t uid = 0, gid = 0, pid = 0;
  std::string user;
};

struct HistoryEntry {
  std::string name;  // "run.start", "run.resume", "run.stop", "run.abort", "run.replay",
                     // "squareness.fit", "compensation.build", ".build_volume", ".activate",
                     // ".deactivate", "encoder.set"
  Actor by;
  std::string utc;
  // Set when it is stored.
  std::int64_t id = 0, row = 0;
  std::string subject = {};  // the table with this row: run, squareness, compensation_table,
                             // activation, deactivation, encoder_datum, volumetric_table,
                             // volumetric_activation
  std::string detail = {};   // text for people, where there are details: setting_text()
};

}  // namespace mdof
