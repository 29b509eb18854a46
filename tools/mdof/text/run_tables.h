// A run as tables, at most `width` characters wide.
#pragma once

#include <string>
#include <vector>

#include "schema/iso230/reference_lines.h"
#include "schema/iso230/squareness.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/noise_only.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::tools {

// "SIMULATED DATA: ..." with a line end, or empty.
std::string simulated_notice(bool simulated);

// The first line of the output if the uncertainties contain noise only; otherwise empty.
std::string noise_only_notice(NoiseOnly noise_only);
std::string noise_only_notice(bool noise_only);
// The same line as a comment in a CSV or TOML file.
std::string noise_only_comment(NoiseOnly noise_only);
std::string noise_only_comment(bool noise_only);

// One line that states the reference point of the straightness errors.
std::string stated_text(const StatedAt& at);

// If `means` is true and the run has means: the mean errors at each target, and the points with
// flags or without errors. Otherwise all points. Then the plausibility of the run.
std::string points_or_means_text(const Run& run, const RunUncertainty& uncertainty,
                                 std::size_t width, bool means);

// Identity, provenance and notices of the run. `result_sha256` may be empty.
std::string head_text(const RunHeader& header, const std::string& result_sha256, std::size_t width,
                      bool all_warnings = false);
// A table of the points: five errors ± u, number of samples, flags.
std::string points_text(const Run& run, const RunUncertainty& uncertainty, std::size_t width);
// A table of the straightness figures. The mean slopes have ± u if `budgets` contains them.
std::string straightness_text(const std::vector<StraightnessFigure>& figures,
                              const std::vector<Budget>& budgets, std::size_t width);
std::string minimum_zone_text(const std::vector<StraightnessLines>& lines, std::size_t width);
std::string angles_text(const std::vector<AngleFigure>& figures, std::size_t width);

std::string arrow(int direction);                 // "+", "-", "?"
std::string error_label(const std::string& key);  // "EYX_um" -> "EYX/µm"

}  // namespace mdof::tools
