#include "drivers/simulator/simulator.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "drivers/scan_block.h"
#include "schema/base/number/number_text.h"

namespace mdof::drivers {
namespace {

constexpr std::size_t kBlockScans = 1024;  // largest number of scans in one read()
constexpr std::chrono::milliseconds kLongestWait{3'600'000};

std::string describe(const Rig& rig, const SimulatorOptions& options) {
  return std::string("simulated ") + letter(rig.axis) + " axis, " +
         std::to_string(rig.probes.size()) + " probes, seed " + std::to_string(options.seed);
}

}  // namespace

Result<std::unique_ptr<Simulator>> Simulator::make(std::string name, const Rig& rig,
                                                   SimulatorOptions options, ForwardModel model,
                                                   Clock clock) {
  if (auto fit = fit_to_rig(options, rig); !fit)
    return in_context("device \"" + name + "\"", fit.error());
  return std::unique_ptr<Simulator>(
      new Simulator(std::move(name), rig, std::move(options), std::move(model), std::move(clock)));
}

Simulator::Simulator(std::string name, const Rig& rig, SimulatorOptions options, ForwardModel model,
                     Clock clock)
    : name_(std::move(name)),
      description_(describe(rig, options)),
      options_(std::move(options)),
      machine_(rig, options_, std::move(model)),
      clock_(std::move(clock)),
      channels_(machine_.channels()) {
  assert(clock_.now_ns && clock_.sleep_for);
}

DeviceInfo Simulator::info() const {
  return {name_, "simulator", description_, channels_, options_.rate_hz, true, {}};
}

Status Simulator::open() {
  if (!start_ns_) start_ns_ = clock_.now_ns();
  if (!gone_) return {};
  const bool over = !options_.real_time || now() >= gone_->to_ns();
  if (!over)
    return io_error(
        "device \"" + name_ + "\": is disconnected until " + plain_number(gone_->to_s, 9) +
        " s after the start (to_s of [[disconnect]] in the configuration); wait until that time");
  const std::int64_t resume_ns =
      options_.real_time ? std::max(gone_->to_ns(), now()) : gone_->to_ns();
  const std::uint64_t resume = first_scan_at(resume_ns);
  lost_ += resume - next_;
  next_ = resume;
  gone_ = nullptr;
  return {};
}

Result<ReadState> Simulator::read(SampleBlock& block, std::chrono::milliseconds timeout) {
  start_block(block, name_, channels_);
  if (!start_ns_ || gone_)
    return io_error("device \"" + name_ + "\" is not open; call open() before read()");
  const std::int64_t due_ns =
      options_.real_time ? wait_for_packet(timeout) : std::numeric_limits<std::int64_t>::max();
  for (std::size_t n = 0; n < kBlockScans; ++n, ++next_) {
    const std::int64_t t_ns = time_of(next_);
    if (t_ns > due_ns) break;
    const Interval* gone = disconnect_at(t_ns);
    const bool gap = machine_.in_gap(t_ns);
    // A block ends before an interruption of the scans; the next read() begins at the interruption.
    if ((gone || gap || ended(t_ns)) && block.scans() > 0) break;
    if (ended(t_ns)) return ReadState::end;
    if (gone) {
      gone_ = gone;
      return io_error(
          "device \"" + name_ +
          "\": is disconnected by [[disconnect]] in the configuration; open the device again");
    }
    gap ? void(++lost_) : append(block, t_ns);
  }
  return ReadState::more;
}

std::int64_t Simulator::time_of(std::uint64_t scan) const {
  return std::llround(static_cast<double>(scan) * (1e9 / options_.rate_hz));
}

std::uint64_t Simulator::first_scan_at(std::int64_t t_ns) const {
  const double estimate = std::floor(static_cast<double>(t_ns) * (options_.rate_hz / 1e9)) - 1;
  auto scan = static_cast<std::uint64_t>(std::max(0.0, estimate));
  while (time_of(scan) < t_ns) ++scan;
  return scan;
}

std::int64_t Simulator::now() const {
  return clock_.now_ns() - *start_ns_;
}

// Sleeps until a packet is complete, or until the time-out. Returns the present time.
std::int64_t Simulator::wait_for_packet(std::chrono::milliseconds timeout) const {
  const double scans = std::floor(options_.packet_ms * 1e-3 * options_.rate_hz);
  const auto packet = static_cast<std::uint64_t>(std::max(1.0, scans));
  const auto longest_ns = std::chrono::nanoseconds(std::min(timeout, kLongestWait)).count();
  const std::int64_t wake_ns = std::min(time_of(next_ + packet - 1), now() + longest_ns);
  std::int64_t now_ns = now();
  for (; now_ns < wake_ns; now_ns = now()) clock_.sleep_for(wake_ns - now_ns);
  return now_ns;
}

bool Simulator::ended(std::int64_t t_ns) const {
  return !options_.loop && t_ns / machine_.motion().cycle_ns() >= options_.repeats;
}

const Interval* Simulator::disconnect_at(std::int64_t t_ns) const {
  for (const Interval& gone : options_.disconnects)
    if (gone.holds(t_ns)) return &gone;
  return nullptr;
}

void Simulator::append(SampleBlock& block, std::int64_t t_ns) {
  block.time_ns.push_back(*start_ns_ + t_ns);
  machine_.append_scan(block, next_, t_ns);
  block.lost += std::exchange(lost_, 0);
}

}  // namespace mdof::drivers
