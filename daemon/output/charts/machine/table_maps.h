// The corrections of a table over a plane or a volume, as arrows. Pure.
#pragma once

#include "daemon/output/charts/run/run_charts.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::charts {

// "table-3-XY.svg" and so on: each plane of two axes that have several commands, through the middle
// node of the third axis. A plane of more than kMostArrows nodes is left out, and why.
RunCharts charts_of_volume(const VolumetricTable& table, output::Language language);

}  // namespace mdof::charts
