// The points of a run as marks of a chart.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "schema/uncertainty/noise_only.h"

namespace mdof::charts {

// Marks of one error, by its index in error_names(), in µm or µrad over mm.
std::vector<Mark> error_marks(const StatedResults& results, std::size_t named);
Legend marks_legend(std::span<const Mark> marks);

// "run 3, axis X: five geometric errors against position"
std::string run_title(const RunHeader& header, const std::string& what, Language language);
// "model rigid, complete, recording 0f3a…", without a time, so that a replay gives the same bytes.
std::string about_run(const RunHeader& header, Language language);

// The marks of a head; the mark that u is from noise only comes first.
std::vector<std::string> with_noise_only_mark(NoiseOnly noise_only, std::vector<std::string> marks,
                                              output::Language language);
std::vector<std::string> with_noise_only_mark(bool noise_only, std::vector<std::string> marks,
                                              Language language);

// "position_mm" with its word in the language, for draw_axes().
std::string position_key(Language language);

}  // namespace mdof::charts
