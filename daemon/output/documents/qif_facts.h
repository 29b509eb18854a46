// Writes the facts about the measurement into a QIF document.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "daemon/output/documents/xml.h"
#include "daemon/output/report/report.h"

namespace mdof::documents {

using Attribute = std::pair<std::string, std::string>;  // name and value

// `stated`: the statements of the user.
std::vector<Attribute> facts_of(const report::ReportRun& run, const ReportFacts& stated);

// Writes the element InspectionTraceability.
void write_traceability(Xml& xml, const report::ReportRun& run, const ReportFacts& facts);

}  // namespace mdof::documents
