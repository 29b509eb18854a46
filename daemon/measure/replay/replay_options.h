// The numeric and boolean options of a replay. The command line ("--settle-s") and the RPC
// ("settle_s") share this list, the ranges and the help.
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
  };  // dwells: only runs with dwells; motion: only runs on the fly
  using Number = std::optional<double> ReplayRequest::*;
  using Switch = bool ReplayRequest::*;

  const char* name;  // RPC name, with its unit
  std::variant<Number, Switch> member;
  Range range;  // range of a number
  Of of;
  const char* meaning;  // help text, with the default in brackets

  std::string command_line_name() const;  // "--settle-s"
};

// In the order of the help.
const std::vector<ReplayOption>& replay_options();

// Error (usage): a number that is not finite or out of range, or an option that does not apply to
// this kind of run. The message names the option.
Status check_replay_options(const ReplayRequest& request);

}  // namespace mdof::daemon
