#include "algo/points/dwell_notice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kSentences = 10;
constexpr double kSameStop_m = 50e-6;
constexpr std::int64_t kSameStop_ns = 1'000'000'000;

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 320> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

std::string sentence(const DwellNotice& n, double time_s, double needed_s) {
  const double at_mm = to_mm(n.position_m), size_um = to_um(n.size_m);
  switch (n.kind) {
    case NoticeKind::creep:
      return text(
          "a stop near %.4f mm, %.3f s after the first scan, crept by %.3g um within %.3f s and "
          "was left out; let the axis come to rest there (servo, brake)",
          at_mm, time_s, size_um, n.length_s);
    case NoticeKind::crept:
      return text(
          "a stop at %.4f mm, %.3f s after the first scan, crept by %.3g um within %.3f s: its "
          "point has the flag creep; let the axis come to rest there (servo, brake)",
          at_mm, time_s, size_um, n.length_s);
    case NoticeKind::short_stop:
      return text(
          "a stop of %.3f s at %.4f mm, %.3f s after the first scan, was too short (%.3f s are "
          "needed) and was left out; stop longer, or change --settle-s or --min-length-s",
          n.length_s, at_mm, time_s, needed_s);
    case NoticeKind::hole:
      return text(
          "no position was recorded for %.3f s, %.3f s after the first scan, at %.4f mm (%+.4f mm "
          "until it went on): a stop in it is lost; measure again if a target is missing",
          n.length_s, time_s, at_mm, to_mm(n.size_m));
    case NoticeKind::jump:
      return text(
          "the encoder jumped by %+.1f um at %.4f mm, %.3f s after the first scan: all positions "
          "from there on are shifted by that, their points have the flag jump; check the scale "
          "and its cable and measure again",
          size_um, at_mm, time_s);
  }
  return "";
}

const char* plural(NoticeKind kind) {
  switch (kind) {
    case NoticeKind::creep:
    case NoticeKind::crept:
      return "creeping stops";
    case NoticeKind::short_stop:
      return "short stops";
    case NoticeKind::hole:
      return "holes";
    case NoticeKind::jump:
      return "jumps of the encoder";
  }
  return "";
}

bool of_a_point(const DwellNotice& n, const std::vector<Point>& points) {
  const auto length_ns = static_cast<std::int64_t>(n.length_s * 1e9);
  return std::any_of(points.begin(), points.end(), [&](const Point& p) {
    return std::abs(p.position_m - n.position_m) < kSameStop_m &&
           p.begin_ns < n.time_ns + length_ns + kSameStop_ns && n.time_ns < p.end_ns + kSameStop_ns;
  });
}

bool is_turn(const DwellNotice& n, const std::vector<Point>& points) {
  if (points.empty()) return false;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const Point& a, const Point& b) { return a.position_m < b.position_m; });
  return n.position_m < low->position_m - kSameStop_m ||
         n.position_m > high->position_m + kSameStop_m;
}

bool worth_telling(const DwellNotice& n, const std::vector<Point>& points) {
  if (n.kind != NoticeKind::creep && n.kind != NoticeKind::short_stop) return true;
  return !of_a_point(n, points) && !is_turn(n, points);
}

}  // namespace

void append_summarised(std::vector<std::string>& to, const std::vector<std::string>& sentences,
                       const std::string& what) {
  const std::size_t told = std::min(sentences.size(), kSentences);
  to.insert(to.end(), sentences.begin(), sentences.begin() + static_cast<std::ptrdiff_t>(told));
  if (told < sentences.size())
    to.push_back("and " + std::to_string(sentences.size() - told) + " more " + what);
}

std::vector<std::string> describe(const std::vector<DwellNotice>& notices,
                                  const std::vector<Point>& points, std::int64_t start_ns,
                                  double needed_s) {
  std::vector<std::string> all;
  for (const NoticeKind kind : {NoticeKind::jump, NoticeKind::hole, NoticeKind::creep,
                                NoticeKind::crept, NoticeKind::short_stop}) {
    std::vector<std::string> of_kind;
    for (const DwellNotice& n : notices) {
      if (n.kind == kind && worth_telling(n, points))
        of_kind.push_back(sentence(n, ns_to_s(n.time_ns - start_ns), needed_s));
    }
    append_summarised(all, of_kind, plural(kind));
  }
  return all;
}

}  // namespace mdof::algo
