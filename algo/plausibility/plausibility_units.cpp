// Does each quantity look as if it were in the unit that it is said to be in?
#include <algorithm>
#include <cmath>
#include <string>

#include "algo/plausibility/plausibility.h"
#include "algo/plausibility/sentences.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLongestAxis_m = 2;  // of a machine for whose axes such a fixture is made
constexpr double kShortestAxis_m = 0.5e-3;
constexpr double kSlowest_hz = 2;  // of a log in seconds
constexpr double kFastest_hz = 2e6;
constexpr double kLargestFixture_m = 0.5;
constexpr double kSmallestFixture_m = 0.5e-3;
constexpr double kNarrowFixture_m = 5e-3;  // five probes have no room in less
constexpr double kWideFixture_m = 0.15, kWideByTravel = 5;
constexpr double kQuietest_m = 0.5e-9;  // sd of any amplifier
constexpr double kNoisiest = 2.5e-3;    // sd in parts of the range
constexpr double kNoisiest_m = 1e-6;
constexpr double kOneOfThousand = 1e-3;
constexpr double kOffZero = 0.1;  // of the range, of a gap whose offset is not given

std::string joined(const Texts& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

double largest(const ProbeFigures& p) {
  return std::max(std::abs(p.min_m), std::abs(p.max_m));
}

// All that a probe reads lies within a thousandth of its half range, and it is quieter than any
// amplifier. A reading that does not change at all is another matter.
bool looks_like_mm(const ProbeFigures& figures, const Probe& probe) {
  return figures.points > 0 && figures.travel_m > 0 && figures.sd_m < kQuietest_m &&
         largest(figures) <= kOneOfThousand * probe.range_m / 2;
}

bool looks_like_nm(const ProbeFigures& figures, const Probe& probe) {
  return figures.points > 0 && figures.sd_m > std::max(kNoisiest_m, kNoisiest * probe.range_m);
}

// A gap is never 0: without an offset its "displacement" is the whole gap.
bool lacks_offset(const ProbeFigures& figures, const Probe& probe) {
  const Calibration& c = probe.calibration;
  return c.reads_gap && c.offset_um == 0 && figures.points > 0 && figures.max_m < 0 &&
         -0.5 * (figures.min_m + figures.max_m) > kOffZero * probe.range_m;
}

Texts names_of(const Rig& rig, const Plausibility& figures,
               bool (*is)(const ProbeFigures&, const Probe&)) {
  Texts names;
  for (std::size_t k = 0; k < figures.probes.size(); ++k)
    if (is(figures.probes[k], rig.probes[k])) names.push_back(figures.probes[k].id);
  return names;
}

void judge_probes(const Rig& rig, const Plausibility& figures, Texts& out) {
  const Texts mm = names_of(rig, figures, looks_like_mm);
  if (!mm.empty())
    out.push_back("probe " + joined(mm) +
                  ": all readings are within a thousandth of the range and quieter than 0.5 nm, as "
                  "if they were in mm; a column _um must be in um");
  const Texts nm = names_of(rig, figures, looks_like_nm);
  if (!nm.empty())
    out.push_back("probe " + joined(nm) +
                  ": the noise in a dwell is more than 1 um and 0.25 % of the range, as if the "
                  "readings were in nm; a column _um must be in um; else check cable and earthing");
  const Texts gap = names_of(rig, figures, lacks_offset);
  if (gap.empty()) return;
  const auto first = std::find_if(figures.probes.begin(), figures.probes.end(),
                                  [&](const ProbeFigures& p) { return p.id == gap.front(); });
  out.push_back("probe " + joined(gap) +
                ": reads the gap and has no offset_um, so the whole gap counts as displacement; "
                "give the gap at the nominal surface in the rig (" +
                gap.front() + " reads about " +
                with_number("%.3g um)", -0.5 * to_um(first->min_m + first->max_m)));
}

void judge_fixture(const Rig& rig, double travel_m, Texts& out) {
  double size_m = 0, origin_m = 0;
  for (const Probe& a : rig.probes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_m = std::max(origin_m, std::abs(a.position_m[axis]));
      for (const Probe& b : rig.probes)
        size_m = std::max(size_m, std::abs(a.position_m[axis] - b.position_m[axis]));
    }
  }
  if (std::max(size_m, origin_m) > kLargestFixture_m)
    out.push_back("the fixture reaches " + with_number("%.4g m", std::max(size_m, origin_m)) +
                  ": position_mm in the rig seems to be in um");
  else if (size_m > std::max(kWideFixture_m, kWideByTravel * travel_m))
    out.push_back("the probes are " + with_number("%.4g mm", to_mm(size_m)) +
                  " apart and the axis travels " + with_number("%.4g mm", to_mm(travel_m)) +
                  ": are the lengths of position_mm in the rig ten times too large?");
  if (size_m < kNarrowFixture_m && size_m >= kSmallestFixture_m)
    out.push_back("the probes are only " + with_number("%.4g mm", to_mm(size_m)) +
                  " apart, where five of them have no room: position_mm in the rig seems to be in "
                  "cm");
  if (size_m < kSmallestFixture_m)
    out.push_back("the probes are only " + with_number("%.4g mm", to_mm(size_m)) +
                  " apart: position_mm in the rig seems to be in m");
}

void judge_time(const Plausibility& figures, Texts& out) {
  const std::string rate = with_number("%.4g Hz", figures.rate_hz);
  if (figures.rate_hz < kSlowest_hz)
    out.push_back("the log has " + rate + ": time_s seems to be in ms or us, not in s");
  if (figures.rate_hz > kFastest_hz)
    out.push_back("the log has " + rate + ": time_s seems to be in minutes or hours, not in s");
}

}  // namespace

std::string encoder_unit_doubt(double travel_m) {
  if (travel_m > kLongestAxis_m)
    return "the axis travels " + with_number("%.4g m", travel_m) + ": encoder_mm seems to be in um";
  if (travel_m < kShortestAxis_m)
    return "the axis travels only " + with_number("%.4g mm", to_mm(travel_m)) +
           ": encoder_mm seems to be in m";
  return "";
}

std::vector<std::string> warnings_of_units(const Rig& rig, const Plausibility& figures) {
  Texts out;
  const std::string encoder = encoder_unit_doubt(figures.encoder_max_m - figures.encoder_min_m);
  if (!encoder.empty()) out.push_back(encoder);
  judge_time(figures, out);
  judge_probes(rig, figures, out);
  judge_fixture(rig, figures.encoder_max_m - figures.encoder_min_m, out);
  return out;
}

}  // namespace mdof::algo
