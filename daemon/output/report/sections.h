// Writes the sections of a report: the sections on one run, and the section on two runs of an axis.
#pragma once

#include "daemon/output/report/html.h"
#include "daemon/output/report/report.h"

namespace mdof::report {

void write_conditions(Html& html, const ReportRun& run, Language language);
void write_fixture(Html& html, const ReportRun& run, Language language);
void write_results(Html& html, const ReportRun& run, Language language);
void write_decisions(Html& html, const ReportRun& run, Language language);
// Writes only the table of the decisions on tolerances.
void write_decided(Html& html, const std::vector<Decided>& decided,
                   const std::vector<Budget>& budgets, Language language);
void write_notices(Html& html, const ReportRun& run, Language language);
void write_charts(Html& html, const ReportRun& run, Language language);
void write_points(Html& html, const ReportRun& run, Language language);
void write_provenance(Html& html, const ReportRun& run, Language language);

// Writes the differences between two runs of an axis.
void write_comparison(Html& html, const daemon::Comparison& comparison, Language language);

}  // namespace mdof::report
