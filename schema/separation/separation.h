// The machine's error apart from the shape of the target that it was measured against, from several
// set-ups in which the target lay otherwise (algo/separation).
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"

namespace mdof {

// A surface of the target: side, whose height is along y of the axis' local frame, or top, along z.
enum class Surface { side, top };
inline const char* to_string(Surface surface) {
  return surface == Surface::side ? "side" : "top";
}

// Shapes that no reading of these set-ups can determine: they are taken out of the result by least
// squares, and nothing is put in their place.
struct UnseenShape {
  std::string name;  // "offset", "parabola", "period 10 mm", "4 more shapes symmetric about -30 mm"
  std::size_t dimensions = 1;  // a period has two: sine and cosine
};

// A series over places, as far as it is seen: the true one would be this if its unseen shapes were
// taken out of it by least squares over the same places.
struct SeenSeries {
  std::vector<double> place_m;  // ascending
  std::vector<double> seen_m;
  std::vector<double> u_m;      // standard uncertainty of what is seen; NaN: not known
  std::vector<double> freedom;  // effective degrees of freedom of u; NaN: u is not known
  std::vector<double> k;        // of U = k u, 95 % of Student's t; NaN: u is not known
  std::vector<UnseenShape> unseen;

  // No more than offset and slope are missing, which are how the target was clamped.
  bool whole() const {
    for (const UnseenShape& shape : unseen)
      if (shape.name != "offset" && shape.name != "slope") return false;
    return true;
  }
  double U_m(std::size_t i) const { return k[i] * u_m[i]; }
  double zone_m() const;  // peak to valley; NaN without places
};

struct Separation {
  SeenSeries machine;  // error of the moving body over the encoder's position
  SeenSeries target;   // height over the place on the target, in C as it lay in the first set-up
  std::size_t set_ups = 0, readings = 0, unknowns = 0, rank = 0;
  std::size_t freedom() const { return readings - rank; }
  // Root mean square of what the fit leaves, by its freedom; NaN: nothing is left to test.
  double residual_m = std::numeric_limits<double>::quiet_NaN();
  std::string u_reason;     // where u comes from, or why there is none
  bool noise_only = false;  // u has noise and repeatability of runs, and nothing that is declared
  Notices notices;
};

// What it was made of, so that the profile can be used later by those who were not there.
struct SeparationSource {
  std::string name;    // "run 3", "a.csv"
  std::string sha256;  // of the run's stored result, of the file's bytes
  double height_sign = 1;
  bool end_for_end = false;
  double shift_m = 0;
};

struct SeparationRecord {
  std::string method;  // "reversal", "shift"
  Surface surface = Surface::side;
  Axis axis = Axis::x;    // that moves
  Axis normal = Axis::y;  // heights count along its +
  Sides sides;
  std::string error;  // "EYX"
  std::string probe;  // whose own readings they are; empty: the error itself
  std::vector<SeparationSource> sources;
  bool simulated = false;
  std::string created_utc;
  Separation result;
  bool doubtful = false;           // by its runs, or by itself
  std::vector<std::string> marks;  // what a file of it says first: SIMULATED, DOUBTFUL
};

}  // namespace mdof
