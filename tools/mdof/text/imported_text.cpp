#include "tools/mdof/text/imported_text.h"

#include <cmath>

#include "daemon/history.h"
#include "daemon/words/words.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"
#include "schema/run_json.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

ImportedError error_of(const Run& run) {
  return imported_error(run.header.axis, run.header.provenance.model)
      .value_or(ImportedError{run.header.provenance.model, std::nullopt, false});
}

double deviation_of(const MeasuredPoint& p) {
  return p.point.probe_m.empty() ? std::nan("") : to_key_unit(p.point.probe_m.front());
}

double u_of(const MeasuredPoint& p) {
  return p.point.probe_u_m.empty() ? std::nan("") : to_key_unit(p.point.probe_u_m.front());
}

bool is_positioning(const Run& run) {
  return run.header.provenance.model == positioning_name(run.header.axis);
}

std::string sense_text(const Run& run) {
  if (!is_positioning(run)) return "";
  return run_options(run.header).imported.sense == PositioningSense::body
             ? ", positive if the moving body is too far along + of the machine axis"
             : ", positive along + of the coordinates of the controller";
}

void write_reading(JsonWriter& json, const MeasuredPoint& p, const std::string& key) {
  json.begin_object().field("target", p.target).field("run", p.run).key("direction");
  p.point.direction == 0 ? json.null() : json.value(p.point.direction);
  json.field("position_mm", to_mm(p.point.position_m)).field(key, deviation_of(p));
  json.key("u").begin_object().field(key, u_of(p)).end_object().end_object();
}

}  // namespace

std::string imported_json(const Run& run, const std::string& result_sha256,
                          const std::vector<HistoryEntry>& actions) {
  const std::string key = error_of(run).key();
  JsonWriter json;
  json.begin_object();
  write_header_members(json, run.header, words::text);
  json.field("imported", true).field("error", run.header.provenance.model);
  json.field("sense", "actual - nominal, as in the file");
  if (is_positioning(run)) {
    const ImportedSense stated = run_options(run.header).imported;
    json.field("positioning_sense", to_string(stated.sense)).key("travel");
    stated.against_command ? json.value(*stated.against_command ? "-" : "+") : json.null();
  }
  json.key("points").begin_array();
  for (const MeasuredPoint& p : run.points) write_reading(json, p, key);
  json.end_array().field("result_sha256", result_sha256).key("history");
  daemon::write_actions(json, actions);
  json.end_object();
  return json.take();
}

std::string imported_csv(const Run& run) {
  const std::string key = error_of(run).key();
  CsvText csv;
  for (const std::string& name : {std::string("target"), std::string("run"),
                                  std::string("direction"), std::string("position_mm"), key})
    csv.cell(name);
  csv.end_row();
  for (const MeasuredPoint& p : run.points) {
    csv.cell(std::to_string(p.target)).cell(std::to_string(p.run));
    csv.cell(p.point.direction == 0 ? std::string() : std::to_string(p.point.direction));
    csv.cell(to_mm(p.point.position_m)).cell(deviation_of(p));
    csv.end_row();
  }
  return csv.take();
}

std::string imported_text(const Run& run, const std::string& result_sha256, std::size_t width,
                          bool all_warnings) {
  TextTable table({"target", "run", "dir", "at/mm", error_label(error_of(run).key())});
  for (const MeasuredPoint& p : run.points)
    table.add(
        {std::to_string(p.target), std::to_string(p.run), arrow(p.point.direction),
         in_mm(p.point.position_m),
         error_of(run).angle ? in_urad(p.point.probe_m.at(0)) : in_um(p.point.probe_m.at(0))});
  const double u = run.points.empty() ? std::nan("") : u_of(run.points.front());
  return "IMPORTED: measured by another instrument, " + run.header.provenance.model + " only.\n" +
         head_text(run.header, result_sha256, width, all_warnings) + "\n" + table.text(width) +
         wrapped("deviation = actual - nominal, as in the file" + sense_text(run) +
                     ". Declared standard uncertainty: " +
                     (std::isnan(u) ? std::string("none")
                                    : fixed(u, 4) + (error_of(run).angle ? " µrad" : " µm")),
                 width) +
         "\n";
}

}  // namespace mdof::tools
