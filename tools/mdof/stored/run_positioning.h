// Parameters of ISO 230-2 for the straightness and angular errors of a stored run.
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
  std::vector<std::string> errors;  // "EYX"; empty: all five errors.
  bool keep_slope = false;          // For straightness errors; see readings_of_run().
  bool partial = false;             // Accept a partial run.
};

struct RunPositioning {
  std::vector<PositioningColumn> columns;  // One for each error.
  Notices notices;                         // Notices on the run and on its plan.
  bool keep_slope = false;
  std::string U_reason;  // Why U is unknown; empty: U is known.
};

// Calculates the parameters at the reference point of the run. `scale_period_m`: period of the
// scale; 0: unknown. Errors: the run is incomplete, it does not have the error, or it has too few
// visits for the parameters.
Result<RunPositioning> run_positioning(const Run& run, const RunPositioningRequest& request,
                                       double scale_period_m);

std::string run_positioning_json(const Run& run, const RunPositioning& found);
std::string run_positioning_text(const Run& run, const RunPositioning& found, std::size_t width);

}  // namespace mdof::tools
