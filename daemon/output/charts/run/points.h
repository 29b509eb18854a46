// Converts the points of a run to the symbols that a chart shows (Mark).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof::charts {

// The symbols of one error: y in µm or µrad, x in mm. `named`: index of the error in error_names().
std::vector<Mark> error_marks(const StatedResults& results, std::size_t named);
Legend marks_legend(std::span<const Mark> marks);

// The title of a chart: "run 3, axis X: " followed by `what`.
std::string run_title(const RunHeader& header, const std::string& what, Language language);
// "model rigid, complete, recording 0f3a…". The text contains no time, because a replay must make
// the same bytes.
std::string about_run(const RunHeader& header, Language language);

// Warnings for the top of a chart. If u contains noise only, the first warning states this. The
// warnings in `marks` follow.
std::vector<std::string> with_noise_only_mark(NoiseOnly noise_only, std::vector<std::string> marks,
                                              output::Language language);
std::vector<std::string> with_noise_only_mark(bool noise_only, std::vector<std::string> marks,
                                              Language language);

// The key of the position axis for draw_axes(): "position_mm" in English.
std::string position_key(Language language);

}  // namespace mdof::charts
