// Draws the corrections of a volumetric table as arrows. Pure.
#pragma once

#include "daemon/output/charts/run/run_charts.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::charts {

// One chart ("table-3-XY.svg") for each pair of axes that both have several nodes. The chart shows
// the plane through the middle node of the third axis. A plane with more than kMostArrows nodes
// gets no chart; RunCharts::left_out states the reason.
RunCharts volumetric_table_charts(const VolumetricTable& table, output::Language language);

}  // namespace mdof::charts
