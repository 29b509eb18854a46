// The plots of a study as SVG files, for people and reports.
#pragma once

#include <filesystem>

#include "schema/base/result.h"
#include "schema/study/study.h"

namespace mdof::charts {

// Writes into the folder, which is made where it is missing:
//   histogram-KEY.svg         each output with a solved trial: histogram, mean, coverage intervals
//   error-against-travel.svg  where the study has bins (named after the binned quantity)
//   sensitivity.svg           where it has indices
//   convergence.svg           where it has a history
//   allocation.svg            where an allocation has a frontier
// The same figures give the same bytes: times of day and durations are in none. Each file is whole
// or absent, files of the same name are replaced, others stay. Everything is in the units that end
// the keys. Error: io, naming the folder or file and the remedy. Any thread.
Status write_study_plots(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace mdof::charts
