// Writes the results of a DCC: points as lists, figures as quantities, and texts for readers.
#include <algorithm>
#include <cmath>
#include <functional>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/svg.h"
#include "daemon/output/documents/dcc_parts.h"
#include "daemon/output/report/replay_command.h"
#include "schema/axis.h"
#include "schema/rig/reference.h"
#include "schema/uncertainty/budget.h"

namespace mdof::documents {

using report::Report;
using report::ReportRun;

namespace {

constexpr const char* kCoverage = "0.95";

std::string number(double x) {
  const std::string text = charts::exact_text(x + 0.0);  // converts -0 to 0
  return text.empty() ? "NaN" : text;
}

bool is_known(double U) {
  return std::isfinite(U) && U > 0;
}

const char* unit_of(const std::string& key) {
  return key.ends_with("_urad") ? "\\radian" : "\\metre";
}

using ByRow = std::function<double(std::size_t)>;

std::string list_of(std::size_t rows, const ByRow& value) {
  std::string text;
  for (std::size_t row = 0; row < rows; ++row) text += (row ? " " : "") + number(value(row));
  return text;
}

// Writes a list with the value of a quantity in each row, and with `U` and `k` if the uncertainty
// is known.
void write_list(Xml& xml, std::string_view type, std::string_view name, const char* unit,
                std::size_t rows, const ByRow& value, const ByRow& U = {}, const ByRow& k = {}) {
  xml.open("dcc:quantity", {{"refType", type}});
  write_text(xml, "dcc:name", name);
  xml.open("si:realListXMLList");
  xml.leaf("si:valueXMLList", list_of(rows, value));
  xml.leaf("si:unitXMLList", unit);
  if (U) {
    const auto known = [&](const ByRow& of) {
      return [&](std::size_t row) { return is_known(U(row)) ? of(row) : std::nan(""); };
    };
    xml.open("si:measurementUncertaintyUnivariateXMLList");
    xml.open("si:expandedMUXMLList");
    xml.leaf("si:valueExpandedMUXMLList", list_of(rows, known(U)));
    xml.leaf("si:coverageFactorXMLList", list_of(rows, known(k)));
    xml.leaf("si:coverageProbabilityXMLList", kCoverage);
    xml.close();
    xml.close();
  }
  xml.close();
  xml.close();
}

void write_figure(Xml& xml, const Budget& b, const std::string& name) {
  xml.open("dcc:quantity", {{"refType", "mdof_figure"}});
  write_text(xml, "dcc:name", name);
  xml.open("si:real");
  xml.leaf("si:label", name);
  xml.leaf("si:value", number(b.value));
  xml.leaf("si:unit", unit_of(b.figure));
  if (is_known(b.U)) {
    xml.open("si:measurementUncertaintyUnivariate");
    xml.open("si:expandedMU");
    xml.leaf("si:valueExpandedMU", number(b.U));
    xml.leaf("si:coverageFactor", number(b.coverage_factor));
    xml.leaf("si:coverageProbability", kCoverage);
    xml.close();
    xml.close();
  }
  xml.close();
  xml.close();
}

void open_result(Xml& xml, const std::string& name, const std::string& description) {
  xml.open("dcc:result");
  write_text(xml, "dcc:name", name);
  write_text(xml, "dcc:description", description);
  xml.open("dcc:data");
  xml.open("dcc:list");
}

void close_result(Xml& xml) {
  for (int i = 0; i < 3; ++i) xml.close();
}

// Writes the flags of each point: "spike:A,creep", or "-" if the point has no flag.
void write_flags(Xml& xml, const std::vector<MeasuredPoint>& points) {
  std::string texts;
  for (const MeasuredPoint& p : points) {
    std::string of_point;
    for (const std::string& flag : flag_texts(p.point.flags))
      of_point += (of_point.empty() ? "" : ",") + flag;
    texts += (texts.empty() ? "" : " ") + (of_point.empty() ? "-" : of_point);
  }
  xml.open("dcc:quantity", {{"refType", "mdof_flags"}});
  write_text(xml, "dcc:name", "flags");
  xml.leaf("dcc:charsXMLList", texts);
  xml.close();
}

void write_points(Xml& xml, const ReportRun& run) {
  const Run& r = run.results.run;
  const auto& points = r.points;
  const auto& known = run.results.uncertainty.points;
  const std::size_t n = points.size();
  open_result(xml, "points",
              "each list has one value per point, in the order of measurement; U is the expanded "
              "uncertainty for 95 %. " +
                  ("U covers: " + covers_text(run.results.uncertainty)));
  write_list(xml, "mdof_target", "target", "\\one", n,
             [&](std::size_t i) { return static_cast<double>(points[i].target); });
  write_list(xml, "mdof_pass", "pass", "\\one", n,
             [&](std::size_t i) { return static_cast<double>(points[i].run); });
  write_list(xml, "mdof_direction", "direction of approach: 1 forward, -1 reverse, 0 unknown",
             "\\one", n,
             [&](std::size_t i) { return static_cast<double>(points[i].point.direction); });
  write_list(xml, "mdof_position", "position", "\\metre", n,
             [&](std::size_t i) { return points[i].point.position_m; });
  const auto& names = error_names(r.header.axis);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto value = [&](std::size_t i) {
      return points[i].errors.valid ? named_from_local(r.header.moving(), points[i].errors.local)[k]
                                    : std::nan("");
    };
    write_list(
        xml, std::string("mdof_") + names[k].name, names[k].name, unit_of(names[k].key), n, value,
        [&](std::size_t i) { return known[i].U[k]; },
        [&](std::size_t i) { return known[i].coverage_factor[k]; });
  }
  write_flags(xml, points);
  close_result(xml);
}

void write_figures(Xml& xml, const ReportRun& run) {
  const auto& budgets = run.results.figures.budgets;
  if (budgets.empty()) return;
  open_result(xml, "figures",
              "calculated from the mean of the measured approaches; straightness refers to the "
              "least-squares line. U covers: " +
                  covers_text(budgets));
  for (const Budget& b : budgets) write_figure(xml, b, charts::split_key(b.figure).name);
  close_result(xml);
}

void write_conditions(Xml& xml, const RunHeader& header) {
  xml.open("dcc:influenceConditions");
  xml.open("dcc:influenceCondition");
  write_text(xml, "dcc:name", "temperature");
  xml.open("dcc:data");
  if (header.temperature) {
    const std::pair<const char*, double> all[] = {{"mean", header.temperature->mean_C},
                                                  {"lowest", header.temperature->min_C},
                                                  {"highest", header.temperature->max_C}};
    xml.open("dcc:list");
    for (const auto& [name, value] : all) {
      xml.open("dcc:quantity", {{"refType", "mdof_temperature"}});
      write_text(xml, "dcc:name", name);
      xml.open("si:real");
      xml.leaf("si:value", number(value));
      xml.leaf("si:unit", "\\degreecelsius");
      xml.close();
      xml.close();
    }
    xml.close();
  } else {
    write_text(xml, "dcc:text", "not recorded");
  }
  xml.close();
  xml.close();
  xml.close();
}

void write_equipment(Xml& xml, const Rig& rig) {
  xml.open("dcc:measuringEquipments");
  write_text(xml, "dcc:name", rig.name);
  for (const Probe& probe : rig.probes) {
    const Calibration& c = probe.calibration;
    xml.open("dcc:measuringEquipment");
    write_text(xml, "dcc:name", "displacement probe " + probe.id);
    write_text(xml, "dcc:description",
               "certificate: " + stated(c.certificate) + "; laboratory: " + stated(c.laboratory) +
                   "; calibrated: " + stated(c.calibrated) + "; due: " + stated(c.due));
    xml.close();
  }
  xml.close();
}

void write_decisions(Xml& xml, const std::vector<report::Decided>& decided) {
  for (const auto& [figure, decision] : decided) {
    const charts::Key key = charts::split_key(figure);
    const auto shown = [&](double si) {  // a text for readers; the quantity was written above
      return charts::number_text(to_key_unit(si), 4) + " " + key.unit;
    };
    xml.open("dcc:metaData");
    write_text(xml, "dcc:name", "conformity of " + key.name);
    xml.leaf("dcc:norm", "ISO 14253-1:2017");
    write_text(xml, "dcc:declaration",
               "limit " + shown(decision.limit) + ": " + to_string(decision.conformity) + "; " +
                   decision.rule +
                   (std::isnan(decision.guard_band) ? "" : " = " + shown(decision.guard_band)) +
                   (decision.reason.empty() ? "" : "; " + decision.reason));
    if (decision.conformity != Conformity::undecided)
      xml.leaf("dcc:conformity", decision.conformity == Conformity::conform ? "pass" : "fail");
    xml.close();
  }
}

void write_notices(Xml& xml, const ReportRun& run) {
  const RunHeader& header = run.results.run.header;
  constexpr const char* kMetaData = "dcc:metaData";
  for (const std::string& mark : charts::with_noise_only_mark(
           run.results.uncertainty.noise_only, daemon::warning_marks(run.results.run),
           output::Language::english))
    write_declaration(xml, kMetaData, "warning", mark);
  for (const Notice& notice : header.notices)
    write_declaration(xml, kMetaData, to_string(notice.severity),
                      words::text(notice, output::Language::english));
  std::string keys;
  for (const std::string& key : run.results.uncertainty.not_declared)
    keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty())
    write_declaration(xml, kMetaData,
                      "uncertainties that the rig does not declare, so that U is too small", keys);
  if (run.results.figures.budgets.empty())
    write_declaration(xml, kMetaData, "reason for missing results", run.results.figures.why);
}

