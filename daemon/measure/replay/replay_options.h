// The numeric and boolean options of a replay. The command line ("--settle-s") and the RPC method
// ("settle_s") use the same list, the same ranges and the same help.
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
  };  // dwells: the option applies only to runs with dwells; motion: only to runs on the fly
  using Number = std::optional<double> ReplayRequest::*;
  using Switch = bool ReplayRequest::*;

  const char* name;  // name in the RPC method; it ends in the unit
  std::variant<Number, Switch> member;
  Range range;  // permitted range of a number
  Of of;
  const char* meaning;  // help text; it contains the default in brackets

  std::string command_line_name() const;  // "--settle-s"
};

// All options, in the order in which the help lists them.
const std::vector<ReplayOption>& replay_options();

// Error (usage): a number is not finite or out of range, or an option does not apply to this kind
// of run. The message names the option.
Status check_replay_options(const ReplayRequest& request);

}  // namespace mdof::daemon
