#include "tools/mdof/stored/raw_stop.h"

#include <algorithm>
#include <map>
#include <string>

#include "daemon/measure/replay/replay.h"

namespace mdof::tools {
namespace {

constexpr std::int64_t kLeastAround_ns = 200'000'000;

class Window {
 public:
  Window(std::int64_t begin_ns, std::int64_t end_ns) : begin_ns_(begin_ns), end_ns_(end_ns) {}

  void take(const SampleBlock& block) {
    for (std::size_t scan = 0; scan < block.scans(); ++scan) {
      if (block.time_ns[scan] < begin_ns_ || block.time_ns[scan] > end_ns_) continue;
      for (std::size_t c = 0; c < block.channels.size(); ++c) {
        charts::RawSeries& series = of(block, c);
        series.time_ns.push_back(block.time_ns[scan]);
        series.value.push_back(block.value[c][scan]);
        series.quality.push_back(block.quality_at(c, scan));
      }
    }
  }
  std::vector<charts::RawSeries> found() { return std::move(found_); }

 private:
  charts::RawSeries& of(const SampleBlock& block, std::size_t channel) {
    const auto [at, is_new] =
        at_.emplace(block.device + "\n" + block.channels[channel].id, found_.size());
    if (is_new) found_.push_back({block.channels[channel], {}, {}, {}});
    return found_[at->second];
  }

  std::int64_t begin_ns_, end_ns_;
  std::vector<charts::RawSeries> found_;
  std::map<std::string, std::size_t> at_;
};

}  // namespace

Result<std::vector<charts::RawSeries>> raw_stop(const Run& run, std::size_t row) {
  const std::string name = "run " + std::to_string(run.header.id);
  if (row >= run.points.size())
    return fail(ErrorCode::usage, name + " has no point " + std::to_string(row) + "; the run has " +
                                      std::to_string(run.points.size()) +
                                      " points, numbered from 0 in the order of measurement");
  const Point& point = run.points[row].point;
  const std::int64_t around = std::max(kLeastAround_ns, (point.end_ns - point.begin_ns) / 2);
  Window window(point.begin_ns - around, point.end_ns + around);
  const std::string& path = run.header.provenance.recording_path;
  auto log = daemon::ReplayLog::open(path);
  if (!log) return in_context(name + ": recording of the raw readings", log.error());
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const auto state, log->driver().read(block, {}));
    window.take(block);
    if (state == drivers::ReadState::end) break;
  }
  if (log->sha256() != run.header.provenance.recording_sha256)
    return bad_input(path + ": this file is not the recording of " + name +
                     " (the SHA-256 differs); restore the recording");
  auto found = window.found();
  if (found.empty())
    return bad_input(path + ": the recording has no scans at the time of point " +
                     std::to_string(row) + " of " + name);
  return found;
}

}  // namespace mdof::tools
