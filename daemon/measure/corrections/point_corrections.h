// What a rig says of its probes' physics (schema/rig/effects/physics.h), applied to the points of a
// run: after they were averaged, before they are solved. A rig that says nothing leaves all as it
// is.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "algo/probe_physics/reading_correction.h"
#include "daemon/measure/corrections/air_series.h"
#include "schema/point.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// The largest change of a reading, and of which probe.
struct LargestChange {
  double size_m = 0;
  std::string probe;
  void add(double change_m, const std::string& of_probe);
};

// `what`: "tilt", "dielectric", "linearity".
Notice change_notice(const char* what, bool corrected, const LargestChange& change);

// Thread-bound.
class PointCorrections {
 public:
  explicit PointCorrections(Rig rig);

  void push(const SampleBlock& raw);  // for the air in it
  // Readings of these points, in the order of the rig. One that cannot be corrected becomes NaN,
  // and the point is flagged "gap_closed:A" or "no_air".
  void apply(const algo::Solver& solver, std::vector<Point>& points) const;
  // Of a run whose points were corrected: by how much at most, what is left in though it is
  // known, and points that could not be corrected. `before`: these points and
  // others as they were averaged.
  void report(const algo::Solver& solver, const std::vector<Point>& before, Run& run) const;

 private:
  struct Changes {
    LargestChange tilt, dielectric;
  };
  void correct(const algo::ReadingCorrection& correction, Point& point) const;
  std::optional<Air> air_at(const Point& point) const;
  Changes changes(const algo::Solver& solver, algo::WhichCorrections which,
                  const std::vector<const Point*>& points) const;
  LargestChange linearity(const std::vector<const Point*>& points) const;
  void report_air(Run& run) const;
  void report_failures(Run& run) const;

  Rig rig_;
  algo::WhichCorrections asked_, known_;  // known_: could be made
  std::optional<AirSeries> air_;
};

// Why a point has no errors, before what follows from it: "probe A no longer changes: ".
std::string cause_of(const Point& point);

}  // namespace mdof::daemon