void write_meta_data(Xml& xml, const ReportRun& run) {
  const RunHeader& header = run.results.run.header;
  constexpr const char* kMetaData = "dcc:metaData";
  xml.open("dcc:measurementMetaData");
  write_declaration(xml, kMetaData, "state", to_string(header.state));
  write_declaration(xml, kMetaData, "model", header.provenance.model);
  write_declaration(xml, kMetaData, "straightness refers to", reference_text(header.stated));
  write_declaration(xml, kMetaData, "moving body, travel",
                    std::string(header.sides.moves()) + ", " + header.sides.travel());
  if (run.superseded_by)
    write_declaration(xml, kMetaData, "superseded by run", std::to_string(*run.superseded_by));
  if (const std::string approach = daemon::only_approach(run.results.run); !approach.empty())
    write_declaration(xml, kMetaData, "only measured approach",
                      approach + "; the reversal is unknown");
  write_decisions(xml, run.decided);
  write_notices(xml, run);
  write_declaration(xml, kMetaData, "SHA-256 of the recording", header.provenance.recording_sha256);
  write_declaration(xml, kMetaData, "SHA-256 of the result", run.result_sha256);
  write_declaration(xml, kMetaData, "measured with", header.provenance.software_version);
  write_declaration(xml, kMetaData, "command that replays the recording",
                    report::replay_command(run.results.run));
  xml.close();
}

