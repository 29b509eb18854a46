#include "algo/points/dwell_event.h"

#include <algorithm>
#include <cmath>

#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kSameStop_m = 50e-6;
constexpr std::int64_t kSameStop_ns = 1'000'000'000;

Notice notice_of(const DwellEvent& n, double time_s, double needed_s) {
  const double position_mm = to_mm(n.position_m), size_um = to_um(n.size_m);
  switch (n.kind) {
    case DwellEventKind::creep:
    case DwellEventKind::crept:
      return notice(
          n.kind == DwellEventKind::crept ? NoticeCode::stop_crept : NoticeCode::stop_creeping, "",
          {{"position_mm", position_mm},
           {"time_s", time_s},
           {"creep_um", size_um},
           {"length_s", n.length_s}});
    case DwellEventKind::short_stop:
      return notice(NoticeCode::stop_too_short, "",
                    {{"length_s", n.length_s},
                     {"position_mm", position_mm},
                     {"time_s", time_s},
                     {"needed_s", needed_s}});
    case DwellEventKind::hole:
      return notice(NoticeCode::recording_hole, "",
                    {{"length_s", n.length_s},
                     {"time_s", time_s},
                     {"position_mm", position_mm},
                     {"moved_mm", to_mm(n.size_m)}});
    case DwellEventKind::jump:
      break;
  }
  return notice(NoticeCode::encoder_jump, "",
                {{"jump_um", size_um}, {"position_mm", position_mm}, {"time_s", time_s}});
}

bool is_beside_point(const DwellEvent& n, const std::vector<Point>& points) {
  const auto length_ns = static_cast<std::int64_t>(n.length_s * 1e9);
  return std::any_of(points.begin(), points.end(), [&](const Point& p) {
    return std::abs(p.position_m - n.position_m) < kSameStop_m &&
           p.begin_ns < n.time_ns + length_ns + kSameStop_ns && n.time_ns < p.end_ns + kSameStop_ns;
  });
}

bool is_turn(const DwellEvent& n, const std::vector<Point>& points) {
  if (points.empty()) return false;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const Point& a, const Point& b) { return a.position_m < b.position_m; });
  return n.position_m < low->position_m - kSameStop_m ||
         n.position_m > high->position_m + kSameStop_m;
}

bool is_reported(const DwellEvent& n, const std::vector<Point>& points) {
  if (n.kind != DwellEventKind::creep && n.kind != DwellEventKind::short_stop) return true;
  return !is_beside_point(n, points) && !is_turn(n, points);
}

}  // namespace

Notices event_notices(const std::vector<DwellEvent>& events, const std::vector<Point>& points,
                      std::int64_t start_ns, double needed_s) {
  Notices all;
  for (const DwellEventKind kind :
       {DwellEventKind::jump, DwellEventKind::hole, DwellEventKind::creep, DwellEventKind::crept,
        DwellEventKind::short_stop}) {
    Notices alike;
    for (const DwellEvent& n : events)
      if (n.kind == kind && is_reported(n, points))
        alike.push_back(notice_of(n, ns_to_s(n.time_ns - start_ns), needed_s));
    append_first(all, std::move(alike));
  }
  return all;
}

}  // namespace mdof::algo
