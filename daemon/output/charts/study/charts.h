// Plots of a study. Each plot has a function that takes the figures of the study and returns an SVG
// document. Pure.
#pragma once

#include <string>

#include "schema/study/study.h"

namespace mdof::charts {

// Each function has_X() returns whether there is data for the plot X. Call X_svg() only if has_X()
// is true.
bool has_histogram(const OutputSummary& output);
std::string histogram_svg(const StudyResult& result, const OutputSummary& output);

bool has_bins(const StudyResult& result);
std::string bins_svg(const StudyResult& result);

bool has_indices(const StudyResult& result);
std::string indices_svg(const StudyResult& result);

bool has_convergence(const StudyResult& result);
std::string convergence_svg(const StudyResult& result);

bool has_frontier(const StudyResult& result);
std::string frontier_svg(const StudyResult& result);

}  // namespace mdof::charts
