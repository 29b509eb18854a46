#include "algo/separation/sides.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kLeastAlong = 0.5;  // cosine of the largest angle between probe and normal

bool is_same(const ProbeAcross& a, const ProbeAcross& b, double match_m) {
  return a.along == b.along && std::abs(a.place_m - b.place_m) <= match_m;
}

bool is_opposite(const ProbeAcross& a, const ProbeAcross& b) {
  return a.along != b.along || a.place_m * b.place_m < 0;
}

bool contradicts(const ProbeAcross& first, const ProbeAcross& probe, double height_sign,
                 double match_m) {
  return height_sign < 0 ? is_same(first, probe, match_m) : is_opposite(first, probe);
}

}  // namespace

std::vector<ProbeAcross> probes_across(const Rig& rig, Axis normal, const std::string& probe) {
  const auto n = static_cast<std::size_t>(normal);
  std::vector<ProbeAcross> found;
  for (const Probe& p : rig.probes)
    if ((probe.empty() || p.id == probe) && std::abs(p.direction[n]) > kLeastAlong)
      found.push_back({p.id, p.position_m[n], p.direction[n] > 0 ? 1.0 : -1.0});
  return found;
}

Notices compare_sides(const std::vector<SidesOfSetUp>& set_ups, double match_m) {
  Notices notices;
  for (std::size_t k = 1; k < set_ups.size(); ++k) {
    const SidesOfSetUp &first = set_ups.front(), &other = set_ups[k];
    const auto found =
        std::find_if(other.probes.begin(), other.probes.end(), [&](const ProbeAcross& probe) {
          return std::any_of(first.probes.begin(), first.probes.end(), [&](const ProbeAcross& p) {
            return p.id == probe.id && contradicts(p, probe, other.height_sign, match_m);
          });
        });
    if (found == other.probes.end()) continue;
    const NoticeCode code =
        other.height_sign < 0 ? NoticeCode::rigs_show_no_turn : NoticeCode::rigs_show_a_turn;
    notices.push_back(notice(code, found->id, {{"first", first.name}, {"other", other.name}}));
  }
  return notices;
}

}  // namespace mdof::algo
