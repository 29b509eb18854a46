#include "daemon/output/documents/qif.h"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/svg.h"
#include "daemon/output/documents/qif_facts.h"
#include "daemon/output/documents/xml.h"
#include "schema/axis.h"
#include "schema/base/sha256.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::documents {

using report::Report;
using report::ReportRun;

namespace {

// xs:decimal allows neither an exponent nor NaN. Callers never pass NaN. xmllint accepts at most
// 24 digits, so the digits after 20 decimals are left out.
std::string decimal(double x) {
  constexpr std::size_t kMostDecimals = 20;
  char buffer[400];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x + 0.0, std::chars_format::fixed);
  std::string text(buffer, end.ptr);
  const std::size_t point = text.find('.');
  if (point == text.npos || text.size() <= point + 1 + kMostDecimals) return text;
  text.resize(point + 1 + kMostDecimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

bool is_stated(double u) {
  return std::isfinite(u) && u > 0;
}

// A measured characteristic of a run: a figure, or one error at one target with one approach.
struct Characteristic {
  std::string key;  // "EYX_straightness_um", "EYX_um"
  std::string where;
  std::optional<double> limit;  // limit in the unit of the key
  std::string sense = "error: actual - nominal";
  bool angle() const { return key.ends_with("_urad"); }
  std::string kind() const {
    return std::string("UserDefined") + (angle() ? "Angular" : "Linear") + "Characteristic";
  }
  std::string name() const {
    return charts::split_key(key).name + (where.empty() ? "" : " " + where);
  }
};

struct Measured {
  std::size_t characteristic;
  std::optional<double> value;  // this and the following members are in the unit of the key
  double u, U, k;
  std::vector<std::pair<std::string, double>> attributes;
  std::string reason, status = "NOT_ANALYZED";
  std::vector<Attribute> texts;
};

struct MeasuredRun {
  const ReportRun* run;
  std::vector<Measured> all;
};

struct Document {
  std::vector<Characteristic> characteristics;
  std::vector<MeasuredRun> runs;
};

const char* status_of(Conformity conformity) {
  return conformity == Conformity::conform       ? "PASS"
         : conformity == Conformity::not_conform ? "FAIL"
                                                 : "INDETERMINATE";
}

void add_figure(Document& document, MeasuredRun& measured, const Budget& b,
                Characteristic characteristic, const std::vector<report::Decided>& decided) {
  Measured of{document.characteristics.size(),
              to_key_unit(b.value),
              to_key_unit(b.u),
              to_key_unit(b.U),
              b.coverage_factor,
              {},
              "",
              "NOT_ANALYZED",
              {}};
  for (const auto& [figure, decision] : decided)
    if (figure == b.figure) {
      characteristic.limit = to_key_unit(decision.limit);
      of.status = status_of(decision.conformity);
      of.reason = decision.reason;
      of.texts.emplace_back("decision rule", decision.rule);
      if (std::isfinite(decision.guard_band))
        of.attributes.emplace_back("guard_band", to_key_unit(decision.guard_band));
    }
  document.characteristics.push_back(std::move(characteristic));
  measured.all.push_back(std::move(of));
}

void add_figures(Document& document, MeasuredRun& measured) {
  for (const Budget& b : measured.run->results.figures.budgets)
    add_figure(document, measured, b, {b.figure, "", {}}, measured.run->decided);
}

void add_points(Document& document, MeasuredRun& measured) {
  const Run& run = measured.run->results.run;
  const auto& known = measured.run->results.uncertainty.points;
  const auto& names = error_names(run.header.axis);
  std::map<std::string, std::size_t> at;  // [name] index of the characteristic
  for (std::size_t row = 0; row < run.points.size(); ++row) {
    const MeasuredPoint& p = run.points[row];
    const Errors5 errors = named_from_local(run.header.moving(), p.errors.local);
    const std::string side = p.point.direction > 0 ? "+" : p.point.direction < 0 ? "-" : "?";
    const std::string where = "at target " + std::to_string(p.target) + " " + side;
    for (std::size_t k = 0; k < names.size(); ++k) {
      Characteristic characteristic{names[k].key, where, {}};
      const auto [found, is_new] =
          at.emplace(characteristic.name(), document.characteristics.size());
      if (is_new) document.characteristics.push_back(std::move(characteristic));
      Measured of{found->second,
                  {},
                  to_key_unit(known[row].u[k]),
                  to_key_unit(known[row].U[k]),
                  known[row].coverage_factor[k],
                  {},
                  p.errors.reason,
                  "NOT_ANALYZED",
                  {}};
      if (!p.point.flags.empty()) of.texts.emplace_back("flags", to_string(p.point.flags));
      if (p.errors.valid) of.value = to_key_unit(errors[k]);
      of.attributes = {{"row", static_cast<double>(row)},
                       {"pass", static_cast<double>(p.run)},
                       {"position_mm", to_mm(p.point.position_m)}};
      measured.all.push_back(std::move(of));
    }
  }
}

Document document_of(const Report& report) {
  Document document;
  for (const ReportRun& run : report.runs) {
    MeasuredRun measured{&run, {}};
    add_figures(document, measured);
    add_points(document, measured);
    document.runs.push_back(std::move(measured));
  }
  for (const auto& pair : report.squareness) {
    if (!pair.results) continue;
    const Squareness& s = pair.results->squareness;
    // The squareness is a result of two runs; the document states the squareness with the last run.
    add_figure(document, document.runs.back(), pair.results->budget,
               {pair.results->budget.figure,
                "of runs " + std::to_string(s.run_a) + " and " + std::to_string(s.run_b),
                {},
                squareness_sense(s.axes, " deg")},
               report.decided);
  }
  return document;
}

// Ids in the document: 1 is the standard. Then each characteristic has three ids (Aspect). Then the
// runs and their measurements have ids.
constexpr std::size_t kStandard = 1, kFirst = 2;
enum class Aspect : std::size_t { definition, nominal, item };
std::string id_of(std::size_t characteristic, Aspect aspect) {
  return std::to_string(kFirst + 3 * characteristic + static_cast<std::size_t>(aspect));
}

void write_limit(Xml& xml, const Characteristic& of) {
  if (!of.limit) return xml.leaf("NonTolerance", "MEASURED");
  xml.open("Tolerance");
  xml.leaf("MaxValue", decimal(*of.limit));
  xml.leaf("MinValue", decimal(-*of.limit));
  xml.leaf("DefinedAsLimit", "true");
  xml.close();
}

void write_characteristics(Xml& xml, const std::vector<Characteristic>& all) {
  const std::string n = std::to_string(all.size());
  xml.open("Characteristics");
  xml.leaf("FormalStandardId", std::to_string(kStandard));
  xml.open("CharacteristicDefinitions", {{"n", n}});
  for (std::size_t i = 0; i < all.size(); ++i) {
    xml.open(all[i].kind() + "Definition", {{"id", id_of(i, Aspect::definition)}});
    xml.leaf("Name", all[i].name());
    write_limit(xml, all[i]);
    xml.leaf("WhatToMeasure",
             charts::split_key(all[i].key).name + " of ISO 230-1, " + all[i].sense);
    xml.close();
  }
  xml.close();
  xml.open("CharacteristicNominals", {{"n", n}});
  for (std::size_t i = 0; i < all.size(); ++i) {
    xml.open(all[i].kind() + "Nominal", {{"id", id_of(i, Aspect::nominal)}});
    xml.leaf("CharacteristicDefinitionId", id_of(i, Aspect::definition));
    xml.leaf("TargetValue", "0");
    xml.close();
  }
  xml.close();
  xml.open("CharacteristicItems", {{"n", n}});
  for (std::size_t i = 0; i < all.size(); ++i) {
    xml.open(all[i].kind() + "Item", {{"id", id_of(i, Aspect::item)}});
    xml.leaf("Name", all[i].name());
    xml.leaf("CharacteristicNominalId", id_of(i, Aspect::nominal));
    xml.close();
  }
  xml.close();
  xml.close();
}

void write_attribute(Xml& xml, const char* element, const Attribute& of) {
  xml.leaf(element, "", {{"name", of.first}, {"value", of.second}});
}

void write_measurement(Xml& xml, const Measured& of, const std::string& kind, std::size_t id) {
  std::vector<Attribute> attributes;
  for (const auto& [name, value] : of.attributes)
    attributes.emplace_back(name, charts::exact_text(value));
  if (of.value && is_stated(of.U))
    for (const auto& [name, value] :
         {std::pair("U", of.U), {"k", of.k}, {"coverage_probability", 0.95}})
      attributes.emplace_back(name, charts::exact_text(value));
  xml.open(kind + "Measurement", {{"id", std::to_string(id)}});
  if (const std::size_t n = attributes.size() + of.texts.size(); n > 0) {
    xml.open("Attributes", {{"n", std::to_string(n)}});
    for (const Attribute& attribute : attributes) write_attribute(xml, "AttributeD1", attribute);
    for (const Attribute& attribute : of.texts) write_attribute(xml, "AttributeStr", attribute);
    xml.close();
  }
  if (!of.reason.empty()) xml.leaf("Description", of.reason);
  xml.open("Status");
  xml.leaf("CharacteristicStatusEnum", of.status);
  xml.close();
  xml.leaf("CharacteristicItemId", id_of(of.characteristic, Aspect::item));
  if (of.value && is_stated(of.u))
    xml.leaf("Value", decimal(*of.value),
             {{"combinedUncertainty", decimal(of.u)}, {"meanError", "0"}});
  else if (of.value)
    xml.leaf("Value", decimal(*of.value));
  xml.close();
}

void write_results(Xml& xml, const Document& document, const ReportFacts& facts) {
  std::size_t id = kFirst + 3 * document.characteristics.size();
  xml.open("Results");
  xml.open("MeasurementResultsSet", {{"n", std::to_string(document.runs.size())}});
  for (const MeasuredRun& measured : document.runs) {
    xml.open("MeasurementResults", {{"id", std::to_string(id++)}});
    const auto attributes = facts_of(*measured.run, facts);
    xml.open("Attributes", {{"n", std::to_string(attributes.size())}});
    for (const Attribute& attribute : attributes) write_attribute(xml, "AttributeStr", attribute);
    xml.close();
    write_traceability(xml, *measured.run, facts);
    if (!measured.all.empty()) {
      xml.open("MeasuredCharacteristics");
      xml.open("CharacteristicMeasurements", {{"n", std::to_string(measured.all.size())}});
      for (const Measured& of : measured.all)
        write_measurement(xml, of, document.characteristics[of.characteristic].kind(), id++);
      xml.close();
      xml.close();
    }
    xml.open("InspectionStatus");
    xml.leaf("InspectionStatusEnum", "NOT_CALCULATED");
    xml.close();
    xml.close();
  }
  xml.close();
  xml.close();
}

void write_unit(Xml& xml, const char* element, const char* si, const char* name) {
  xml.open(element);
  xml.leaf("SIUnitName", si);
  xml.leaf("UnitName", name);
  xml.open("UnitConversion");
  xml.leaf("Factor", "0.000001");
  xml.close();
  xml.close();
}

void write_head(Xml& xml, const Report& report, const std::string& id) {
  xml.leaf("QPId", id);
  xml.open("Header");
  xml.open("Application");
  xml.leaf("Name", report.software_version);
  xml.close();
  xml.leaf("Description",
           "Test report of " + stated(report.facts.machine) + ", serial number " +
               stated(report.facts.serial_number) +
               ". This document is not a calibration certificate of an accredited laboratory. "
               "Errors of machine axes are actual - nominal, in um and urad.");
  xml.close();
  xml.open("StandardsDefinitions", {{"n", "1"}});
  xml.open("Standard", {{"id", std::to_string(kStandard)}});
  xml.open("Organization");
  xml.leaf("StandardsOrganizationEnum", "ISO");
  xml.close();
  xml.leaf("Designator", "ISO 230-1");
  xml.leaf("Year", "2012");
  xml.close();
  xml.close();
  xml.open("FileUnits");
  xml.open("PrimaryUnits");
  write_unit(xml, "AngularUnit", "radian", "urad");
  write_unit(xml, "LinearUnit", "meter", "um");
  xml.close();
  xml.close();
}

std::size_t largest_id(const Document& document) {
  std::size_t ids = kFirst + 3 * document.characteristics.size();
  for (const MeasuredRun& run : document.runs) ids += 1 + run.all.size();
  return ids - 1;
}

std::string with_id(const Report& report, const Document& document, const std::string& id) {
  Xml xml;
  xml.open("QIFDocument", {{"xmlns", "http://qifstandards.org/xsd/qif3"},
                           {"versionQIF", "3.0.0"},
                           {"idMax", std::to_string(largest_id(document))}});
  write_head(xml, report, id);
  if (!document.characteristics.empty()) write_characteristics(xml, document.characteristics);
  write_results(xml, document, report.facts);
  xml.close();
  return xml.take();
}

}  // namespace

Result<std::string> qif_xml(const Report& report) {
  for (const ReportRun& run : report.runs)
    MDOF_CHECK(check_measured(run.results.run.header, "a QIF document"));
  const Document document = document_of(report);
  // The UUID is made from a hash of the whole document; different documents have different UUIDs.
  const std::string hash = sha256_hex(with_id(report, document, ""));
  return with_id(report, document,
                 hash.substr(0, 8) + "-" + hash.substr(8, 4) + "-" + hash.substr(12, 4) + "-" +
                     hash.substr(16, 4) + "-" + hash.substr(20, 12));
}

}  // namespace mdof::documents
