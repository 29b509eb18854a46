// The plots of a study as SVG files.
#pragma once

#include <filesystem>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::charts {

// Writes into the folder, which is created if missing:
//   histogram-KEY.svg         each output with a solved trial: histogram, mean, coverage intervals
//   error-against-travel.svg  if the study has bins (named after the binned quantity)
//   sensitivity.svg           if it has indices
//   convergence.svg           if it has a history
//   allocation.svg            if an allocation has a frontier
// The same figures give the same bytes, because no file contains a time or duration. Each file is
// complete or absent. Files of the same name are replaced; other files stay. Numbers are in the
// units at the ends of the keys. Error: io, with the folder or file and the remedy. Any thread.
Status write_study_plots(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace mdof::charts
