#include "daemon/output/documents/dcc.h"

#include <algorithm>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/documents/dcc_parts.h"
#include "daemon/output/report/measured_days.h"
#include "schema/base/sha256.h"
#include "schema/imported/series.h"
#include "schema/rig/report_facts.h"
#include "schema/units.h"

namespace mdof::documents {

using report::Days;
using report::Report;
using report::ReportRun;

namespace {

constexpr const char* kWhatItIs =
    "Test report. This document is not a calibration certificate of an accredited laboratory. It "
    "contains the results of a test in the data format of the Digital Calibration Certificate.";

Result<Days> days_of(const Report& report) {
  if (!report.facts.date.empty()) return Days{report.facts.date, report.facts.date};
  Days all;
  for (const ReportRun& run : report.runs) {
    const auto days = report::recorded_days(run);
    if (!days)
      return bad_input("run " + std::to_string(run.results.run.header.id) +
                           ": the log contains no date, but a certificate must state the date of "
                           "the measurement",
                       Remedy::state_in_report, "date");
    if (all.first.empty() || days->first < all.first) all.first = days->first;
    all.last = std::max(all.last, days->last);
  }
  return all;
}

std::string release(const std::string& software) {  // "mdof 0.1.0": "v0.1.0"
  return "v" + software.substr(software.rfind(' ') + 1);
}

void write_contact(Xml& xml, std::string_view element, const std::string& name,
                   const std::string& address) {
  xml.open(element);
  write_text(xml, "dcc:name", name);
  xml.open("dcc:location");
  write_text(xml, "dcc:further", address);
  xml.close();
  xml.close();
}

void write_identification(Xml& xml, const char* issuer, const std::string& value,
                          const std::string& name) {
  xml.open("dcc:identification");
  xml.leaf("dcc:issuer", issuer);
  xml.leaf("dcc:value", stated(value));
  write_text(xml, "dcc:name", name);
  xml.close();
}

void write_software(Xml& xml, const Report& report) {
  xml.open("dcc:dccSoftware");
  xml.open("dcc:software");
  write_text(xml, "dcc:name", "mdof");
  xml.leaf("dcc:release", release(report.software_version));
  xml.leaf("dcc:type", "application");
  xml.close();
  xml.close();
  xml.open("dcc:refTypeDefinitions");
  xml.open("dcc:refTypeDefinition");
  write_text(xml, "dcc:name", "mdof");
  write_text(
      xml, "dcc:description",
      "mdof_position, mdof_target, mdof_pass, mdof_direction: position, target, pass and "
      "direction of approach of each point; mdof_flags: flags of each point, with a comma between "
      "two flags, - for no flag; mdof_EYX and others: error (actual minus nominal), "
      "named as in ISO 230-1; mdof_figure: result of a run such as a straightness, "
      "calculated from the mean of the measured approaches");
  xml.leaf("dcc:namespace", "mdof");
  xml.leaf("dcc:link", "urn:mdof:refTypes");
  xml.close();
  xml.close();
}

void write_core_data(Xml& xml, const Report& report, const Days& days,
                     const std::string& identifier) {
  const ReportFacts& facts = report.facts;
  xml.open("dcc:coreData");
  xml.leaf("dcc:countryCodeISO3166_1", facts.country);
  xml.leaf("dcc:usedLangCodeISO639_1", "en");
  xml.leaf("dcc:mandatoryLangCodeISO639_1", "en");
  xml.leaf("dcc:uniqueIdentifier", identifier);
  if (!facts.number.empty()) {
    xml.open("dcc:identifications");
    write_identification(xml, "calibrationLaboratory", facts.number, "number of the test report");
    xml.close();
  }
  xml.leaf("dcc:beginPerformanceDate", days.first);
  xml.leaf("dcc:endPerformanceDate", days.last);
  xml.leaf("dcc:performanceLocation", facts.place.empty() ? "other" : facts.place);
  if (!facts.issued.empty()) xml.leaf("dcc:issueDate", facts.issued);
  xml.close();
}

void write_items(Xml& xml, const ReportFacts& facts) {
  xml.open("dcc:items");
  xml.open("dcc:item");
  write_text(xml, "dcc:name", facts.machine);
  if (!facts.manufacturer.empty()) {
    xml.open("dcc:manufacturer");
    write_text(xml, "dcc:name", facts.manufacturer);
    xml.close();
  }
  xml.open("dcc:identifications");
  write_identification(xml, "manufacturer", facts.serial_number, "serial number");
  xml.close();
  xml.close();
  xml.close();
}

void write_statements(Xml& xml, const Report& report) {
  xml.open("dcc:statements");
  write_declaration(xml, "dcc:statement", "test report", kWhatItIs);
  for (const ReportRun& run : report.runs)
    for (const std::string& mark : daemon::warning_marks(run.results.run))
      write_declaration(xml, "dcc:statement", "warning", mark);
  if (!report.facts.conditions.empty())
    write_declaration(xml, "dcc:statement", "conditions as stated", report.facts.conditions);
  xml.close();
}

void write_administration(Xml& xml, const Report& report, const Days& days,
                          const std::string& identifier) {
  const ReportFacts& facts = report.facts;
  xml.open("dcc:administrativeData");
  write_software(xml, report);
  write_core_data(xml, report, days, identifier);
  write_items(xml, facts);
  xml.open("dcc:calibrationLaboratory");
  write_contact(xml, "dcc:contact", facts.laboratory, facts.laboratory_address);
  xml.close();
  xml.open("dcc:respPersons");
  xml.open("dcc:respPerson");
  xml.open("dcc:person");
  write_text(xml, "dcc:name", facts.operator_name);
  xml.close();
  xml.leaf("dcc:role", "operator");
  xml.close();
  xml.close();
  write_contact(xml, "dcc:customer", facts.customer, facts.customer_address);
  write_statements(xml, report);
  xml.close();
}

std::string document(const Report& report, const Days& days, const std::string& identifier) {
  Xml xml;
  xml.open("dcc:digitalCalibrationCertificate", {{"schemaVersion", "3.3.0"},
                                                 {"xmlns:dcc", "https://ptb.de/dcc"},
                                                 {"xmlns:si", "https://ptb.de/si"}});
  write_administration(xml, report, days, identifier);
  write_measurements(xml, report);
  xml.close();
  return xml.take();
}

}  // namespace

void write_text(Xml& xml, std::string_view element, std::string_view text,
                Xml::Attributes attributes) {
  xml.open(element, attributes);
  xml.leaf("dcc:content", stated(text), {{"lang", "en"}});
  xml.close();
}

void write_declaration(Xml& xml, std::string_view element, const std::string& name,
                       const std::string& text) {
  xml.open(element);
  write_text(xml, "dcc:name", name);
  write_text(xml, "dcc:declaration", text);
  xml.close();
}

Result<std::string> dcc_xml(const Report& report) {
  for (const ReportRun& run : report.runs)
    MDOF_CHECK(check_measured(run.results.run.header, "a certificate (DCC)"));
  if (report.facts.country.empty())
    return bad_input(
        "a certificate must name the country of the laboratory (ISO 3166-1, such as DE)",
        Remedy::state_in_report, "country");
  MDOF_TRY(const Days days, days_of(report));
  // The identifier is a hash of the whole document; different documents have different identifiers.
  const std::string all = document(report, days, "mdof");
  return document(report, days, "mdof-" + sha256_hex(all));
}

}  // namespace mdof::documents
