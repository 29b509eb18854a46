#include "schema/rig/rig_tables.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr double kMostPoint_mm = 2000;
constexpr double kLeastScale_um_per_V = 1e-3, kMostScale_um_per_V = 1e7;
constexpr double kMostArtefactU_urad = 1e5;

}  // namespace

Vec3 read_point(TomlTable& table, const char* key) {
  const Vec3 mm = table.vector3(key);
  const double most = *std::max_element(
      mm.begin(), mm.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  if (!(std::abs(most) <= kMostPoint_mm))
    table.reject(key, "must be three numbers in mm, each from -2000 to 2000, not " +
                          plain_number(most) + "; give the point in mm, not um");
  return {from_mm(mm[0]), from_mm(mm[1]), from_mm(mm[2])};
}

double read_delay_s(TomlTable& table, const char* meaning) {
  constexpr double kMost_us = 10e6;
  const double delay_us = table.number("delay_us", 0);
  if (!(delay_us >= 0 && delay_us <= kMost_us))
    table.reject(
        "delay_us",
        std::string("must be from 0 to 10000000 us; the key states the delay of the ") + meaning);
  return delay_us / 1e6;
}

void read_encoder(TomlTable& table, Rig& rig) {
  auto encoder = table.table("encoder");
  if (!encoder) return;
  rig.uncertainty.encoder = read_uncertainty(*encoder, "u_um", from_um(1), kMostU_um);
  rig.encoder_delay_s =
      read_delay_s(*encoder, "readings of the encoder, for example because of a filter");
  const bool others = rig.uncertainty.encoder.known() || encoder->has("delay_us");
  if (!encoder->has("um_per_V") && others) return;
  const double um_per_V = encoder->number("um_per_V");
  if (!(std::abs(um_per_V) >= kLeastScale_um_per_V && std::abs(um_per_V) <= kMostScale_um_per_V))
    encoder->reject(
        "um_per_V",
        "must be the motion of the axis in um for each volt of the encoder: from 0.001 to "
        "10000000, with a minus sign if the voltage decreases when the position increases, not " +
            plain_number(um_per_V));
  rig.encoder_um_per_V = um_per_V;
}

void read_installation_and_drift(TomlTable& table, Rig& rig) {
  if (auto installation = table.table("installation")) {
    rig.uncertainty.installation_angle =
        read_uncertainty3(*installation, "u_angle_mrad", 1e-3, kMostU_mrad);
    rig.uncertainty.installation_offset =
        read_uncertainty3(*installation, "u_offset_mm", from_mm(1), kMostU_mm);
  }
  auto drift = table.table("drift");
  if (!drift) return;
  rig.uncertainty.drift = read_uncertainty(*drift, "u_um_per_h", from_um(1) / 3600, kMostU_um);
  if (!drift->has("limit_um_per_h")) return;
  const double limit_um_per_h = drift->number("limit_um_per_h");
  if (!(limit_um_per_h > 0 && limit_um_per_h <= kMostU_um))
    drift->reject("limit_um_per_h",
                  "must be greater than 0 and at most " + plain_number(kMostU_um) + ", not " +
                      plain_number(limit_um_per_h) +
                      " (the largest permitted drift of probe readings, in um/h)");
  rig.drift_limit_m_per_s = from_um(limit_um_per_h) / 3600;
}

void read_artefact(TomlTable& table, Rig& rig) {
  if (table.has("artefact_angle_error_urad")) {
    rig.artefact_angle_error_rad = from_urad(table.number("artefact_angle_error_urad"));
  }
  if (!table.has("u_artefact_angle_urad")) return;
  const double u_urad = table.number("u_artefact_angle_urad");
  check_uncertainty(table, "u_artefact_angle_urad", u_urad, kMostArtefactU_urad);
  rig.u_artefact_angle_rad = from_urad(u_urad);
}

}  // namespace mdof
