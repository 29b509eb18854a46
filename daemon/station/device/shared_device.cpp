#include "daemon/station/device/shared_device.h"

#include <algorithm>
#include <utility>

namespace mdof::daemon {
namespace {

using Part = drivers::ChannelPart;

// The specification of the complete device, whose acquisition thread uses the device's own names
// for all encoders.
drivers::DriverSpec whole(drivers::DriverSpec spec) {
  spec.part.clear();
  return spec;
}

std::string device_channel(const Part& part, const std::string& id) {
  for (const auto& [device, rig] : part)
    if (rig == id) return device;
  return "";
}

}  // namespace

void take_part(const SampleBlock& block, const Part& part, SampleBlock& taken) {
  taken.device = block.device;
  taken.time_ns = block.time_ns;
  taken.lost = block.lost;
  taken.channels.clear();
  taken.value.resize(part.size());
  taken.quality.resize(block.quality.empty() ? 0 : part.size());
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    const auto id = part.find(block.channels[c].id);
    if (id == part.end()) continue;
    const std::size_t to = taken.channels.size();
    taken.channels.push_back({id->second, block.channels[c].unit});
    taken.value[to] = block.value[c];
    if (!block.quality.empty()) taken.quality[to] = block.quality[c];
  }
  taken.value.resize(taken.channels.size());
  if (!block.quality.empty()) taken.quality.resize(taken.channels.size());
}

// The part of a device that one axis uses.
class DevicePart final : public DeviceReader {
 public:
  DevicePart(std::shared_ptr<SharedDevice> device, drivers::DriverSpec spec, DeviceSink sink)
      : device_(std::move(device)), taker_(std::make_shared<SharedDevice::Taker>()) {
    taker_->spec = std::move(spec);
    taker_->sink = std::move(sink);
  }
  ~DevicePart() override { device_->leave(taker_); }

  void start() override { device_->join(taker_); }
  void stop() override { device_->leave(taker_); }
  void request_stop() override { device_->request_stop(*taker_); }
  void trust_count() override {
    const std::string encoder = device_channel(taker_->spec.part, kEncoderChannel);
    if (!encoder.empty()) device_->acquisition_.trust_count_of(encoder);
  }
  void wake() override { device_->acquisition_.wake(); }
  std::uint64_t pass() const override { return device_->acquisition_.pass(); }
  const drivers::DriverSpec& spec() const override { return taker_->spec; }
  DeviceStatus status() const override { return device_->status_of(*taker_); }
  bool healthy(std::chrono::steady_clock::duration limit) const override {
    return device_->acquisition_.healthy(limit);
  }

 private:
  std::shared_ptr<SharedDevice> device_;
  std::shared_ptr<SharedDevice::Taker> taker_;
};

SharedDevice::SharedDevice(const drivers::DriverSpec& spec)
    : acquisition_(whole(spec), fan_out()) {}

// ---- acquiring thread ----

DeviceSink SharedDevice::fan_out() {
  DeviceSink sink;
  sink.samples = [this](SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds) {
    distribute_block(block, pass);
    return true;  // blocks without space in the queue of an axis are lost for this axis only
  };
  sink.ended = [this](std::uint64_t pass, const std::string& why, const drivers::SourceInfo& info) {
    const std::lock_guard lock(mutex_);
    for (const auto& taker : takers_) taker->sink.ended(pass, why, info);
  };
  sink.trouble = [this](const Trouble& trouble) {
    const std::lock_guard lock(mutex_);
    for (const auto& taker : takers_) {
      const bool of_it = trouble.channel.empty() || taker->spec.part.contains(trouble.channel);
      if (of_it && taker->sink.trouble) taker->sink.trouble(trouble);
    }
  };
  sink.mark = [this](const std::string& device) {
    const std::lock_guard lock(mutex_);
    for (const auto& taker : takers_)
      if (taker->spec.part.contains(kEncoderChannel) && taker->sink.mark) taker->sink.mark(device);
  };
  return sink;
}

void SharedDevice::distribute_block(const SampleBlock& block, std::uint64_t pass) {
  const std::lock_guard lock(mutex_);
  for (const auto& taker : takers_) {
    SampleBlock& part = taker->block;
    take_part(block, taker->spec.part, part);
    part.lost += std::exchange(taker->dropped_scans, 0);
    if (taker->sink.samples(part, pass, std::chrono::milliseconds(0))) continue;
    taker->dropped_scans = part.lost + part.scans();
    taker->lost += part.scans();
    ++taker->dropped;
  }
}

// ---- main thread ----

void SharedDevice::join(const std::shared_ptr<Taker>& taker) {
  {
    const std::lock_guard lock(mutex_);
    taker->ceased = false;
    if (std::find(takers_.begin(), takers_.end(), taker) == takers_.end()) takers_.push_back(taker);
    if (takers_.size() > 1) return;
  }
  acquisition_.start();
}

// The mutex is released before joining, because the thread may wait for it.
void SharedDevice::leave(const std::shared_ptr<Taker>& taker) {
  {
    const std::lock_guard lock(mutex_);
    if (std::erase(takers_, taker) == 0 || !takers_.empty()) return;
  }
  acquisition_.stop();
}

void SharedDevice::request_stop(Taker& taker) {
  const std::lock_guard lock(mutex_);
  taker.ceased = true;
  if (std::all_of(takers_.begin(), takers_.end(), [](const auto& t) { return t->ceased; }))
    acquisition_.request_stop();
}

DeviceStatus SharedDevice::status_of(const Taker& taker) const {
  DeviceStatus status = acquisition_.status();
  const Part& part = taker.spec.part;
  status.info.channels = drivers::channels_for_axis(std::move(status.info.channels), part);
  std::erase_if(status.standing, [&](const Trouble& trouble) {
    return !trouble.channel.empty() && !part.contains(trouble.channel);
  });
  const std::lock_guard lock(mutex_);
  status.lost += taker.lost;
  status.dropped += taker.dropped;
  return status;
}

std::unique_ptr<DeviceReader> SharedDevices::part(const drivers::DriverSpec& spec,
                                                  DeviceSink sink) {
  auto& known = devices_[spec.name];
  auto device = known.lock();
  if (!device) known = device = std::make_shared<SharedDevice>(spec);
  return std::make_unique<DevicePart>(std::move(device), spec, std::move(sink));
}

std::string same_probes(const AxisConfig& a, const AxisConfig& b) {
  for (const auto& one : a.devices)
    for (const auto& other : b.devices)
      for (const auto& [channel, id] : one.part)
        if (one.name == other.name && other.part.contains(channel)) return one.name;
  return "";
}

}  // namespace mdof::daemon
