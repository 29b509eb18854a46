// Separates the error of the machine from the shape of the target. It needs several set-ups with
// different positions of the target (algo/separation).
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "schema/axis.h"
#include "schema/notice/notice.h"

namespace mdof {

// Surface of the target. In the local frame of the axis, heights are along y for `side` and along z
// for `top`.
enum class Surface { side, top };
inline const char* to_string(Surface surface) {
  return surface == Surface::side ? "side" : "top";
}

// A shape that the readings of these set-ups cannot determine. Such shapes are removed from the
// result by least squares.
struct UndeterminedShape {
  std::string name;  // "offset", "parabola", "period 10 mm", "4 more shapes symmetric about -30 mm"
  std::size_t dimensions = 1;  // number of dimensions; a period has two: sine and cosine
};

// A series of heights or errors over positions. The readings determine the series only in part: it
// is the true series minus the shapes that the readings cannot determine. These shapes are fitted
// to the true series by least squares.
struct DeterminedSeries {
  std::vector<double> place_m;  // positions, ascending
  std::vector<double> seen_m;
  std::vector<double> u_m;      // standard uncertainty of seen_m; NaN: unknown
  std::vector<double> freedom;  // effective degrees of freedom of u; NaN: u is unknown
  std::vector<double> k;        // coverage factor of U = k u, 95 %, Student's t; NaN: u is unknown
  std::vector<UndeterminedShape> unseen;

  // True if only offset and slope can be undetermined; both depend on the clamping of the target.
  bool whole() const {
    for (const UndeterminedShape& shape : unseen)
      if (shape.name != "offset" && shape.name != "slope") return false;
    return true;
  }
  double U_m(std::size_t i) const { return k[i] * u_m[i]; }
  double zone_m() const;  // peak to valley; NaN if there are no positions
};

struct Separation {
  DeterminedSeries machine;  // error of the moving body over the position of the encoder
  // Height over the position on the target, in frame C with the orientation of the first set-up.
  DeterminedSeries target;
  std::size_t set_ups = 0, readings = 0, unknowns = 0, rank = 0;
  std::size_t freedom() const { return readings - rank; }
  // Standard deviation of the residuals: square root of (sum of the squared residuals / degrees of
  // freedom of the fit). NaN: there are no degrees of freedom.
  double residual_m = std::numeric_limits<double>::quiet_NaN();
  std::string u_reason;  // how u was found, or why u is unknown
  // True: u contains only noise and repeatability of the runs, because no uncertainty is declared.
  bool noise_only = false;
  Notices notices;
};

// A run or file from which the separation was calculated, with the orientation and the shift of the
// target in this set-up.
struct SeparationSource {
  std::string name;    // "run 3", "a.csv"
  std::string sha256;  // SHA-256 of the stored result of the run, or of the bytes of the file
  double height_sign = 1;
  bool end_for_end = false;
  double shift_m = 0;
};

struct SeparationRecord {
  std::string method;  // "reversal", "shift"
  Surface surface = Surface::side;
  Axis axis = Axis::x;    // the moving axis
  Axis normal = Axis::y;  // heights are positive in the + direction of this axis
  Sides sides;
  std::string error;  // "EYX"
  std::string probe;  // the probe whose readings were used; empty: the values are the error itself
  std::vector<SeparationSource> sources;
  bool simulated = false;
  std::string created_utc;
  Separation result;
  bool doubtful = false;           // true: its runs or its own notices are doubtful
  std::vector<std::string> marks;  // first words of an exported file: SIMULATED, DOUBTFUL
};

}  // namespace mdof
