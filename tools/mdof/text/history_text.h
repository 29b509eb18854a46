// The recorded actions on a run as text.
#pragma once

#include <string>
#include <vector>

#include "daemon/history.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {

// A title, and one line for each action. Empty if there are no actions.
inline std::string history_text(const std::vector<HistoryEntry>& actions, std::size_t width) {
  std::string text = actions.empty() ? "" : "\nhistory\n";
  for (const HistoryEntry& action : actions)
    text += wrapped(action.utc + " run " + std::to_string(action.row) + ": " + action.name +
                        " by " + daemon::actor_text(action.by),
                    width, 2) +
            "\n";
  return text;
}

}  // namespace mdof::tools
