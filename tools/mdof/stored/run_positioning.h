// The parameters of ISO 230-2 of the straightness and angular errors of a stored run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/run.h"
#include "tools/mdof/text/analyses/positioning_text.h"

namespace mdof::tools {

struct RunPositioningRequest {
  std::vector<std::string> errors;  // "EYX"; none: all five
  bool keep_slope = false;          // of a straightness error: see readings_of_run()
  bool partial = false;             // take a partial run as well
};

struct RunPositioning {
  std::vector<PositioningColumn> columns;  // one an error
  Notices notices;                         // of the run and of its plan
  bool keep_slope = false;
  std::string U_reason;  // why U is not known; "": it is
};

// At the point where the run is stated; scale_period_m 0: not known. Errors: the run is not
// complete, has no such error, or its visits give no figures.
Result<RunPositioning> run_positioning(const Run& run, const RunPositioningRequest& request,
                                       double scale_period_m);

std::string run_positioning_json(const Run& run, const RunPositioning& found);
std::string run_positioning_text(const Run& run, const RunPositioning& found, std::size_t width);

}  // namespace mdof::tools
