#include "schema/rig/check/rig_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "schema/base/toml/toml_reader.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof {
namespace {

// A number outside `possible` is wrong. A number outside `usual` may be correct.
struct Bounds {
  double least_possible, least_usual, most_usual, most_possible;
};
constexpr double kMost_m = 0.5;          // largest distance between a probe or plane and the origin
constexpr double kStandoffShare = 0.05;  // largest usual difference of standoff and gap reading
constexpr Bounds kExtent_mm = {0.1, 1, 500, 500};     // largest distance between two probes
constexpr Bounds kRange_um = {1, 5, 20e3, 100e3};     // capacitance probes have 10 µm to 10 mm
constexpr Bounds kFull_V = {1e-3, 0.05, 100, 1000};   // full range in volts, from um_per_V
constexpr Bounds kCorrectionRatio = {0, 0, 0.1, 1};   // linearity correction / range
constexpr Bounds kFlatness_um = {0, 0, 100, 10e3};    // heights of a target plane
constexpr Bounds kArtefact_urad = {0, 0, 10e3, 1e5};  // angle error of a square

struct Finding {
  bool impossible;
  std::string text;
};

std::string text_of(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", x);
  return text.data();
}

// Returns "rig.toml:12: probe.range_um: ". It parses the rig again; this happens only if there is
// an error or a notice.
std::string place(const Rig& rig, const char* table, std::size_t index, const char* key) {
  auto root = TomlTable::parse(rig.text, rig.source);
  if (!root) return rig.source + ": " + key + ": ";
  if (*table == '\0') return root->where(key) + ": ";
  auto tables = root->tables(table);
  return (index < tables.size() ? tables[index].where(key) : rig.source + ": " + key) + ": ";
}

class Check {
 public:
  explicit Check(const Rig& rig) : rig_(rig) {
    for (std::size_t k = 0; k < rig.probes.size(); ++k) check_probe(k);
    check_distances();
    for (std::size_t k = 0; k < rig.planes.size(); ++k) check_plane(k);
    within(kArtefact_urad, std::abs(to_urad(rig.artefact_angle_error_rad.value_or(0))), "", 0,
           "artefact_angle_error_urad",
           " urad is an unusual deviation of a square from 90 degrees; check that the value is in "
           "urad");
  }

  std::vector<Finding> take() { return std::move(findings_); }

 private:
  void add(bool impossible, const char* table, std::size_t index, const char* key,
           const std::string& why) {
    findings_.push_back({impossible, place(rig_, table, index, key) + why});
  }
  // `why` begins with the unit of x and ends with the remedy.
  void within(const Bounds& bounds, double x, const char* table, std::size_t index, const char* key,
              const std::string& why) {
    if (x >= bounds.least_usual && x <= bounds.most_usual) return;
    add(!(x >= bounds.least_possible && x <= bounds.most_possible), table, index, key,
        text_of(x) + why);
  }
  void check_probe(std::size_t k);
  void check_calibration(std::size_t k);
  void check_gap(std::size_t k);
  void check_distances();
  void check_plane(std::size_t k);

  const Rig& rig_;
  std::vector<Finding> findings_;
};

double length(const Vec3& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void Check::check_probe(std::size_t k) {
  const Probe& probe = rig_.probes[k];
  if (!(length(probe.position_m) <= kMost_m))
    add(true, "probe", k, "position_mm",
        "probe \"" + probe.id + "\" is " + text_of(to_mm(length(probe.position_m))) +
            " mm from the origin of the metrology frame, but the limit is " +
            text_of(to_mm(kMost_m)) + " mm; give position_mm in mm, not um");
  within(kRange_um, to_um(probe.range_m), "probe", k, "range_um",
         " um is an unusual range of the probe \"" + probe.id +
             "\"; give the full range in um, not mm or nm");
  check_calibration(k);
  check_gap(k);
}

void Check::check_calibration(std::size_t k) {
  const Probe& probe = rig_.probes[k];
  const Calibration& c = probe.calibration;
  const double range_um = to_um(probe.range_m);
  if (c.um_per_V)
    within(kFull_V, range_um / std::abs(*c.um_per_V), "probe", k, "um_per_V",
           " V is an unusual full range of the probe \"" + probe.id +
               "\" (range_um divided by um_per_V); give range_um in um, and um_per_V in um of "
               "displacement per volt");
  if (c.valid_um && std::max(-(*c.valid_um)[0], (*c.valid_um)[1]) > kRange_um.most_possible)
    add(true, "probe", k, "valid_um",
        "the probe \"" + probe.id + "\" has a limit of its readings beyond " +
            text_of(kRange_um.most_possible) + " um; give the limits as raw readings in um");
  double most_um = 0;
  for (const auto& [reading_um, correction_um] : c.linearity)
    most_um = std::max(most_um, std::abs(correction_um));
  // Beyond the range that it was made for, a polynomial can have any value, so that a large value
  // is never impossible.
  const auto [first_um, last_um] = readings_of_range(probe);
  if (!c.polynomial_um.empty())
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0})
      most_um = std::max(
          most_um,
          std::min(range_um, std::abs(linearity_um(c, first_um + share * (last_um - first_um)))));
  within(
      kCorrectionRatio, most_um / range_um, "probe", k,
      c.polynomial_um.empty() ? "linearity" : "polynomial_um",
      " times the range is an unusual linearity correction of the probe \"" + probe.id +
          "\"; give the corrections that mdof adds to the readings, " +
          (c.polynomial_um.empty() ? "as pairs [reading_um, correction_um]"
                                   : "not a polynomial that calculates the displacement itself"));
  if (first_um <= 0 && last_um >= 0) return;
  add(std::abs(c.offset_um) > kRange_um.most_possible, "probe", k, "offset_um",
      text_of(c.offset_um) + " um is outside the range of readings of the probe \"" + probe.id +
          "\" (" + text_of(first_um + c.offset_um) + " to " + text_of(last_um + c.offset_um) +
          " um); give the raw reading at the nominal surface, in um");
}

