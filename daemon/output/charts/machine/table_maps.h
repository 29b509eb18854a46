// The corrections of a table over a plane or a volume, as arrows. Pure.
#pragma once

#include "daemon/output/charts/run/run_charts.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::charts {

// "table-3-XY.svg" and so on: a chart for each plane of two axes with several commands, through the
// middle node of the third axis. A plane with more than kMostArrows nodes is left out, with the
// reason.
RunCharts volumetric_table_charts(const VolumetricTable& table, output::Language language);

}  // namespace mdof::charts
