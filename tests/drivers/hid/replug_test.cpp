// Unplugs and replugs a device many times while the acquisition of mdofd reads. In each round the
// test measures:
// - the time from the new node to the first sample
// - the resources that the process uses
#include <fcntl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "daemon/station/device/acquisition.h"
#include "drivers/io/hid.h"
#include "drivers/pokeys57u/pokeys57u.h"
#include "drivers/pokeys57u/simulated_pokeys57u.h"
#include "schema/base/random.h"
#include "tests/drivers/hid/hid_bus.h"

namespace mdof::drivers {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr int kWarmUp = 3;  // rounds after which all memory is allocated
constexpr double kMost_s = 1;
constexpr long kMostGrowth_KiB = 1024;

long resident_KiB() {
  std::ifstream file("/proc/self/statm");
  long all = 0, resident = 0;
  file >> all >> resident;
  return resident * (::sysconf(_SC_PAGESIZE) / 1024);
}
// Number of open descriptors. Descriptors that are open only briefly do not count. Sockets do not
// count either: the tested code uses none, and umockdev sometimes keeps the socket of a device
// that vanishes while it is being opened.
long descriptors() {
  long least = LONG_MAX;
  for (int i = 0; i < 10; ++i, std::this_thread::sleep_for(milliseconds(5))) {
    long count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      const auto is = std::filesystem::read_symlink(entry.path(), gone).string();
      count += is.starts_with("socket:") ? 0 : 1;
    }
    least = std::min(least, count);
  }
  return least;
}
// Memory that umockdev itself needs for each former device.
double own_growth_KiB(int rounds) {
  HidBus bus;
  long before = 0;
  for (int round = 0; round < kWarmUp + rounds; ++round) {
    if (round == kWarmUp) before = resident_KiB();
    pokeys57u::SimulatedPokeys57u device([](std::size_t, std::int64_t) { return 0.0; }, {});
    bus.plug(round, device);
    EXPECT_TRUE(HidDevice::open(HidBus::node_of(round)));
    bus.unplug(round);
  }
  return static_cast<double>(resident_KiB() - before) / rounds;
}

// Deliberate faults. With them, the test shows that its checks can fail.
struct Sabotage {
  bool leak = false;
  milliseconds late{0};  // delay of the node, which the measured time includes
};

struct Figures {
  int rounds = 0, reopened = 0;
  std::vector<double> seconds;  // time from the node to the first sample, for each round
  long descriptors = 0, growth_KiB = 0;
  double quantile_s(std::size_t percent) const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 1e9 : sorted[(sorted.size() * percent + 99) / 100 - 1];
  }
  bool all_reopened() const { return reopened == rounds; }
  bool quick() const { return quantile_s(99) <= kMost_s; }
  bool descriptors_constant() const { return descriptors == 0; }
  bool memory_constant() const { return growth_KiB <= kMostGrowth_KiB; }
};

