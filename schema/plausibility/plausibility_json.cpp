#include "schema/plausibility/plausibility_json.h"

#include <algorithm>
#include <cmath>

#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::size_t kFewStops = 20;

double rounded(double x, double per_unit) {
  return std::round(x * per_unit) / per_unit;
}
double rounded_mm(double x_m) {
  return rounded(to_mm(x_m), 1e7);
}
double rounded_um(double x_m) {
  return rounded(to_um(x_m), 1e6);
}

void write_counts(JsonWriter& json, const char* key, const std::vector<int>& counts) {
  json.key(key).begin_array();
  for (const int n : counts) json.value(n);
  json.end_array();
}

void write_visits(JsonWriter& json, const std::vector<TargetVisits>& n_ij) {
  json.begin_array();
  for (std::size_t i = 0; i < n_ij.size(); ++i) {
    json.begin_object()
        .field("target", static_cast<std::uint64_t>(i + 1))
        .field("target_mm", rounded_mm(n_ij[i].target_m));
    write_counts(json, "forward", n_ij[i].forward);
    write_counts(json, "reverse", n_ij[i].reverse);
    json.end_object();
  }
  json.end_array();
}

void write_left_out(JsonWriter& json, const std::vector<StopLeftOut>& stops, std::size_t most) {
  json.field("left_out_total", static_cast<std::uint64_t>(stops.size()));
  json.key("left_out").begin_array();
  for (std::size_t i = 0; i < std::min(stops.size(), most); ++i) {
    json.begin_object()
        .field("position_mm", rounded_mm(stops[i].position_m))
        .field("begin_ns", stops[i].begin_ns)
        .field("reason", stops[i].reason)
        .end_object();
  }
  json.end_array();
}

void write_probes(JsonWriter& json, const std::vector<ProbeFigures>& probes) {
  json.key("probes").begin_array();
  for (const ProbeFigures& p : probes) {
    json.begin_object()
        .field("id", p.id)
        .field("points", p.points)
        .field("sd_um", rounded_um(p.sd_m))
        .field("travel_um", rounded_um(p.travel_m))
        .field("min_um", rounded_um(p.min_m))
        .field("max_um", rounded_um(p.max_m))
        .end_object();
  }
  json.end_array();
}

}  // namespace

void write_plausibility(JsonWriter& json, const Plausibility& p, std::size_t visit_limit) {
  const std::size_t visits =
      p.n_ij.size() * (2 * static_cast<std::size_t>(std::max(0, p.runs)) + 4);
  const bool whole = visits <= visit_limit;
  json.begin_object()
      .field("cycle", p.cycle)
      .field("runs", p.runs)
      .field("targets", static_cast<std::uint64_t>(p.n_ij.size()));
  json.key("n_ij");
  whole ? write_visits(json, p.n_ij) : static_cast<void>(json.null());
  write_left_out(json, p.left_out, visit_limit == kAllVisits ? kAllVisits : kFewStops);
  json.field("short_stops", p.short_stops)
      .field("rate_hz", p.rate_hz)
      .field("encoder_min_mm", rounded_mm(p.encoder_min_m))
      .field("encoder_max_mm", rounded_mm(p.encoder_max_m))
      .field("scans", p.scans)
      .field("scans_lost", p.scans_lost)
      .field("gaps", p.gaps)
      .field("duration_s", rounded(p.duration_s, 1e6));
  write_probes(json, p.probes);
  json.end_object();
}

std::string plausibility_json(const Plausibility& plausibility) {
  JsonWriter json;
  write_plausibility(json, plausibility);
  return json.take();
}

}  // namespace mdof
