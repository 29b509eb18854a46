#include "schema/separation/separation_json.h"

#include <cmath>

#include "schema/base/json_writer.h"
#include "schema/units.h"

namespace mdof {
namespace {

void write_sources(JsonWriter& json, const SeparationRecord& record) {
  json.key("set_ups").begin_array();
  for (const SeparationSource& source : record.sources) {
    json.begin_object().field("source", source.name).key("sha256");
    source.sha256.empty() ? json.null() : json.value(source.sha256);
    json.field("height_sign", source.height_sign)
        .field("end_for_end", source.end_for_end)
        .field("shift_mm", to_mm(source.shift_m))
        .end_object();
  }
  json.end_array();
}

void write_series(JsonWriter& json, const DeterminedSeries& series, const char* place,
                  const std::string& value) {
  json.begin_object().field("whole", series.whole()).field("zone_um", to_um(series.zone_m()));
  json.key("unseen").begin_array();
  for (const UndeterminedShape& shape : series.unseen)
    json.begin_object()
        .field("shape", shape.name)
        .field("dimensions", static_cast<std::uint64_t>(shape.dimensions))
        .end_object();
  json.end_array().key("places").begin_array();
  for (std::size_t i = 0; i < series.place_m.size(); ++i) {
    json.begin_object().field(place, to_mm(series.place_m[i]) + 0.0).key(value);
    series.whole() ? json.value(to_um(series.seen_m[i])) : json.null();
    json.field("seen_um", to_um(series.seen_m[i]))
        .field("u_um", to_um(series.u_m[i]))
        .field("U_um", to_um(series.U_m(i)))
        .field("k", series.k[i])
        .field("nu_eff", series.freedom[i])
        .end_object();
  }
  json.end_array().end_object();
}

// Returns the value that all positions have; NaN: the positions have different values.
double common(const Separation& fit, std::vector<double> DeterminedSeries::*of) {
  const double first = (fit.machine.*of).empty() ? std::nan("") : (fit.machine.*of).front();
  for (const DeterminedSeries* series : {&fit.machine, &fit.target})
    for (const double x : series->*of)
      if (x != first) return std::nan("");
  return first;
}

void write_fit(JsonWriter& json, const Separation& fit) {
  json.field("readings", static_cast<std::uint64_t>(fit.readings))
      .field("unknowns", static_cast<std::uint64_t>(fit.unknowns))
      .field("rank", static_cast<std::uint64_t>(fit.rank))
      .field("freedom", static_cast<std::uint64_t>(fit.freedom()))
      .field("residual_um", to_um(fit.residual_m))
      .field("k", common(fit, &DeterminedSeries::k))
      .field("nu_eff", common(fit, &DeterminedSeries::freedom))
      .field("u_from", fit.u_reason)
      .field("u_covers", fit.u_reason)
      .field("noise_only", fit.noise_only)
      .field("not_covered", separation_u_omits());
}

}  // namespace

const char* separation_u_omits() {
  return "undeclared sources (scale of the probe, drift within a set-up, flatness of other "
         "surfaces), errors of the shifts, lever arms that differ between the set-ups, and the sag "
         "of the target. The tilt of the target between the set-ups does not add uncertainty, "
         "because the fit determines this tilt";
}

std::string separation_json(const SeparationRecord& record) {
  JsonWriter json;
  json.begin_object()
      .field("method", record.method)
      .field("surface", to_string(record.surface))
      .field("axis", std::string(1, letter(record.axis)))
      .field("error", record.error)
      .key("probe");
  record.probe.empty() ? json.null() : json.value(record.probe);
  json.field("height_along", std::string("+") + letter(record.normal))
      .field("moves", record.sides.moves())
      .field("travel", record.sides.travel())
      .field("simulated", record.simulated)
      .field("doubtful", record.doubtful)
      .field("created_utc", record.created_utc);
  write_sources(json, record);
  write_fit(json, record.result);
  json.key("machine");
  write_series(json, record.result.machine, "position_mm", record.error + "_um");
  json.key("target");
  write_series(json, record.result.target, "place_mm", "height_um");
  json.end_object();
  return json.take();
}

}  // namespace mdof
