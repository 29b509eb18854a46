// Writes the header of a run as JSON (for a list or one message), and the list of runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "daemon/store/store.h"
#include "schema/run.h"

namespace mdof::daemon {

// The header as JSON, much shorter than the limit of a reply. If the header is too long, then the
// note and the notices are cut, the options are null, and "shortened" is true. The options that
// determine the signs of the errors of an imported run are kept.
std::string header_item(const RunHeader& header,
                        std::optional<std::int64_t> superseded_by = std::nullopt);
RunHeader shortened(RunHeader header);

struct RunListRequest {
  std::int64_t offset = 0, count = 0;
  std::optional<Axis> axis = std::nullopt;
  bool all = false;  // true: also list runs whose complete result is stored as another run
};
// The document of run.list and `mdof runs --json`. The newest run comes first. The document
// contains as many runs as fit into `most_bytes`. The function `explain` may change a header before
// it is written.
Result<std::string> run_list_document(store::Store& store, const RunListRequest& request,
                                      std::size_t most_bytes,
                                      const std::function<void(RunHeader&)>& explain);

}  // namespace mdof::daemon
