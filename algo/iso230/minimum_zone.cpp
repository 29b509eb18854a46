#include "algo/iso230/minimum_zone.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

namespace mdof::algo {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Vertex {
  double x = 0, y = 0;
};

// Returns whether b is on or below the line from a to c.
bool is_below(const Vertex& a, const Vertex& b, const Vertex& c) {
  return (b.x - a.x) * (c.y - a.y) >= (b.y - a.y) * (c.x - a.x);
}

// The upper convex hull of (x, sign * y) from left to right: a concave function of x.
class Hull {
 public:
  Hull(std::span<const double> x, std::span<const double> y, double sign) {
    for (std::size_t i = 0; i < x.size(); ++i) add({x[i], sign * y[i]});
  }

  const std::vector<Vertex>& vertices() const { return vertices_; }
  // Moves to x, which must not decrease. The functions below use this x.
  void go_to(double x) {
    x_ = x;
    while (at_ + 1 < vertices_.size() && vertices_[at_ + 1].x <= x) ++at_;
  }
  double height() const {
    const Vertex& v = vertices_[at_];
    return v.x == x_ ? v.y : v.y + slope(at_) * (x_ - v.x);
  }
  double slope_left() const {
    if (vertices_[at_].x != x_) return slope(at_);
    return at_ > 0 ? slope(at_ - 1) : kInfinity;
  }
  double slope_right() const { return at_ + 1 < vertices_.size() ? slope(at_) : -kInfinity; }

 private:
  void add(const Vertex& v) {
    if (!vertices_.empty() && vertices_.back().x == v.x) {
      if (vertices_.back().y >= v.y) return;
      vertices_.pop_back();
    }
    while (vertices_.size() > 1 && is_below(vertices_[vertices_.size() - 2], vertices_.back(), v))
      vertices_.pop_back();
    vertices_.push_back(v);
  }
  double slope(std::size_t edge) const {
    const Vertex &a = vertices_[edge], &b = vertices_[edge + 1];
    return (b.y - a.y) / (b.x - a.x);
  }

  std::vector<Vertex> vertices_;
  std::size_t at_ = 0;  // the last vertex with x at most x_
  double x_ = 0;
};

std::vector<double> places_of(const Hull& above, const Hull& below) {
  const auto left = [](const Vertex& a, const Vertex& b) { return a.x < b.x; };
  std::vector<Vertex> both;
  std::merge(above.vertices().begin(), above.vertices().end(), below.vertices().begin(),
             below.vertices().end(), std::back_inserter(both), left);
  std::vector<double> x;
  for (const Vertex& v : both) x.push_back(v.x);
  return x;
}

// Returns the middle of the slopes for which two parallel lines touch both hulls at this x and do
// not cross a hull.
double middle_slope(const Hull& above, const Hull& below) {
  const double least = std::max(above.slope_right(), -below.slope_left());
  const double most = std::min(above.slope_left(), -below.slope_right());
  return least + (most - least) / 2;
}

}  // namespace

Line minimum_zone_line(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size() && can_fit(x) && std::is_sorted(x.begin(), x.end()));
  Hull above(x, y, 1), below(x, y, -1);
  Line line;
  double widest = -1;
  for (const double place : places_of(above, below)) {
    above.go_to(place);
    below.go_to(place);
    const double width = above.height() + below.height();
    if (!(width > widest)) continue;
    widest = width;
    line.slope = middle_slope(above, below);
    line.intercept = (above.height() - below.height()) / 2 - line.slope * place;
  }
  return line;
}

}  // namespace mdof::algo
