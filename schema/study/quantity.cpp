#include "schema/study/quantity.h"

#include <cmath>

#include "schema/axis.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof {
namespace {

constexpr double kMicro = 1e-6, kMilli = 1e-3, kNano = 1e-9, kPercent = 1e-2;
constexpr std::size_t kX = 0, kY = 1, kZ = 2;

struct Word {
  const char* name;
  Effect effect;
  std::size_t axis;
  double to_si;
};

constexpr Word kOfProbe[] = {
    {"x_um", Effect::probe_shift, kX, kMicro},
    {"y_um", Effect::probe_shift, kY, kMicro},
    {"z_um", Effect::probe_shift, kZ, kMicro},
    {"position_um", Effect::probe_circle, 0, kMicro},
    {"tilt_mrad", Effect::probe_tilt, 0, kMilli},
    {"tilt_x_mrad", Effect::probe_tilt_about, kX, kMilli},
    {"tilt_y_mrad", Effect::probe_tilt_about, kY, kMilli},
    {"tilt_z_mrad", Effect::probe_tilt_about, kZ, kMilli},
    {"sensitivity_percent", Effect::probe_sensitivity, 0, kPercent},
    {"noise_nm", Effect::probe_noise, 0, kNano},
    {"zero_nm", Effect::probe_zero, 0, kNano},
    {"drift_nm", Effect::probe_drift, 0, kNano},
};
constexpr Word kOfPart[] = {
    {"x_um", Effect::part_shift, kX, kMicro},      {"y_um", Effect::part_shift, kY, kMicro},
    {"z_um", Effect::part_shift, kZ, kMicro},      {"roll_mrad", Effect::part_turn, kX, kMilli},
    {"pitch_mrad", Effect::part_turn, kY, kMilli}, {"yaw_mrad", Effect::part_turn, kZ, kMilli},
};
constexpr Word kOfTop[] = {
    {"roll_mrad", Effect::plane_turn, kX, kMilli},
    {"pitch_mrad", Effect::plane_turn, kY, kMilli},
    {"flatness_um", Effect::plane_flatness, 0, kMicro},
    {"map_percent", Effect::plane_map, 0, kPercent},
};
constexpr Word kOfSide[] = {
    {"roll_mrad", Effect::plane_turn, kX, kMilli},
    {"yaw_mrad", Effect::plane_turn, kZ, kMilli},
    {"flatness_um", Effect::plane_flatness, 0, kMicro},
    {"map_percent", Effect::plane_map, 0, kPercent},
};
constexpr Word kAlone[] = {
    {"target.square_urad", Effect::square, 0, kMicro},
    {"encoder.offset_um", Effect::encoder_offset, 0, kMicro},
    {"encoder.scale_ppm", Effect::encoder_scale, 0, kMicro},
    {"encoder.noise_nm", Effect::encoder_noise, 0, kNano},
    {"temperature.fixture_K", Effect::fixture_heat, 0, 1},
    {"temperature.target_K", Effect::target_heat, 0, 1},
    {"travel_mm", Effect::travel, 0, kMilli},
};

QuantityTarget target_of(const std::string& prefix, const Word& word) {
  QuantityTarget target;
  target.name = prefix + word.name;
  target.effect = word.effect;
  target.axis = word.axis;
  target.to_si = word.to_si;
  return target;
}

template <std::size_t n>
void append_part(std::vector<QuantityTarget>& all, const std::string& prefix, Part part,
                 const Word (&words)[n]) {
  for (const Word& word : words) {
    all.push_back(target_of(prefix, word));
    all.back().part = part;
  }
}

// Returns all quantities that can vary with this rig, in the order in which they are listed for the
// user.
std::vector<QuantityTarget> all_targets(const Rig& rig) {
  std::vector<QuantityTarget> all;
  for (std::size_t k = 0; k < rig.probes.size(); ++k) {
    for (const Word& word : kOfProbe) {
      all.push_back(target_of("probe." + rig.probes[k].id + ".", word));
      all.back().probe = k;
    }
  }
  append_part(all, "installation.", Part::fixture, kOfPart);
  append_part(all, "installation.top.", Part::top, kOfPart);
  append_part(all, "installation.side.", Part::side, kOfPart);
  append_part(all, "target.top.", Part::top, kOfTop);
  append_part(all, "target.side.", Part::side, kOfSide);
  for (const Word& word : kAlone) all.push_back(target_of("", word));
  for (const ErrorName& error : error_names(rig.axis)) {
    all.push_back(target_of(
        "truth.",
        {error.key, Effect::truth, static_cast<std::size_t>(error.local), error.sign * kMicro}));
  }
  return all;
}

constexpr std::string_view kStar = "probe.*.";

}  // namespace

std::vector<std::string> quantity_names(const Rig& rig) {
  std::vector<std::string> names;
  for (const Word& word : kOfProbe) names.push_back(std::string(kStar) + word.name);
  for (const QuantityTarget& target : all_targets(rig)) names.push_back(target.name);
  return names;
}

Result<std::vector<QuantityTarget>> resolve_quantity(std::string_view name, const Rig& rig) {
  std::vector<QuantityTarget> found;
  for (QuantityTarget& target : all_targets(rig)) {
    const bool starred = name.starts_with(kStar) && target.name.starts_with("probe.") &&
                         target.name == "probe." + rig.probes[target.probe].id + "." +
                                            std::string(name.substr(kStar.size()));
    if (starred || target.name == name) found.push_back(std::move(target));
  }
  if (!found.empty()) return found;
  const std::string near = nearest_candidate(name, quantity_names(rig));
  return bad_input(
      "no quantity of rig \"" + rig.name + "\" is called \"" + std::string(name) + "\"; " +
      (near.empty() ? "a name begins with \"probe.\", \"installation.\", \"target.\", "
                      "\"encoder.\", \"temperature.\" or \"truth.\", or is \"travel_mm\""
                    : "did you mean \"" + near + "\"?"));
}

}  // namespace mdof
