// The request of a run, as stored in the header of its recording. With it a replay without options
// gives the same run, bit-identical.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/pipeline.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct RecordedRequest {
  std::string note;
  Notices notices;  // known at the start of the run, stored with it
  PipelineOptions options;
};

// {"note", "notices", "options": as PipelineOptions::json()}
std::string request_json(const RecordedRequest& asked);

// Members that the text lacks stay as in `base`; an empty text changes nothing. Error: the text is
// not JSON, or has a member that is unreadable, unknown or repeated (the message names it). The
// text must be understood completely, because a replay depends on all of it.
Result<RecordedRequest> read_request_json(const std::string& text, const PipelineOptions& base);

// The same for PipelineOptions::json(), which is in the provenance of a run.
Result<PipelineOptions> read_options_json(const std::string& text, const PipelineOptions& base);

}  // namespace mdof::daemon
