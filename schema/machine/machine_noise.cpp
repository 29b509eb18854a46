#include "schema/machine/machine.h"

namespace mdof {

NoiseOnly noise_only(const Machine& machine, bool with_sources) {
  std::optional<NoiseOnly> all;
  const auto add = [&all](bool of) {
    all = all ? joined(*all, noise_only_if(of)) : noise_only_if(of);
  };
  for (const MachineFrame& frame : machine.frames) {
    for (const ErrorFunction& error : frame.error)
      if (!error.u.empty()) add(error.noise_only);
    for (const LocationError& location : frame.location)
      if (location.u) add(location.noise_only);
  }
  if (with_sources && !machine.sources.empty()) add(false);
  return all.value_or(NoiseOnly::none);
}

std::string covers_text(const Machine& machine, bool some_without_u, bool with_sources) {
  return error_covers_text(noise_only(machine, with_sources), some_without_u) +
         "; between the positions at which an error is given, u also contains the uncertainty of "
         "the interpolation";
}

}  // namespace mdof
