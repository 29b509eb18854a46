#include "tools/mdof/checks/device_probe.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "daemon/words/error_text.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReadTimeout{100}, kShown{100};

// Mean, standard deviation and extremes of a channel, updated with each value (Welford's
// algorithm).
struct Running {
  Quality worst = Quality::good;
  double squares = 0;
  void add(ChannelFinding& c, double x, Quality quality) {
    worst = std::max(worst, quality);
    if (!usable(quality) || std::isnan(x)) {
      ++c.unusable;
      return;
    }
    if (c.values == 0) c.low = c.high = x;
    ++c.values;
    const double step = x - c.mean;
    c.mean += step / static_cast<double>(c.values);
    squares += step * (x - c.mean);
    c.low = std::min(c.low, x);
    c.high = std::max(c.high, x);
  }
};

// Times of the first and the last sample, from the device's clock.
struct Span {
  std::int64_t first_ns = 0, last_ns = 0;
};

void take(const SampleBlock& block, DeviceFinding& finding, std::vector<Running>& running,
          Span& span) {
  finding.channels.resize(std::max(finding.channels.size(), block.channels.size()));
  running.resize(finding.channels.size());
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    finding.channels[c].id = block.channels[c].id;
    finding.channels[c].unit = suffix(block.channels[c].unit);
    for (std::size_t i = 0; i < block.scans(); ++i)
      running[c].add(finding.channels[c], block.value[c][i], block.quality_at(c, i));
  }
  if (finding.scans == 0) span.first_ns = block.time_ns.front();
  span.last_ns = block.time_ns.back();
  finding.scans += block.scans();
  finding.lost += block.lost;
}

void finish(DeviceFinding& finding, const std::vector<Running>& running, const Span& span) {
  for (std::size_t c = 0; c < finding.channels.size(); ++c) {
    ChannelFinding& channel = finding.channels[c];
    if (channel.values > 1)
      channel.sd = std::sqrt(running[c].squares / static_cast<double>(channel.values - 1));
    channel.worst = to_string(running[c].worst);
  }
  const auto ns = static_cast<double>(span.last_ns - span.first_ns);
  if (finding.scans > 1 && ns > 0)
    finding.rate_hz = static_cast<double>(finding.scans - 1) * 1e9 / ns;
}

Status read_for(drivers::Driver& driver, double for_s, const StopRequested& stop,
                DeviceFinding& finding) {
  const auto until = steady_clock::now() + std::chrono::duration<double>(for_s);
  std::vector<Running> running;
  Span span;
  Status status;
  SampleBlock block;
  while (status && steady_clock::now() < until && !stop()) {
    const auto state = driver.read(block, kReadTimeout);
    if (!state) status = tl::unexpected(state.error());
    if (state && block.scans() > 0) take(block, finding, running, span);
    if (state && *state == drivers::ReadState::end) break;
  }
  finish(finding, running, span);
  if (status && finding.scans == 0) return io_error("the device was opened, but it sent no sample");
  return status;
}

Status open_and_read(const drivers::DriverSpec& device, double for_s, const StopRequested& stop,
                     DeviceFinding& finding) {
  MDOF_TRY(const auto driver, device.make());
  MDOF_CHECK(driver->open());
  Status read = read_for(*driver, for_s, stop, finding);
  const drivers::DeviceInfo info = driver->info();
  finding.description = info.description;
  if (info.rate_hz > 0) finding.stated_rate_hz = info.rate_hz;
  finding.clock = info.clock;
  return read;
}

std::string value_text(double x, const std::string& unit) {
  return fixed(x, unit == "V" ? 5 : 4);
}

}  // namespace

DeviceFinding probe_device(const drivers::DriverSpec& device, double for_s,
                           const StopRequested& stop) {
  DeviceFinding finding;
  finding.name = device.name;
  finding.driver = device.driver;
  if (const Status done = open_and_read(device, for_s, stop, finding); !done)
    finding.error = words::text(done.error());
  return finding;
}

std::string finding_text(const DeviceFinding& f) {
  std::string text =
      f.name + " (" + f.driver + ")" + (f.description.empty() ? "" : ": " + f.description) + "\n";
  if (!f.error.empty()) text += "  ERROR: " + f.error + "\n";
  if (f.scans == 0) return text + "\n";
  text += "  " + std::to_string(f.scans) + " scans, " + fixed(f.rate_hz, 2) +
          " per second (stated " +
          (std::isnan(f.stated_rate_hz) ? "none" : fixed(f.stated_rate_hz, 2)) + "), " +
          std::to_string(f.lost) + " lost\n";
  if (f.clock)
    text += "  clock " + std::string(f.clock->settled ? "" : "(not settled) ") + "drift " +
            fixed(f.clock->drift_ppm, 1) + " ppm, jitter " +
            fixed(static_cast<double>(f.clock->jitter_ns) * 1e-6, 3) + " ms, " +
            std::to_string(f.clock->steps) + " jumps\n";
  TextTable table(
      {"channel", "unit", "mean", "sd", "lowest", "highest", "unusable", "worst quality"});
  for (const auto& c : f.channels)
    table.add({c.id, c.unit, value_text(c.mean, c.unit), value_text(c.sd, c.unit),
               value_text(c.low, c.unit), value_text(c.high, c.unit), std::to_string(c.unusable),
               c.worst});
  return text + table.text() + "\n";
}

std::string finding_json(const DeviceFinding& f) {
  JsonWriter json;
  json.begin_object()
      .field("device", f.name)
      .field("driver", f.driver)
      .field("description", f.description)
      .field("stated_rate_hz", f.stated_rate_hz)
      .field("rate_hz", f.rate_hz)
      .field("scans", f.scans)
      .field("lost", f.lost);
  json.key("error");
  f.error.empty() ? json.null() : json.value(f.error);
  json.key("clock");
  if (f.clock) {
    json.begin_object()
        .field("drift_ppm", f.clock->drift_ppm)
        .field("jitter_ms", static_cast<double>(f.clock->jitter_ns) * 1e-6)
        .field("settled", f.clock->settled)
        .field("steps", f.clock->steps)
        .end_object();
  } else {
    json.null();
  }
  json.key("channels").begin_array();
  for (const auto& c : f.channels) {
    json.begin_object()
        .field("id", c.id)
        .field("unit", c.unit)
        .field("mean", c.mean)
        .field("sd", c.sd)
        .field("low", c.low)
        .field("high", c.high)
        .field("values", c.values)
        .field("unusable", c.unusable)
        .field("worst", c.worst)
        .end_object();
  }
  json.end_array().end_object();
  return json.take();
}

Status monitor_device(const drivers::DriverSpec& device, const StopRequested& stop) {
  MDOF_TRY(const auto driver, device.make());
  MDOF_CHECK(driver->open());
  auto next = steady_clock::now();
  SampleBlock block;
  while (!stop()) {
    MDOF_TRY(const auto state, driver->read(block, kReadTimeout));
    if (block.scans() > 0 && steady_clock::now() >= next) {
      next = steady_clock::now() + kShown;
      std::string line;
      for (std::size_t c = 0; c < block.channels.size(); ++c) {
        const Quality quality = block.quality_at(c, block.scans() - 1);
        line += (c > 0 ? "  " : "") + block.channels[c].id + " " +
                value_text(block.value[c].back(), suffix(block.channels[c].unit)) + " " +
                suffix(block.channels[c].unit) +
                (quality == Quality::good ? "" : std::string(" ") + to_string(quality));
      }
      MDOF_CHECK(write_line(line));
    }
    if (state == drivers::ReadState::end) return {};
  }
  return {};
}

}  // namespace mdof::tools
