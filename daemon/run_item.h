// The header of a run as one item of a list or as one message, and the list of runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "daemon/store/store.h"
#include "schema/run.h"

namespace mdof::daemon {

// JSON, much shorter than the limit of a reply. If the header is too long, the note and the notices
// are cut, the options are null (except the signs of an imported run), and "shortened" is true.
std::string header_item(const RunHeader& header,
                        std::optional<std::int64_t> superseded_by = std::nullopt);
RunHeader shortened(RunHeader header);

struct RunListRequest {
  std::int64_t offset = 0, count = 0;
  std::optional<Axis> axis = std::nullopt;
  bool all = false;  // also runs whose targets were renumbered in a new run
};
// The newest run comes first, as in run.list and `mdof runs`. The document contains as many runs as
// fit into `most_bytes`. `explain` may change a header before it is written.
Result<std::string> run_list_document(store::Store& store, const RunListRequest& request,
                                      std::size_t most_bytes,
                                      const std::function<void(RunHeader&)>& explain);

}  // namespace mdof::daemon
