// The options of a replay that are a number or a switch: one description for the command line
// ("--settle-s"), the RPC ("settle_s"), their bounds and their help.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "daemon/measure/replay/replay_request.h"

namespace mdof::daemon {

struct ReplayOption {
  enum class Range { any, not_negative, positive };
  enum class Of {
    each_run,
    dwells,
    motion
  };  // dwells: not of a run on the fly; motion: of that alone
  using Number = std::optional<double> ReplayRequest::*;
  using Switch = bool ReplayRequest::*;

  const char* name;  // of the RPC, with its unit
  std::variant<Number, Switch> member;
  Range range;  // of a number
  Of of;
  const char* meaning;  // with the default in brackets

  std::string command_line_name() const;  // "--settle-s"
};

// In the order in which they are shown.
const std::vector<ReplayOption>& replay_options();

// Error (usage): a number that is not finite or outside its range, or an option that is not of such
// a run, by its name.
Status check_replay_options(const ReplayRequest& request);

}  // namespace mdof::daemon
