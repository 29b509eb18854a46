#include "schema/uncertainty/run_uncertainty.h"

#include <cmath>

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
  if (!uncertainty.why.empty()) return "noise only: " + uncertainty.why;
  return uncertainty.noise_only ? "noise only: the rig declares no uncertainties"
                                : "noise and what the rig declares";
}

void write_covers(JsonWriter& json, const RunUncertainty& uncertainty) {
  json.field("u_covers", covers_text(uncertainty)).key("u_not_declared").begin_array();
  for (const std::string& key : uncertainty.not_declared) json.value(key);
  json.end_array();
}

void write_uncertainty(JsonWriter& json, Axis axis, const ErrorsUncertainty& uncertainty) {
  write_five(json, axis, "u", in_key_unit(uncertainty.u));
  write_five(json, axis, "u_random", in_key_unit(uncertainty.u_random));
  write_five(json, axis, "U", in_key_unit(uncertainty.U));
  write_five(json, axis, "k", uncertainty.coverage_factor);
  write_five(json, axis, "nu_eff", uncertainty.freedom);
}

}  // namespace mdof
