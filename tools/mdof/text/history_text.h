// Who did what with a run, for people.
#pragma once

#include <string>
#include <vector>

#include "daemon/history.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {

// A line each, with a title; nothing where nothing is known.
inline std::string history_text(const std::vector<Deed>& deeds, std::size_t width) {
  std::string text = deeds.empty() ? "" : "\nhistory\n";
  for (const Deed& deed : deeds)
    text += wrapped(deed.utc + " run " + std::to_string(deed.row) + ": " + deed.name + " by " +
                        daemon::actor_text(deed.by),
                    width, 2) +
            "\n";
  return text;
}

}  // namespace mdof::tools
