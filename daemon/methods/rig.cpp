// The method rig.get.
#include "daemon/methods/methods.h"
#include "daemon/paths.h"
#include "daemon/words/words.h"
#include "drivers/calibration.h"
#include "schema/base/json_writer.h"
#include "schema/notice/notice_json.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

void write_vector(JsonWriter& json, const char* key, const Vec3& v, double unit = 1) {
  json.key(key).begin_array();
  for (const double x : v) json.value(x * unit + 0.0);  // + 0.0 converts -0 to 0
  json.end_array();
}

void write_text(JsonWriter& json, const char* key, const std::string& text) {
  json.key(key);
  text.empty() ? json.null() : json.value(text);
}

void write_probe(JsonWriter& json, const Probe& probe) {
  const auto [low_m, high_m] = drivers::displacement_window_m(probe);
  json.begin_object().field("id", probe.id);
  write_vector(json, "position_mm", probe.position_m, 1e3);
  write_vector(json, "direction", probe.direction);
  json.field("reads", probe.calibration.reads_gap ? "gap" : "displacement")
      .field("range_um", to_um(probe.range_m))
      .field("low_um", to_um(low_m))
      .field("high_um", to_um(high_m));
  write_text(json, "certificate", probe.calibration.certificate);
  write_text(json, "laboratory", probe.calibration.laboratory);
  write_text(json, "calibrated", probe.calibration.calibrated);
  write_text(json, "due", probe.calibration.due);
  json.end_object();
}

std::string rig_json(const Rig& rig) {
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string(1, letter(rig.axis)))
      .field("rig", rig.name)
      .field("moves", rig.sides.moves())
      .field("travel", rig.sides.travel());
  json.key("chain");
  rig.machine.known() ? json.value(rig.machine.text) : json.null();
  json.key("probes").begin_array();
  for (const Probe& probe : rig.probes) write_probe(json, probe);
  json.end_array().key("records").begin_array();
  for (const CalibrationRecord& record : rig.records)
    json.begin_object()
        .field("id", record.id)
        .field("kind", record.kind)
        .field("date", record.date)
        .field("valid_until", record.valid_until)
        .end_object();
  json.end_array();
  write_strings(json, "not_declared", rig.undeclared_uncertainties());
  write_notices(json, "notices", overdue_calibrations(rig, utc_now()), words::text);
  json.end_object();
  return json.take();
}

Result<std::string> get_rig(Methods& m, const Params& params) {
  MDOF_TRY(const Axis axis, axis_param(params));
  MDOF_TRY(const Station* station, find_station(m, axis));
  return rig_json(station->config().rig);
}

}  // namespace

void add_rig_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "rig.get",
             .summary = "Returns the configured fixture of an axis: the probes with ranges and "
                        "calibrations.",
             .params = {{"axis", ParamType::string, "X, Y or Z", true}},
             .result = "the notices name overdue calibrations",
             .members = "{axis, rig, moves, travel, chain: string, probes: [{id: string, "
                        "position_mm: [number], direction: [number], reads, range_um, low_um, "
                        "high_um, certificate, laboratory, calibrated, due}], records: [{id: "
                        "string, kind, date, valid_until}], not_declared, ...notices}",
             .example = R"({"axis": "X"})",
             .handler = [&m](const Params& p) { return get_rig(m, p); }});
}

}  // namespace mdof::daemon
