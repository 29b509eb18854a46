#include "schema/rig/effects/physics.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/calibration/certificate_facts.h"
#include "schema/rig/calibrated.h"
#include "schema/rig/rig.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr double kMostRadius_mm = 50, kMostStandoff_um = 1e5, kMostTiltFactor = 100;
// Number of points of the range at which a correction is checked.
constexpr int kCorrectionSamples = 200;
// Part of the range that a correction must include; a reading beyond it is at an end of the range.
constexpr double kRangeCovered = 0.999;

double positive(TomlTable& table, const char* key, double most) {
  if (!table.has(key)) return 0;
  const double x = table.number(key);
  if (!(x > 0 && x <= most))
    table.reject(key, "must be greater than zero and at most " + plain_number(most) + ", not " +
                          plain_number(x));
  return x;
}

void check_standoff(TomlTable& table, const Probe& probe, const ProbePhysics& physics) {
  if (physics.standoff_m == 0 || probe.calibration.reads_gap) return;
  if (physics.standoff_m < probe.range_m / 2)
    table.reject("standoff_um",
                 plain_number(to_um(physics.standoff_m)) +
                     " um is less than half of range_um, so the probe would touch the target at "
                     "the end of its range; give the gap at which the probe reads 0");
}

ProbePhysics read_probe_physics(TomlTable& table, const Probe& probe) {
  ProbePhysics physics;
  physics.sensing_radius_m = from_mm(positive(table, "sensing_radius_mm", kMostRadius_mm));
  physics.standoff_m = from_um(positive(table, "standoff_um", kMostStandoff_um));
  if (physics.standoff_m == 0 && probe.calibration.reads_gap)
    physics.standoff_m = std::max(0.0, from_um(probe.calibration.offset_um));
  check_standoff(table, probe, physics);
  const bool has_factor = table.has("tilt_factor"), has_u = table.has("u_tilt_factor");
  if (has_factor) physics.tilt_factor = positive(table, "tilt_factor", kMostTiltFactor);
  physics.u_tilt_factor = read_uncertainty(table, "u_tilt_factor", 1, kMostTiltFactor);
  if (!has_factor && !has_u)
    physics.u_tilt_factor = {kTiltFactorHalfWidth / std::sqrt(3.0), UncertaintyShape::rectangular};
  if ((has_factor || has_u) && physics.sensing_radius_m == 0)
    table.reject(has_factor ? "tilt_factor" : "u_tilt_factor",
                 "needs the radius of the electrode; add sensing_radius_mm");
  physics.u_linearity = read_uncertainty(table, "u_linearity_um", from_um(1), kMostU_um);
  return physics;
}

double read_air(TomlTable& table, const std::string& key, const AirQuantity& of) {
  const double x = table.number(key);
  if (!(x >= of.least && x <= of.most))
    table.reject(key, plain_number(x) + " is not a possible " + of.name + " of air; give " +
                          plain_number(of.least) + " to " + plain_number(of.most) + " " + of.unit);
  return x;
}

std::optional<DeclaredAir> read_air(TomlTable& root) {
  auto table = root.table("air");
  if (!table) return std::nullopt;
  DeclaredAir air;
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    const AirQuantity& of = air_quantities()[q];
    const std::string calibration = std::string("calibration_") + of.key;
    if (table->has(of.key)) air.run[q] = read_air(*table, of.key, of);
    air.calibration[q] = read_air(*table, calibration, of);
    air.u_run[q] = read_uncertainty(*table, std::string("u_") + of.key, 1, of.most - of.least);
    air.u_calibration[q] = read_uncertainty(*table, "u_" + calibration, 1, of.most - of.least);
  }
  return air;
}

bool rises(const Calibration& c, const std::array<double, 2>& range) {
  std::vector<double> at;
  for (int i = 0; i <= kCorrectionSamples; ++i)
    at.push_back(range[0] + (range[1] - range[0]) * i / kCorrectionSamples);
  for (const auto& row : c.linearity) at.push_back(row[0]);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  for (std::size_t i = 1; i < at.size(); ++i)
    if (!(at[i] + linearity_um(c, at[i]) > at[i - 1] + linearity_um(c, at[i - 1]))) return false;
  return true;
}

// The corrected reading must increase with the reading. `requested`: the linearity correction must
// be declared and must include all possible readings. Otherwise, a polynomial may be made for a
// part of the readings.
void check_linearity(TomlTable& table, const Probe& probe, bool requested) {
  const Calibration& c = probe.calibration;
  const char* key = c.polynomial_um.empty() ? "linearity" : "polynomial_um";
  if (c.linearity.empty() && !requested) return;
  if (c.linearity.empty() && c.polynomial_um.empty())
    return table.reject(
        key,
        "is missing, but [corrections] linearity = true needs this key for each probe; add "
        "\"linearity\" or \"polynomial_um\", or remove the correction from [corrections]");
  const auto range = readings_of_range(probe);
  if (!rises(c, range))
    return table.reject(key,
                        "is not monotonic: the sum of reading and correction does not increase "
                        "with the reading, so two readings would give the same displacement; "
                        "correct the values (in um), or repeat the calibration of this probe");
  if (c.linearity.empty() || !requested) return;
  const double middle = (range[0] + range[1]) / 2, half = kRangeCovered * (range[1] - middle);
  if (c.linearity.front()[0] <= middle - half && c.linearity.back()[0] >= middle + half) return;
  table.reject(key, "covers readings from " + plain_number(c.linearity.front()[0], 6) + " to " +
                        plain_number(c.linearity.back()[0], 6) + " um, but the probe reads from " +
                        plain_number(range[0], 6) + " to " + plain_number(range[1], 6) +
                        " um; extend the table, or give the used range of the probe as valid_um");
}

