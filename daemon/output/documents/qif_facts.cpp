#include "daemon/output/documents/qif_facts.h"

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/svg.h"
#include "daemon/output/report/measured_days.h"
#include "daemon/words/words.h"
#include "schema/axis.h"
#include "schema/rig/reference.h"

namespace mdof::documents {

using report::ReportRun;

namespace {

// The statements of the user about the measurement, and the days on which the run was recorded.
std::vector<Attribute> circumstances_of(const ReportRun& run, const ReportFacts& facts) {
  auto days = report::recorded_days(run);
  if (!facts.date.empty()) days = {facts.date, facts.date};
  return {{"first day of the measurement", stated(days ? days->first : "")},
          {"last day of the measurement", stated(days ? days->last : "")},
          {"place of the measurement", stated(facts.place)},
          {"conditions as stated", stated(facts.conditions)}};
}

}  // namespace

std::vector<Attribute> facts_of(const ReportRun& run, const ReportFacts& stated_facts) {
  const RunHeader& header = run.results.run.header;
  std::vector<Attribute> facts = {
      {"run", std::to_string(header.id)},
      {"axis", std::string(1, letter(header.axis))},
      {"state", to_string(header.state)},
      {"simulated", header.simulated ? "true" : "false"},
      {"U covers", covers_text(run.results.uncertainty)},
      {"SHA-256 of the recording", header.provenance.recording_sha256},
      {"SHA-256 of the result", run.result_sha256},
      {"measured with", header.provenance.software_version},
      {"straightness refers to", reference_text(header.stated)},
      {"reference line of straightness", "least-squares line (ISO 230-1)"},
      {"moving body, travel", std::string(header.sides.moves()) + ", " + header.sides.travel()}};
  std::string keys;
  for (const std::string& key : run.results.uncertainty.not_declared)
    keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty())
    facts.emplace_back("uncertainties that the rig does not declare, so that U is too small", keys);
  if (run.superseded_by)
    facts.emplace_back("superseded by run", std::to_string(*run.superseded_by));
  if (const std::string approach = daemon::only_approach(run.results.run); !approach.empty())
    facts.emplace_back("only measured approach", approach);
  for (const std::string& mark : charts::with_noise_only_mark(
           run.results.uncertainty.noise_only, daemon::warning_marks(run.results.run),
           output::Language::english))
    facts.emplace_back("warning", mark);
  for (const Notice& notice : header.notices)
    facts.emplace_back(to_string(notice.severity), words::text(notice, output::Language::english));
  facts.emplace_back("temperature: mean, lowest, highest / degree Celsius",
                     !header.temperature
                         ? "not recorded"
                         : charts::exact_text(header.temperature->mean_C) + ", " +
                               charts::exact_text(header.temperature->min_C) + ", " +
                               charts::exact_text(header.temperature->max_C));
  for (Attribute& each : circumstances_of(run, stated_facts)) facts.push_back(std::move(each));
  return facts;
}

void write_traceability(Xml& xml, const ReportRun& run, const ReportFacts& facts) {
  xml.open("InspectionTraceability");
  xml.open("InspectingOrganization");
  xml.leaf("Name", stated(facts.laboratory));
  xml.close();
  xml.open("CustomerOrganization");
  xml.leaf("Name", stated(facts.customer));
  xml.leaf("CustomerNumber", "not stated");
  xml.close();
  if (!facts.number.empty()) xml.leaf("ReportNumber", stated(facts.number));
  if (report::recorded_days(run)) xml.leaf("InspectionStart", run.results.run.header.started_utc);
  xml.open("InspectionOperator");
  xml.leaf("Name", stated(facts.operator_name));
  xml.close();
  xml.leaf("ReportType", "test report");
  xml.close();
}

}  // namespace mdof::documents
