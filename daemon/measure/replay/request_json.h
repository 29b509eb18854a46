// What was asked of a run, as the header of its recording keeps it: with it a replay makes the same
// run again, to the bit and with no option given.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/pipeline.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::daemon {

struct AskedFor {
  std::string note;
  Notices notices;  // known when the run began, to be kept with it
  PipelineOptions options;
};

// {"note", "notices", "options": as PipelineOptions::json()}
std::string request_json(const AskedFor& asked);

// What the text does not say stays as in `base`; an empty text says nothing. Error: it is none, or
// has a member that cannot be read, is not known or is there twice, which is named: what a run was
// measured with is understood whole or not at all.
Result<AskedFor> read_request_json(const std::string& text, const PipelineOptions& base);

// The same of PipelineOptions::json(), which the provenance of a run has.
Result<PipelineOptions> read_options_json(const std::string& text, const PipelineOptions& base);

}  // namespace mdof::daemon