void remove_linearity(Rig& rig, RigPhysics& physics) {
  for (Probe& probe : rig.probes) {
    physics.left_out.push_back(std::make_shared<Calibration>(probe.calibration));
    probe.calibration.linearity.clear();
    probe.calibration.polynomial_um.clear();
  }
}

void need(TomlTable& table, const char* key, bool known, const char* correction) {
  if (known) return;
  table.reject(key, std::string("is missing, but [corrections] ") + correction +
                        " = true needs this key for each probe; add the key, or remove the "
                        "correction from [corrections]");
}

void check_needs(TomlTable& root, std::vector<TomlTable>& tables, const Rig& rig,
                 const RigPhysics& physics) {
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const ProbePhysics& probe = physics.probes[k];
    if (physics.linearity.value_or(true))
      check_linearity(tables[k], rig.probes[k], physics.linearity.has_value());
    if (physics.tilt) need(tables[k], "sensing_radius_mm", probe.sensing_radius_m > 0, "tilt");
    if (physics.tilt) need(tables[k], "standoff_um", probe.standoff_m > 0, "tilt");
    if (physics.dielectric) need(tables[k], "standoff_um", probe.standoff_m > 0, "dielectric");
  }
  if (physics.dielectric && !physics.air)
    root.reject(
        "air",
        "is missing, but [corrections] dielectric = true needs this table; add a table [air] with "
        "calibration_temperature_C, calibration_pressure_kPa and calibration_humidity_percent");
}

bool declares_any_effect(const RigPhysics& physics) {
  return physics.asked || physics.air ||
         std::any_of(physics.probes.begin(), physics.probes.end(), [](const ProbePhysics& p) {
           return p.sensing_radius_m > 0 || p.u_linearity.declared();
         });
}

// Standard uncertainties of the corrections from certificates. They are in the records after the
// text of the rig.
void apply_certificate_uncertainties(TomlTable& table, const Rig& rig, RigPhysics& physics) {
  auto records = table.tables("calibration_record");
  for (const std::size_t i : order_of_records(records))
    for (TomlTable& probe : records[i].tables("probe")) {
      const CertificateFacts facts = read_certificate(probe);
      const auto at = rig.probe_index(probe.string("id"));
      if (at && facts.u_linearity_m > 0)
        physics.probes[*at].u_linearity = DeclaredUncertainty{facts.u_linearity_m};
    }
}

}  // namespace

const std::array<AirQuantity, kAirQuantities>& air_quantities() {
  static constexpr std::array<AirQuantity, kAirQuantities> kQuantities = {{
      {"temperature_C", "temperature", "°C", -20, 50},
      {"pressure_kPa", "pressure", "kPa", 30, 120},
      {"humidity_percent", "humidity", "%", 0, 100},
  }};
  return kQuantities;
}

bool RigPhysics::has_known_air_effect() const {
  return air && std::all_of(probes.begin(), probes.end(),
                            [](const ProbePhysics& p) { return p.standoff_m > 0; });
}

void read_physics(TomlTable& table, Rig& rig) {
  RigPhysics physics;
  if (auto corrections = table.table("corrections")) {
    physics.asked = true;
    if (corrections->has("linearity")) physics.linearity = corrections->boolean("linearity");
    physics.tilt = corrections->boolean("tilt", false);
    physics.dielectric = corrections->boolean("dielectric", false);
  }
  physics.air = read_air(table);
  auto tables = table.tables("probe");
  if (tables.size() != rig.probes.size()) return;  // parse_rig() rejects this
  for (std::size_t k = 0; k < tables.size(); ++k) {
    physics.probes.push_back(read_probe_physics(tables[k], rig.probes[k]));
    rig.probes[k].standoff_m = physics.probes.back().standoff_m;
  }
  apply_certificate_uncertainties(table, rig, physics);
  check_needs(table, tables, rig, physics);
  if (!physics.linearity.value_or(true)) remove_linearity(rig, physics);
  if (declares_any_effect(physics))
    rig.physics = std::make_shared<const RigPhysics>(std::move(physics));
}

std::array<double, 2> readings_of_range(const Probe& probe) {
  const Calibration& c = probe.calibration;
  const double range_um = to_um(probe.range_m);
  std::array<double, 2> raw{-range_um / 2, range_um / 2};
  if (c.reads_gap) raw = {0, range_um};
  if (c.valid_um) raw = *c.valid_um;
  return {raw[0] - c.offset_um, raw[1] - c.offset_um};
}

double linearity_um(const Calibration& c, double reading_um) {
  if (!c.polynomial_um.empty()) {
    double sum = 0;
    for (auto k = c.polynomial_um.rbegin(); k != c.polynomial_um.rend(); ++k)
      sum = sum * reading_um + *k;
    return sum;
  }
  const auto& table = c.linearity;
  if (table.empty() || std::isnan(reading_um)) return 0.0;  // NaN cannot be found in a table
  if (reading_um <= table.front()[0]) return table.front()[1];
  if (reading_um >= table.back()[0]) return table.back()[1];
  const auto above =
      std::upper_bound(table.begin(), table.end(), reading_um,
                       [](double x, const std::array<double, 2>& row) { return x < row[0]; });
  const auto& [x1, y1] = *above;
  const auto& [x0, y0] = *(above - 1);
  return y0 + (y1 - y0) * ((reading_um - x0) / (x1 - x0));
}

}  // namespace mdof
