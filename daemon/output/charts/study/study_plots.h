// The plots of a study as SVG files.
#pragma once

#include <filesystem>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::charts {

// Writes into the folder, which is created if missing:
//   histogram-KEY.svg         each output with a solved trial: histogram, mean, coverage intervals
//   error-against-travel.svg  if the study has bins (named after the binned quantity)
//   sensitivity.svg           if the study has indices
//   convergence.svg           if the study has a history
//   allocation.svg            if an allocation has a frontier
// Equal figures make equal bytes, because no file contains a time or duration. A file is written
// either completely or not at all. Existing files with these names are replaced. The key of a
// number ends with its unit. Error (io): the message names the folder or file, and the remedy. Can
// be called on any thread.
Status write_study_plots(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace mdof::charts