std::string name_of(const RunHeader& header) {
  return "run " + std::to_string(header.id) + ", axis " + letter(header.axis);
}

void write_run(Xml& xml, const ReportRun& run) {
  const RunHeader& header = run.results.run.header;
  xml.open("dcc:measurementResult");
  write_text(xml, "dcc:name", name_of(header));
  write_text(xml, "dcc:description",
             header.simulated ? "SIMULATED: no machine was measured" : "errors: actual - nominal");
  write_equipment(xml, run.rig);
  write_conditions(xml, header);
  xml.open("dcc:results");
  write_points(xml, run);
  write_figures(xml, run);
  xml.close();
  write_meta_data(xml, run);
  xml.close();
}

std::string not_declared_text(const Budget& budget) {
  std::string keys;
  for (const std::string& key : budget.not_declared) keys += (keys.empty() ? "" : ", ") + key;
  return keys.empty()
             ? ""
             : ". Uncertainties that the rigs do not declare, so that U is too small: " + keys;
}

void write_squareness(Xml& xml, const charts::SquarenessResults& of,
                      const std::vector<report::Decided>& decided) {
  const AxisPair axes = of.squareness.axes;
  xml.open("dcc:measurementResult");
  write_text(xml, "dcc:name",
             std::string("squareness of ") + letter(axes.a) + " (run " +
                 std::to_string(of.squareness.run_a) + ") and " + letter(axes.b) + " (run " +
                 std::to_string(of.squareness.run_b) + ")");
  xml.open("dcc:results");
  open_result(xml, "squareness",
              squareness_sense(axes, " degrees") + ", at the fixture. U covers: " +
                  covers_text(of.budget) + not_declared_text(of.budget));
  write_figure(xml, of.budget, squareness_name(axes));
  close_result(xml);
  xml.close();
  std::vector<report::Decided> of_pair;
  for (const report::Decided& each : decided)
    if (each.figure == of.budget.figure) of_pair.push_back(each);
  if (!of_pair.empty()) {
    xml.open("dcc:measurementMetaData");
    write_decisions(xml, of_pair);
    xml.close();
  }
  xml.close();
}

void write_method(Xml& xml, const char* name, const char* norm, const char* reference) {
  xml.open("dcc:usedMethod");
  write_text(xml, "dcc:name", name);
  xml.leaf("dcc:norm", norm);
  xml.leaf("dcc:reference", reference);
  xml.close();
}

}  // namespace

void write_measurements(Xml& xml, const Report& report) {
  xml.open("dcc:measurementResults");
  xml.open("dcc:usedMethods");
  write_method(xml, "geometric errors of a linear axis", "ISO 230-1:2012",
               "Kweon, Liu, Yang: A multi-degree of freedom measurement system for determining "
               "geometric errors in miniaturized machine tool");
  write_method(xml, "measurement uncertainty", "JCGM 100:2008",
               "Guide to the expression of uncertainty in measurement");
  xml.close();
  for (const ReportRun& run : report.runs) write_run(xml, run);
  for (const auto& pair : report.squareness)
    if (pair.results) write_squareness(xml, *pair.results, report.decided);
  xml.close();
}

}  // namespace mdof::documents
