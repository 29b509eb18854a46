#include "daemon/station/device/shared_device.h"

#include <algorithm>
#include <utility>

namespace mdof::daemon {
namespace {

using Part = drivers::ChannelPart;

// The specification of the complete device. Its acquisition thread uses the channel ids of the
// device, also for the encoders.
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
      : device_(std::move(device)), axis_part_(std::make_shared<SharedDevice::AxisPart>()) {
    axis_part_->spec = std::move(spec);
    axis_part_->sink = std::move(sink);
  }
  ~DevicePart() override { device_->leave(axis_part_); }

  void start() override { device_->join(axis_part_); }
  void stop() override { device_->leave(axis_part_); }
  void request_stop() override { device_->request_stop(*axis_part_); }
  void trust_count() override {
    const std::string encoder = device_channel(axis_part_->spec.part, kEncoderChannel);
    if (!encoder.empty()) device_->acquisition_.trust_encoder_count(encoder);
  }
  void wake() override { device_->acquisition_.wake(); }
  std::uint64_t pass() const override { return device_->acquisition_.pass(); }
  const drivers::DriverSpec& spec() const override { return axis_part_->spec; }
  DeviceStatus status() const override { return device_->status_of(*axis_part_); }
  bool healthy(std::chrono::steady_clock::duration limit) const override {
    return device_->acquisition_.healthy(limit);
  }

 private:
  std::shared_ptr<SharedDevice> device_;
  std::shared_ptr<SharedDevice::AxisPart> axis_part_;
};

SharedDevice::SharedDevice(const drivers::DriverSpec& spec)
    : acquisition_(whole(spec), sink_for_all_axes()) {}

// ---- functions on the acquisition thread ----

DeviceSink SharedDevice::sink_for_all_axes() {
  DeviceSink sink;
  sink.samples = [this](SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds) {
    distribute_block(block, pass);
    return true;  // if the queue of an axis has no space, only this axis loses the block
  };
  sink.ended = [this](std::uint64_t pass, const std::string& why, const drivers::SourceInfo& info) {
    const std::lock_guard lock(mutex_);
    for (const auto& axis_part : axis_parts_) axis_part->sink.ended(pass, why, info);
  };
  sink.trouble = [this](const Trouble& trouble) {
    const std::lock_guard lock(mutex_);
    for (const auto& axis_part : axis_parts_) {
      const bool of_it = trouble.channel.empty() || axis_part->spec.part.contains(trouble.channel);
      if (of_it && axis_part->sink.trouble) axis_part->sink.trouble(trouble);
    }
  };
  sink.mark = [this](const std::string& device) {
    const std::lock_guard lock(mutex_);
    for (const auto& axis_part : axis_parts_)
      if (axis_part->spec.part.contains(kEncoderChannel) && axis_part->sink.mark)
        axis_part->sink.mark(device);
  };
  return sink;
}

void SharedDevice::distribute_block(const SampleBlock& block, std::uint64_t pass) {
  const std::lock_guard lock(mutex_);
  for (const auto& axis_part : axis_parts_) {
    SampleBlock& part = axis_part->block;
    take_part(block, axis_part->spec.part, part);
    part.lost += std::exchange(axis_part->dropped_scans, 0);
    if (axis_part->sink.samples(part, pass, std::chrono::milliseconds(0))) continue;
    axis_part->dropped_scans = part.lost + part.scans();
    axis_part->lost += part.scans();
    ++axis_part->dropped;
  }
}

// ---- functions on the main thread ----

void SharedDevice::join(const std::shared_ptr<AxisPart>& axis_part) {
  {
    const std::lock_guard lock(mutex_);
    axis_part->asked_to_stop = false;
    if (std::find(axis_parts_.begin(), axis_parts_.end(), axis_part) == axis_parts_.end())
      axis_parts_.push_back(axis_part);
    if (axis_parts_.size() > 1) return;
  }
  acquisition_.start();
}

// Releases the mutex before it joins the acquisition thread, because the thread can wait for the
// mutex.
void SharedDevice::leave(const std::shared_ptr<AxisPart>& axis_part) {
  {
    const std::lock_guard lock(mutex_);
    if (std::erase(axis_parts_, axis_part) == 0 || !axis_parts_.empty()) return;
  }
  acquisition_.stop();
}

void SharedDevice::request_stop(AxisPart& axis_part) {
  const std::lock_guard lock(mutex_);
  axis_part.asked_to_stop = true;
  if (std::all_of(axis_parts_.begin(), axis_parts_.end(),
                  [](const auto& t) { return t->asked_to_stop; }))
    acquisition_.request_stop();
}

DeviceStatus SharedDevice::status_of(const AxisPart& axis_part) const {
  DeviceStatus status = acquisition_.status();
  const Part& part = axis_part.spec.part;
  status.info.channels = drivers::channels_for_axis(std::move(status.info.channels), part);
  std::erase_if(status.standing, [&](const Trouble& trouble) {
    return !trouble.channel.empty() && !part.contains(trouble.channel);
  });
  const std::lock_guard lock(mutex_);
  status.lost += axis_part.lost;
  status.dropped += axis_part.dropped;
  return status;
}

std::unique_ptr<DeviceReader> SharedDevices::part(const drivers::DriverSpec& spec,
                                                  DeviceSink sink) {
  auto& known = devices_[spec.name];
  auto device = known.lock();
  if (!device) known = device = std::make_shared<SharedDevice>(spec);
  return std::make_unique<DevicePart>(std::move(device), spec, std::move(sink));
}

std::string shared_probes_device(const AxisConfig& a, const AxisConfig& b) {
  for (const auto& one : a.devices)
    for (const auto& other : b.devices)
      for (const auto& [channel, id] : one.part)
        if (one.name == other.name && other.part.contains(channel)) return one.name;
  return "";
}

}  // namespace mdof::daemon