class Scans {
 public:
  bool take(SampleBlock& block, std::uint64_t, milliseconds) {
    const std::lock_guard lock(mutex_);
    count_ += block.scans();
    more_.notify_all();
    return true;
  }
  bool wait_for_more(milliseconds limit) {
    std::unique_lock lock(mutex_);
    const std::uint64_t now = count_;
    return more_.wait_for(lock, limit, [&] { return count_ > now; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable more_;
  std::uint64_t count_ = 0;
};

DriverSpec reader() {
  pokeys57u::Settings settings;
  settings.name = "slide";
  settings.serial = 12345;
  settings.inputs.emplace_back();
  settings.inputs[0].channel = {"encoder", Unit::um};
  settings.inputs[0].um_per_count = 1;
  settings.inputs[0].most_counts_per_s = 1e6;
  DriverSpec spec;
  spec.driver = "pokeys57u";
  spec.name = "slide";
  spec.make = [settings]() -> Result<std::unique_ptr<Driver>> {
    return std::make_unique<pokeys57u::PoKeys57u>(settings);
  };
  spec.source_info = [](const Driver&) { return SourceInfo{}; };
  return spec;
}

// Time for which the device is unplugged: mostly up to 0.3 s, in every tenth round up to 1.5 s. So
// the new node appears at all phases of the pauses between two attempts to open the device.
milliseconds away(int round) {
  const Philox random = philox({static_cast<std::uint32_t>(round), 0, 0, 0}, 7);
  return milliseconds(30 +
                      std::lround((round % 10 == 9 ? 1500 : 300) * uniform(random[0], random[1])));
}

Figures replug(int rounds, const Sabotage& sabotage) {
  HidBus bus;
  Scans scans;
  daemon::Acquisition acquisition(
      reader(), {[&](auto& block, auto pass, auto wait) { return scans.take(block, pass, wait); },
                 [](auto, const auto&, const auto&) {},
                 {}});
  acquisition.start();
  Figures figures;
  figures.rounds = rounds;
  std::vector<std::string> kept;
  long descriptors_before = 0, resident_before = 0;
  for (int round = 0; round < kWarmUp + rounds; ++round) {
    pokeys57u::SimulatedPokeys57u device([](std::size_t, std::int64_t) { return 0.0; }, {});
    std::this_thread::sleep_for(away(round));
    const auto plugged = steady_clock::now();
    std::this_thread::sleep_for(sabotage.late);
    bus.plug(round, device);
    const bool back = scans.wait_for_more(milliseconds(10'000));
    const daemon::DeviceStatus status = acquisition.status();
    EXPECT_TRUE(back) << "round " << round << ": " << status.state << ": " << status.error;
    const double after_s = duration<double>(steady_clock::now() - plugged).count();
    if (round >= kWarmUp && back) {
      ++figures.reopened;
      figures.seconds.push_back(after_s);
    }
    if (round == kWarmUp - 1) {
      descriptors_before = descriptors();
      resident_before = resident_KiB();
    }
    figures.descriptors = descriptors() - descriptors_before;
    figures.growth_KiB = resident_KiB() - resident_before;
    bus.unplug(round);
    if (sabotage.leak) {
      EXPECT_GE(::open("/dev/null", O_RDONLY), 0);
      kept.emplace_back(1 << 20, 'x');
    }
  }
  acquisition.stop();
  return figures;
}

void print(const Figures& f) {
  std::printf(
      "replugged %d, reopened %d, first sample after p50 %.3f s, p99 %.3f s, descriptors %+ld, "
      "memory %+ld KiB\n",
      f.rounds, f.reopened, f.quantile_s(50), f.quantile_s(99), f.descriptors, f.growth_KiB);
}

TEST(HidReplug, ReopensSoonWithoutLosingResources) {
  const char* const rounds = std::getenv("MDOF_REPLUGS");
  const double own_KiB = own_growth_KiB(200);
  Figures figures = replug(rounds ? std::atoi(rounds) : 20, {});
  figures.growth_KiB -= std::lround(own_KiB * figures.rounds);
  print(figures);
  std::printf("umockdev's own %+.2f KiB a round are taken off\n", own_KiB);
  EXPECT_TRUE(figures.all_reopened());
  EXPECT_TRUE(figures.quick());
  EXPECT_TRUE(figures.descriptors_constant());
#ifndef MDOF_SANITIZED  // sanitizers keep freed memory for a while
  EXPECT_TRUE(figures.memory_constant());
#endif
}

// With deliberate faults, each check must fail.
TEST(HidReplug, DetectsLeaksAndDelays) {
  const Figures figures = replug(2, {.leak = true, .late = milliseconds(1100)});
  print(figures);
  EXPECT_FALSE(figures.quick());
  EXPECT_FALSE(figures.descriptors_constant());
  EXPECT_FALSE(figures.memory_constant());
}

}  // namespace
}  // namespace mdof::drivers