// A probe with reads = "gap" reads the gap, so standoff_um and offset_um are the same gap. A
// reading that can be negative is a gap minus a constant.
void Check::check_gap(std::size_t k) {
  const Probe& probe = rig_.probes[k];
  const Calibration& c = probe.calibration;
  const double standoff_um = to_um(probe.standoff_m);
  if (!c.reads_gap || standoff_um == 0) return;
  const double low_um = readings_of_range(probe)[0] + c.offset_um;
  const double closed_um = c.offset_um - standoff_um;  // reading when the gap is closed
  // Without the key, standoff_um is offset_um.
  if (std::abs(closed_um) <= kStandoffShare * standoff_um) return;
  if (low_um < 0 && closed_um <= low_um) return;
  add(closed_um > low_um, "probe", k, "standoff_um",
      text_of(standoff_um) + " um contradicts offset_um = " + text_of(c.offset_um) +
          " um of the probe \"" + probe.id +
          "\" (reads = \"gap\"): with both values, the probe would touch the target at the "
          "reading " +
          text_of(closed_um) +
          " um; correct one of the two keys, or remove standoff_um (mdof then takes offset_um as "
          "the gap)");
}

// Checks the largest distance between two probes.
void Check::check_distances() {
  double extent_m = 0;
  std::size_t a = 0, b = 0;
  for (std::size_t i = 0; i < rig_.probes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 &p = rig_.probes[i].position_m, &q = rig_.probes[j].position_m;
      const double distance_m = length({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
      if (distance_m <= extent_m) continue;
      extent_m = distance_m;
      a = j, b = i;
    }
  }
  if (extent_m == 0) return;  // all probes are at one point; the message of the solver is clearer
  within(kExtent_mm, to_mm(extent_m), "probe", b, "position_mm",
         " mm is an unusual distance between two probes (\"" + rig_.probes[a].id + "\" and \"" +
             rig_.probes[b].id + "\"); give positions in mm, not " +
             (to_mm(extent_m) > kExtent_mm.most_usual ? "um" : "m"));
}

void Check::check_plane(std::size_t k) {
  const TargetPlane& plane = rig_.planes[k];
  if (plane.offset_m && !(std::abs(*plane.offset_m) <= kMost_m))
    add(true, "plane", k, "offset_mm",
        text_of(to_mm(*plane.offset_m)) +
            " mm from the origin of the carriage frame is too far for a plane of a target; give "
            "offset_mm in mm");
  double most_m = 0;
  for (const double height_m : plane.flatness.height_m)
    most_m = std::max(most_m, std::abs(height_m));
  within(kFlatness_um, to_um(most_m), "plane", k, "flatness_um",
         " um is an unusual flatness of a target; give heights in um, not nm");
}

std::vector<Finding> findings_of(const Rig& rig) {
  return Check(rig).take();
}

}  // namespace

Status check_rig(const Rig& rig) {
  for (const Finding& finding : findings_of(rig))
    if (finding.impossible) return bad_input(finding.text);
  return {};
}

Notices unusual_values(const Rig& rig) {
  Notices found;
  for (const Finding& finding : findings_of(rig))
    if (!finding.impossible)
      found.push_back(notice(NoticeCode::rig_value_doubtful, "", {{"finding", finding.text}}));
  return found;
}

}  // namespace mdof
