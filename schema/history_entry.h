// An entry of the history (an audit trail): a change of what is stored, and who asked for it. The
// database's table and the member of the RPC keep their first name, "deed".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

// A process, as the kernel knows it; the name is the user's at that time.
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
  // Given when it is stored.
  std::int64_t id = 0, row = 0;
  std::string subject = {};  // the table with this row: run, squareness, compensation_table,
                             // activation, deactivation, encoder_datum, volumetric_table,
                             // volumetric_activation
  std::string detail = {};   // for people, where there is more to say: setting_text()
};

}  // namespace mdof
