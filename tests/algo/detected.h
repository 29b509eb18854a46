// Runs the dwell detector on a log, which it receives in blocks of frames.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "algo/points/dwell.h"
#include "tests/algo/stepping_log.h"

namespace mdof::algo {

struct Detected {
  std::vector<Point> points;
  std::vector<DwellEvent> events;
  Notices notices;
  DwellDetector::Summary summary;
};

inline Detected detect(const SteppingLog& log, const FrameBlock& frames, std::size_t block = 1000,
                       const DwellOptions& options = {}) {
  DwellDetector detector(options, log.ids(), std::vector<double>(log.probes, 200e-6));
  Detected found;
  for (std::size_t i = 0; i < frames.size(); i += block)
    detector.push(cut_frames(frames, i, std::min(frames.size(), i + block)), found.points);
  detector.flush(found.points);
  detector.mark(found.points);
  found.events = detector.events();
  found.notices = detector.notices(found.points);
  found.summary = detector.summary();
  return found;
}

}  // namespace mdof::algo
