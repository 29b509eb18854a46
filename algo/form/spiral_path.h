// The path of a fast tool servo over a map: a spiral from outside to inside, with the round tool in
// contact with the surface, and with bridges over gaps outside the part. README.md has the
// equations. SI, rad. Points are calculated one by one, so the memory does not grow with the length
// of the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "algo/form/surface.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct SpiralRequest {
  double x_centre_m = 0, y_centre_m = 0;  // axis of the spindle, in the coordinates of the map
  double outer_radius_m = 0;
  double feed_m = 0;  // towards the centre, for each turn
  std::size_t points_per_turn = 720;
  double tool_radius_m = 0;       // 0: a pointed tool
  std::size_t extend_pixels = 3;  // extrapolation beyond the edge
};

enum class OnPart : std::uint8_t { bridged = 0, measured = 1, extended = 2 };

struct PathPoint {
  double rho_m = 0, z_m = 0;
  std::size_t index = 0;  // number of turns times points per turn
  OnPart on_part = OnPart::bridged;
};

struct SpiralCounts {
  std::size_t points = 0, measured = 0, extended = 0, bridged = 0;
  std::size_t too_sharp = 0;  // the surface is sharper than the tool, so the tool touches elsewhere
};

class SpiralPath {
 public:
  // Errors: no point of the spiral is on the part (it lies in holes, or the centre is elsewhere);
  // more than 10^10 points.
  static Result<SpiralPath> over(const SurfaceMap& map, const SpiralRequest& request);

  std::size_t points() const { return points_; }
  // Calls `take` for each point, from the outermost inwards; an error of `take` stops it.
  Result<SpiralCounts> each(const std::function<Status(const PathPoint&)>& take) const;

 private:
  struct Touch {
    double z_m = 0, along = 0;  // dz/ds in the direction of the path
    OnPart on_part = OnPart::bridged;
    bool is_too_sharp = false;
  };
  struct Gap;
  SpiralPath(const SurfaceMap& map, const SpiralRequest& request);
  double rho_m(std::size_t index) const;
  bool touch(std::size_t index, Touch& found) const;
  bool contact(double rho_m, double cos, double sin, Touch& found) const;
  bool at(double x_m, double y_m, SurfacePoint& point, OnPart& on_part) const;
  // Length of the path between two indices.
  double arc_m(std::ptrdiff_t from, std::ptrdiff_t to) const;
  // Searches the last contact before `first`, as if another turn preceded the first turn.
  void find_touch_before(std::size_t first, Gap& gap) const;

  SpiralRequest request_;
  Surface surface_;
  bool has_sharp_valleys_ = false;  // the surface is somewhere curved more than the tool
  int places_ = 0;                  // places over the tool's width, to search the highest
  std::size_t points_ = 0;
  std::vector<double> cos_, sin_;  // for the points of a turn
};

// The middle of the measured part.
struct MapMiddle {
  double x_m = 0, y_m = 0;
};
MapMiddle middle_of(const SurfaceMap& map);

// The measured pixel with the largest distance from the centre.
struct FarthestPixel {
  double radius_m = 0, x_m = 0, y_m = 0;
};
FarthestPixel farthest_pixel(const SurfaceMap& map, double x_centre_m, double y_centre_m);

// True: no pixel of the outermost rows and columns has a height, so the part may be larger than its
// map.
bool is_edge_missing(const SurfaceMap& map);

// Roughness that a round tool leaves between two turns: height and mean deviation of arcs of radius
// r at the distance feed: Rt = r - sqrt(r^2 - feed^2 / 4), Ra = 4 Rt / (9 sqrt 3).
struct FeedRoughness {
  double Rt_m = 0, Ra_m = 0;
};
FeedRoughness feed_roughness(double tool_radius_m, double feed_m);

}  // namespace mdof::algo
