#include "schema/uncertainty/run_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "schema/uncertainty/budget.h"

namespace mdof {
namespace {

// If the noise is 0, the readings show no noise. The uncertainty is then unknown.
Errors5 known(const Errors5& u_random) {
  Errors5 out{};
  for (std::size_t k = 0; k < kErrorCount; ++k)
    out[k] = u_random[k] > 0 ? u_random[k] : std::nan("");
  return out;
}

void write_five(JsonWriter& json, Axis axis, const char* key, const Errors5& values) {
  json.key(key).begin_object();
  for (std::size_t k = 0; k < kErrorCount; ++k) json.field(error_names(axis)[k].key, values[k]);
  json.end_object();
}

Errors5 in_key_unit(const Errors5& u) {
  Errors5 out{};
  for (std::size_t k = 0; k < kErrorCount; ++k) out[k] = to_key_unit(u[k]);
  return out;
}

}  // namespace

Covers covers(const RunUncertainty& uncertainty) {
  const bool repeated = uncertainty.visits == VisitsCovered::repeated;
  Covers found;
  if (uncertainty.why.empty() && !uncertainty.noise_only) {
    found = {repeated ? Covered::noise_repeatability_declared : Covered::noise_declared};
  } else {
    found = {repeated ? Covered::noise_repeatability_only : Covered::noise_only};
    if (uncertainty.why.empty())
      found.push_back(uncertainty.declares ? Covered::declared_below_1_percent
                                           : Covered::nothing_declared);
  }
  if (uncertainty.visits == VisitsCovered::single) found.push_back(Covered::no_second_visit);
  if (uncertainty.visits == VisitsCovered::left_out) found.push_back(Covered::no_repeatability);
  return found;
}

std::string covers_text(const RunUncertainty& uncertainty) {
  const Covers found = covers(uncertainty);
  if (uncertainty.why.empty()) return covers_text(found);
  return covers_text({found.front()}) + ": " + uncertainty.why +
         covers_text({found.begin() + 1, found.end()});
}

bool is_noise_only(const RunUncertainty& uncertainty) {
  if (!uncertainty.why.empty()) return true;
  if (uncertainty.not_declared.empty()) return false;
  if (!uncertainty.declares) return true;
  for (const ErrorsUncertainty& point : uncertainty.points)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double square = point.u[k] * point.u[k] - point.u_random[k] * point.u_random[k];
      if (!is_noise_only(point.u[k], std::sqrt(std::max(0.0, square)))) return false;
    }
  return true;
}

void write_covers(JsonWriter& json, const std::string& covers,
                  const std::vector<std::string>& not_declared) {
  json.field("u_covers", covers).key("not_declared").begin_array();
  for (const std::string& key : not_declared) json.value(key);
  json.end_array();
}

void write_covers(JsonWriter& json, const RunUncertainty& uncertainty) {
  write_covers(json, covers_text(uncertainty), uncertainty.not_declared);
}

void write_uncertainty(JsonWriter& json, Axis axis, const ErrorsUncertainty& uncertainty) {
  write_five(json, axis, "u", in_key_unit(uncertainty.u));
  write_five(json, axis, "u_random", in_key_unit(known(uncertainty.u_random)));
  write_five(json, axis, "U", in_key_unit(uncertainty.U));
  write_five(json, axis, "k", uncertainty.coverage_factor);
  write_five(json, axis, "nu_eff", uncertainty.freedom);
}

}  // namespace mdof
