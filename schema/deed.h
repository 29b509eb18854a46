// Who did what: each change of state of what is stored, with who asked for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mdof {

// A process, as the kernel knows it; the name is the user's at that time.
struct Doer {
  std::int64_t uid = 0, gid = 0, pid = 0;
  std::string user;
};

struct Deed {
  std::string name;  // "run.start", "run.resume", "run.stop", "run.abort", "run.replay",
                     // "squareness.fit", "compensation.build", ".activate", ".deactivate",
                     // "encoder.set"
  Doer by;
  std::string utc;
  // Given when it is stored.
  std::int64_t id = 0, row = 0;
  std::string subject = {};  // the table with this row: run, squareness, compensation_table,
                             // activation, deactivation, encoder_datum
  std::string detail = {};   // for people, where there is more to say: setting_text()
};

}  // namespace mdof
