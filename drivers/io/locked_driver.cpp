#include "drivers/io/locked_driver.h"

#include <optional>
#include <utility>

#include "drivers/io/device_lock.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::chrono::seconds kAnswerPeriod{1};

class LockedDriver final : public Driver {
 public:
  LockedDriver(std::unique_ptr<Driver> driver, std::string name,
               std::function<std::string()> identity, bool shared)
      : name_(std::move(name)),
        identity_(std::move(identity)),
        shared_(shared),
        driver_(std::move(driver)) {}

  DeviceInfo info() const override { return driver_->info(); }
  const DeviceClock* clock() const override { return driver_->clock(); }
  const Driver& device() const { return *driver_; }

  void trust_count() override { driver_->trust_count(); }
  int marks_passed() const override { return driver_->marks_passed(); }
  void trust_further_count(const std::string& channel) override {
    driver_->trust_further_count(channel);
  }

  Status open() override {
    if (!lock_) {
      auto taken = DeviceLock::take(identity_(), shared_);
      if (!taken) return in_context("device \"" + name_ + "\"", taken.error());
      lock_.emplace(std::move(*taken));
    }
    return driver_->open();
  }

  Result<ReadState> read(SampleBlock& block, milliseconds timeout) override {
    if (const auto now = steady_clock::now(); lock_ && now >= next_answer_) {
      next_answer_ = now + kAnswerPeriod;
      lock_->answer_inquiries();
    }
    return driver_->read(block, timeout);
  }

 private:
  const std::string name_;
  const std::function<std::string()> identity_;
  const bool shared_;
  // Destroyed after the driver, so that the device is already closed.
  std::optional<DeviceLock> lock_;
  std::unique_ptr<Driver> driver_;
  steady_clock::time_point next_answer_{};
};

}  // namespace

DriverSpec locked(DriverSpec spec) {
  if (!spec.identity) return spec;
  spec.make = [make = std::move(spec.make), name = spec.name, identity = spec.identity,
               shared = spec.shared]() -> Result<std::unique_ptr<Driver>> {
    MDOF_TRY(auto driver, make());
    return std::unique_ptr<Driver>(
        std::make_unique<LockedDriver>(std::move(driver), name, identity, shared));
  };
  spec.source_info = [source_info = std::move(spec.source_info)](const Driver& driver) {
    return source_info(static_cast<const LockedDriver&>(driver).device());
  };
  return spec;
}

}  // namespace mdof::drivers
