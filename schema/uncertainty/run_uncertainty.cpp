#include "schema/uncertainty/run_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "schema/uncertainty/budget.h"

namespace mdof {
namespace {

// An uncertainty of nothing at all is one that is not known.
double known(double u) {
  return u > 0 ? u : std::nan("");
}

void write_five(JsonWriter& json, Axis axis, const char* key, const Errors5& values) {
  json.key(key).begin_object();
  for (std::size_t k = 0; k < kErrorCount; ++k) json.field(error_names(axis)[k].key, values[k]);
  json.end_object();
}

Errors5 in_key_unit(const Errors5& u) {
  Errors5 out{};
  for (std::size_t k = 0; k < kErrorCount; ++k) out[k] = known(to_key_unit(u[k]));
  return out;
}

}  // namespace

std::string covers_text(const RunUncertainty& uncertainty) {
  const VisitsCovered visits = uncertainty.visits;
  const std::string random =
      visits == VisitsCovered::repeated ? "noise and repeatability" : "noise";
  const std::string slow =
      visits == VisitsCovered::single
          ? "; noise slower than a stop is not included (no target was visited again)"
      : visits == VisitsCovered::left_out ? "; repeatability is not included (u of each stop alone)"
                                          : "";
  if (!uncertainty.why.empty()) return random + " only: " + uncertainty.why + slow;
  if (!uncertainty.noise_only)
    return (visits == VisitsCovered::repeated ? "noise, repeatability" : "noise") +
           std::string(" and the uncertainties that the rig declares") + slow;
  return random + " only (" +
         (uncertainty.declares ? "the uncertainties that the rig declares contribute zero"
                               : kNothingDeclared) +
         ")" + slow;
}

bool is_noise_only(const RunUncertainty& uncertainty) {
  if (!uncertainty.why.empty() || !uncertainty.declares) return true;
  if (uncertainty.not_declared.empty()) return false;
  for (const ErrorsUncertainty& point : uncertainty.points)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double square = point.u[k] * point.u[k] - point.u_random[k] * point.u_random[k];
      if (!is_noise_only(point.u[k], std::sqrt(std::max(0.0, square)))) return false;
    }
  return true;
}

void write_covers(JsonWriter& json, const std::string& covers,
                  const std::vector<std::string>& not_declared) {
  json.field("u_covers", covers).key("u_not_declared").begin_array();
  for (const std::string& key : not_declared) json.value(key);
  json.end_array();
}

void write_covers(JsonWriter& json, const RunUncertainty& uncertainty) {
  write_covers(json, covers_text(uncertainty), uncertainty.not_declared);
}

void write_uncertainty(JsonWriter& json, Axis axis, const ErrorsUncertainty& uncertainty) {
  write_five(json, axis, "u", in_key_unit(uncertainty.u));
  write_five(json, axis, "u_random", in_key_unit(uncertainty.u_random));
  write_five(json, axis, "U", in_key_unit(uncertainty.U));
  write_five(json, axis, "k", uncertainty.coverage_factor);
  write_five(json, axis, "nu_eff", uncertainty.freedom);
}

}  // namespace mdof
