// Corrects the readings of the points of a run for the probe effects that the rig declares
// (schema/rig/effects/physics.h). The readings are corrected after they are averaged and before the
// point is solved. If the rig declares no effect, the points do not change.
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

// The largest change of a reading, and the probe of this reading.
struct LargestChange {
  double size_m = 0;
  std::string probe;
  void add(double change_m, const std::string& of_probe);
};

// The notice about the largest change. `what`: "tilt", "dielectric" or "linearity".
Notice change_notice(const char* what, bool corrected, const LargestChange& change);

// Thread-bound.
class PointCorrections {
 public:
  explicit PointCorrections(Rig rig);

  void push(const SampleBlock& raw);  // reads the ambient conditions from the block
  // Corrects the readings of these points (in the order of the rig). A reading that cannot be
  // corrected becomes NaN, and the point gets the flag "gap_closed:A" or "no_air".
  void apply(const algo::Solver& solver, std::vector<Point>& points) const;
  // Adds notices to a run whose points were corrected. The notices state the largest change, the
  // declared effects that were not corrected, and the points that could not be corrected. `before`:
  // the averaged points before the correction. `before` may include points that are not in the run.
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
  algo::WhichCorrections asked_, known_;  // asked_: corrections that the rig requests; known_:
                                          // corrections whose effects the rig declares
  std::optional<AirSeries> air_;
};

// Returns the beginning of a sentence that states why a point has no errors: "probe A no longer
// changes; ".
std::string cause_of(const Point& point);

}  // namespace mdof::daemon
