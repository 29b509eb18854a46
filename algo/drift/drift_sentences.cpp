#include "algo/drift/drift_sentences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "schema/base/number/number_text.h"
#include "schema/base/number/uncertainty_digits.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kSecondsPerMinute = 60, kSecondsPerHour = 3600;

std::string change_text(const ErrorName& name, const SeriesDrift& drift, double sign) {
  const double u = to_key_unit(drift.u_change);
  const bool known = u > 0 && std::isfinite(u);
  const int decimals = known ? uncertainty_decimals(u) : name.angle ? 2 : 4;
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s %+.*f ± %.*f %s", name.name, std::max(0, decimals),
                rounded_to_tens(to_key_unit(sign * drift.change), decimals), std::max(0, decimals),
                rounded_to_tens(u, decimals), name.angle ? "µrad" : "µm");
  return text.data();
}

}  // namespace

std::string changes_text(const RunDrift& drift, const MovingAxis& moving, bool steps) {
  const Errors5 signs = named_from_local(moving, Errors5{1, 1, 1, 1, 1});
  const auto& names = error_names(moving.axis);
  std::string text;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const SeriesDrift& of = drift.errors[names[k].local];
    if (!of.significant() || of.steps != steps) continue;
    text += (text.empty() ? "" : ", ") + change_text(names[k], of, signs[k]);
  }
  if (text.empty()) return "";
  return text + " from the first point to the last (" +
         plain_number(drift.length_s / kSecondsPerMinute, 3) + " min)";
}

Notices removal_notices(const RunDrift& drift, const MovingAxis& moving) {
  if (!drift.not_seen.empty())
    return {notice(NoticeCode::drift_not_removed, "", {{"reason", drift.not_seen}})};
  const std::string removed = changes_text(drift, moving, false);
  const std::string left = changes_text(drift, moving, true);
  Notices found;
  found.push_back(removed.empty()
                      ? notice(NoticeCode::drift_not_removed, "",
                               {{"reason",
                                 "no drift can be distinguished from noise, steps and a "
                                 "variation whose period is about the duration of one "
                                 "run"}})
                      : notice(NoticeCode::drift_removed, "", {{"changes", removed}}));
  if (!left.empty())
    found.push_back(notice(NoticeCode::steps_not_removed, "", {{"changes", left}}));
  return found;
}

Notices reversal_notices(const DriftOfRun& drift, const std::vector<MeasuredPoint>& points,
                         const MovingAxis& moving, bool is_removed) {
  const Errors5 left = named_from_local(moving, drift.left_in_reversal(points, is_removed));
  const auto& names = error_names(moving.axis);
  std::string changes;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const double change = std::abs(to_key_unit(left[k]));
    if (change == 0) continue;
    changes += (changes.empty() ? "" : ", ") + std::string(names[k].name) + " " +
               plain_number(change, 2) + (names[k].angle ? " µrad" : " µm");
  }
  if (changes.empty()) return {};
  const bool can_be_removed = !is_removed && drift.found().removable();
  return {notice(can_be_removed ? NoticeCode::drift_in_reversal : NoticeCode::change_in_reversal,
                 "", {{"changes", changes}})};
}

Notices over_limit(const RunDrift& drift, const Rig& rig) {
  Notices found;
  if (!rig.drift_limit_m_per_s || !(drift.length_s > 0)) return found;
  for (std::size_t k = 0; k < std::min(drift.probes.size(), rig.probes.size()); ++k) {
    const double rate_m_per_s = drift.probes[k].range / drift.length_s;
    if (!drift.probes[k].significant() || !(rate_m_per_s > *rig.drift_limit_m_per_s)) continue;
    found.push_back(
        notice(NoticeCode::drift_over_limit, rig.probes[k].id,
               {{"rate_um_per_h", to_um(rate_m_per_s) * kSecondsPerHour},
                {"limit_um_per_h", to_um(*rig.drift_limit_m_per_s) * kSecondsPerHour}}));
  }
  return found;
}

}  // namespace mdof::algo
