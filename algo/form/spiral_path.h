// The path of a fast tool servo over a map: a spiral from outside to inside. The round tool touches
// the surface. Where the surface has no heights, the path is a bridge between the heights before
// and after. README.md has the equations. SI, rad. The points are calculated one by one and are not
// stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "algo/form/surface.h"
#include "algo/form/turn_spectrum.h"
#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof::algo {

struct SpiralRequest {
  double x_centre_m = 0, y_centre_m = 0;  // axis of the spindle, in the coordinates of the map
  double outer_radius_m = 0;
  double feed_m = 0;  // motion towards the centre in each turn
  std::size_t points_per_turn = 720;
  double tool_radius_m = 0;       // 0: a pointed tool
  std::size_t extend_pixels = 3;  // number of extrapolated pixels beyond the measured pixels
};

enum class OnPart : std::uint8_t { bridged = 0, measured = 1, extended = 2 };

struct PathPoint {
  double rho_m = 0, z_m = 0;
  std::size_t index = 0;  // number of points before this point
  OnPart on_part = OnPart::bridged;
};

struct SpiralCounts {
  std::size_t points = 0, measured = 0, extended = 0, bridged = 0;
  std::size_t too_sharp = 0;  // points where the surface is curved more than the tool
};

class SpiralPath {
 public:
  // Errors: no point of the spiral is on a pixel with a height; more than 10^10 points.
  static Result<SpiralPath> over(const SurfaceMap& map, const SpiralRequest& request);

  std::size_t points() const { return points_; }
  // Calls `take` for each point, from the outermost point inwards. Stops if `take` returns an
  // error, and returns this error.
  Result<SpiralCounts> each(const std::function<Status(const PathPoint&)>& take) const;
  // Receives the heights of this path. `band_harmonic`: as in TurnSpectrum.
  TurnSpectrum spectrum(double band_harmonic) const;
  // The highest harmonic of a turn whose amplitude is at least `share` times the largest amplitude
  // (TurnSpectrum::undulations()), evaluated on circles with two or more points for each pixel of
  // size `pixel_m`. 0: the tool does not move along Z, or each turn of the path already has so many
  // points. If the points of the path are too far apart, the path shows these undulations as longer
  // ones.
  std::size_t surface_undulations(double pixel_m, double share) const;

 private:
  struct Touch {
    double z_m = 0, along = 0;  // dz/ds in the direction of the path
    OnPart on_part = OnPart::bridged;
    bool is_too_sharp = false;
  };
  struct Gap;
  SpiralPath(const SurfaceMap& map, const SpiralRequest& request);
  void set_angles();
  // Heights of the tool at equally spaced angles of a circle about the centre.
  std::vector<double> circle(double radius_m, std::size_t points) const;
  double rho_m(std::size_t index) const;
  bool touch(std::size_t index, Touch& found) const;
  bool contact(double rho_m, double cos, double sin, Touch& found) const;
  bool at(double x_m, double y_m, SurfacePoint& point, OnPart& on_part) const;
  // Length of the path between two indices.
  double arc_m(std::ptrdiff_t from, std::ptrdiff_t to) const;
  // Sets the contact before a gap at the beginning of the path: the last contact of the first turn,
  // moved back by one turn. `first`: the first point with contact.
  void find_touch_before(std::size_t first, Gap& gap) const;

  SpiralRequest request_;
  // Copies of this path share the surface and its error.
  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<const InterpolationError> error_;
  bool has_sharp_valleys_ = false;  // the surface may be curved more than the tool somewhere
  int places_ = 0;  // number of places over the tool's width where a contact is searched
  std::size_t points_ = 0;
  std::vector<double> cos_, sin_;  // of the angle of each point of a turn
};

// The middle of the smallest rectangle that contains all measured pixels.
struct MapMiddle {
  double x_m = 0, y_m = 0;
};
MapMiddle middle_of(const SurfaceMap& map);
// The mean position of all measured pixels.
MapMiddle mean_pixel(const SurfaceMap& map);

// The measured pixel with the largest distance from the centre.
struct FarthestPixel {
  double radius_m = 0, x_m = 0, y_m = 0;
};
FarthestPixel farthest_pixel(const SurfaceMap& map, double x_centre_m, double y_centre_m);

// True: no pixel of the outermost rows and columns has a height.
bool is_edge_missing(const SurfaceMap& map);

// Roughness between two turns of the path of a round tool with radius r:
//   Rt = r - sqrt(r^2 - feed^2 / 4)   height of the ridge between two arcs
//   Ra = 4 Rt / (9 sqrt 3)            mean deviation
struct FeedRoughness {
  double Rt_m = 0, Ra_m = 0;
};
FeedRoughness feed_roughness(double tool_radius_m, double feed_m);

}  // namespace mdof::algo
