// The request of a run as JSON. The header of the recording contains this text. A replay without
// own options uses the recorded request, so that the result of the replay is bit-identical.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/pipeline.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct RecordedRequest {
  std::string note;
  Notices notices;  // notices that were known at the start of the run
  PipelineOptions options;
};

// {"note", "notices", "options"}; "options" is PipelineOptions::json().
std::string request_json(const RecordedRequest& asked);

// Reads the text. If a member is missing in the text, the option of `base` is used. An empty text
// means the options of `base`. Error: the text is not JSON, or has a member that is unreadable,
// unknown or repeated. The message names this member. Unknown members are an error, because the
// result of a replay depends on every member.
Result<RecordedRequest> read_request_json(const std::string& text, const PipelineOptions& base);

// The same for the text of PipelineOptions::json(). The provenance of a run contains this text.
Result<PipelineOptions> read_options_json(const std::string& text, const PipelineOptions& base);

}  // namespace mdof::daemon
