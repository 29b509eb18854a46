#include "daemon/measure/stops.h"

#include <algorithm>
#include <utility>

#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/points/flags.h"
#include "daemon/measure/delays.h"
#include "daemon/measure/replay/replay.h"
#include "drivers/calibration.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr std::chrono::milliseconds kReadTimeout{1000};

Status check_log(ReplayLog& log, Axis axis, const Rig& rig) {
  Rig moved = rig;
  moved.axis = axis;
  if (!check_axis(log.path(), log.comments(), moved))
    return bad_input(log.path() + ": the log is not for axis " + std::string(1, letter(axis)) +
                     "; give a log of axis " + std::string(1, letter(axis)));
  return check_channels(log.path(), log.driver().info().channels, rig);
}

// Units of the probes. check_channels() has checked that the channels of all probes exist.
std::vector<Unit> units_of(const std::vector<Channel>& channels, const Rig& rig) {
  std::vector<Unit> units;
  for (const Probe& probe : rig.probes)
    for (const Channel& channel : channels)
      if (channel.id == probe.id) units.push_back(channel.unit);
  return units;
}

void leave_out(Point& stop, const Rig& rig) {
  for (std::size_t k = 0; k < rig.probes.size(); ++k)
    for (const Flag fault : {Flag::saturated, Flag::frozen, Flag::step})
      if (algo::has_flag(stop, fault, rig.probes[k].id)) stop.probe_m[k] = kNaN;
}

// Error: no stop is long enough, or small slow steps look like one stop that creeps.
Status check_stops(const std::string& path, const algo::DwellDetector& dwell,
                   const std::vector<Point>& stops) {
  const std::string larger_steps =
      "move the axis faster from one stop to the next, in steps of more than " +
      plain_number(to_um(dwell.summary().tolerance_m)) + " um";
  if (stops.empty())
    return bad_input(path + ": no stop found: " + dwell.why_no_stop() + "; " +
                     (dwell.crept() ? larger_steps : "let the axis stop longer at each position"));
  if (stops.size() == 1 && algo::has_flag(stops.front(), Flag::creep))
    return bad_input(
        path + ": the whole log is one stop, in which the axis crept by " +
        plain_number(to_um(dwell.summary().encoder_max_m - dwell.summary().encoder_min_m)) +
        " um; " + larger_steps);
  return {};
}

}  // namespace

Result<LogStops> read_stops(const std::string& path, Axis axis, const Rig& rig) {
  MDOF_TRY(ReplayLog log, ReplayLog::open(path));
  MDOF_CHECK(check_log(log, axis, rig));
  std::vector<std::string> ids;
  std::vector<double> ranges_m;
  for (const Probe& probe : rig.probes) {
    ids.push_back(probe.id);
    ranges_m.push_back(probe.range_m);
  }
  PipelineOptions options = with_delays({}, rig, {});
  options.dwell.settle_s = std::max(options.dwell.settle_s, options.dwell.leave_s);
  const drivers::Calibrator calibrator(rig);
  algo::Aligner aligner(options.align, ids);
  algo::DwellDetector dwell(options.dwell, ids, ranges_m);
  LogStops found;
  found.units = units_of(log.driver().info().channels, rig);
  FrameBlock frames;
  const auto take = [&] {
    dwell.push(frames, found.stops);
    frames.time_ns.clear();
  };
  SampleBlock block;
  for (auto state = drivers::ReadState::more; state != drivers::ReadState::end;) {
    MDOF_TRY(state, log.driver().read(block, kReadTimeout));
    if (block.scans() == 0) continue;
    if (auto done = calibrator.apply(block); !done) return in_context(path, done.error());
    if (auto done = aligner.push(block, frames); !done) return in_context(path, done.error());
    if (frames.size() > 0) take();
  }
  aligner.flush(frames);
  take();
  dwell.flush(found.stops);
  dwell.mark(found.stops);
  MDOF_CHECK(check_stops(path, dwell, found.stops));
  for (Point& stop : found.stops) leave_out(stop, rig);
  found.sha256 = log.sha256();
  found.started_utc = log.started_utc();
  found.notices = log.notices();
  append(found.notices, dwell.notices(found.stops));
  return found;
}

}  // namespace mdof::daemon
