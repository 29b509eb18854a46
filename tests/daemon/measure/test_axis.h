// A simulated axis that moves and stops as a test requires. An encoder and five probes measure it.
// It is a separate first-order model and shares no code with the tested code.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "daemon/measure/pipeline.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

inline Rig five_probe_rig(char axis = 'X') {
  return load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_" + axis + ".toml").value();
}

// The five errors of the target at travel d, in the frame of the axis.
struct TrueErrors {
  // dy, dz: displacement of the point of the target at the origin of frame C (carriage).
  double dy_um, dz_um, ex_urad, ey_urad, ez_urad;

  static TrueErrors at(double d_mm) {
    return {1 + 0.2 * d_mm, 0.5 - 0.1 * d_mm, 3 + d_mm, 2 - 0.5 * d_mm, -4 + 0.7 * d_mm};
  }
  // Errors of the point of the target at the origin of the fixture; m, rad.
  std::array<double, 5> at_fixture(double d_mm) const {
    return {1e-6 * (dy_um - 1e-3 * d_mm * ez_urad), 1e-6 * (dz_um + 1e-3 * d_mm * ey_urad),
            1e-6 * ex_urad, 1e-6 * ey_urad, 1e-6 * ez_urad};
  }
  // Readings of the probes A ... E in the default fixture.
  std::array<double, 5> readings_um(double d_mm) const {
    const auto top = [&](double x, double y) {
      return dz_um + 1e-3 * (ex_urad * y + ey_urad * (d_mm - x));
    };
    const auto side = [&](double x, double z) {
      return dy_um - 1e-3 * (ez_urad * (d_mm - x) + ex_urad * z);
    };
    return {top(10, 0), top(0, 10), top(0, -10), side(0, 20), side(10, 20)};
  }
};

// Thread-bound. Samples at 1 kHz.
class TestAxis {
 public:
  static constexpr std::int64_t kPeriod_ns = 1'000'000;
  static constexpr std::array<const char*, 5> kProbes = {"A", "B", "C", "D", "E"};

  // `travel`: travel of the target per unit of the encoder, 1 or -1.
  explicit TestAxis(double at_mm = -1, double travel = 1) : at_mm_(at_mm), travel_(travel) {}

  void move_to(double to_mm, double in_s = 0.1) {
    const double from_mm = at_mm_;
    const auto steps = static_cast<int>(in_s * 1e3);
    for (int i = 1; i <= steps; ++i) {
      at_mm_ = from_mm + (to_mm - from_mm) * i / steps;
      encoder_mm_.push_back(at_mm_);
    }
  }
  void stand(double s) { encoder_mm_.resize(encoder_mm_.size() + std::size_t(s * 1e3), at_mm_); }
  void stop_at(double mm, double s = 0.4) {
    move_to(mm);
    stand(s);
  }
  // Stops at each target on the way forward and on the way back. Reverses 1 mm beyond both ends.
  void pass_both_ways(std::vector<double> targets_mm) {
    for (const double mm : targets_mm) stop_at(mm);
    move_to(targets_mm.back() + 1);
    std::reverse(targets_mm.begin(), targets_mm.end());
    for (const double mm : targets_mm) stop_at(mm);
    move_to(targets_mm.back() - 1);
  }

  std::size_t scans() const { return encoder_mm_.size(); }
  static std::int64_t time_ns(std::size_t scan) {
    return static_cast<std::int64_t>(scan + 1) * kPeriod_ns;
  }
  double encoder_mm(std::size_t scan) const { return encoder_mm_[scan]; }

  // Scans begin ... end - 1 of the channels `ids`, as one block of the device `device`.
  SampleBlock block(std::size_t begin, std::size_t end, const std::vector<std::string>& ids,
                    const std::string& device = "daq") const {
    SampleBlock block;
    block.device = device;
    for (const auto& id : ids)
      block.channels.push_back({id, id == kEncoderChannel ? Unit::mm : Unit::um});
    block.value.resize(ids.size());
    for (std::size_t i = begin; i < std::min(end, scans()); ++i) {
      block.time_ns.push_back(time_ns(i));
      const double d_mm = travel_ * encoder_mm_[i];
      const auto probes = TrueErrors::at(d_mm).readings_um(d_mm);
      for (std::size_t c = 0; c < ids.size(); ++c) {
        const auto k = static_cast<std::size_t>(ids[c][0] - 'A');
        // Noise of the amplifier: 7 values from -3 nm to 3 nm, repeated.
        const double noise_um = 1e-3 * (static_cast<double>((i + 3 * k) % 7) - 3);
        block.value[c].push_back(ids[c] == kEncoderChannel ? encoder_mm_[i] : probes[k] + noise_um);
      }
    }
    return block;
  }
  SampleBlock block(std::size_t begin, std::size_t end) const {
    return block(begin, end, {kEncoderChannel, "A", "B", "C", "D", "E"});
  }
  SampleBlock whole() const { return block(0, scans()); }

 private:
  double at_mm_, travel_;
  std::vector<double> encoder_mm_;
};

inline void expect_true_errors(const MeasuredPoint& p, double d_mm) {
  ASSERT_TRUE(p.errors.valid) << p.errors.reason;
  const auto truth = TrueErrors::at(d_mm).at_fixture(d_mm);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(p.errors.local[k], truth[k], k < 2 ? 3e-10 : 5e-9) << d_mm << " mm, error " << k;
}

}  // namespace mdof::daemon
