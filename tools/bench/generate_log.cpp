// Writes CSV files for benchmarks. Equal arguments make equal bytes.
//   generate_log log    [ROWS [SEED]] > log.csv      1,500,000 rows are about 100 MB
//   generate_log frames [ROWS [SEED]] > frames.csv     900,000 rows are about 100 MB
// log: an axis moves repeatedly over 60 mm in both directions and stops for 0.5 s at targets every
// 6 mm. The file contains the readings of the default fixture at 4 kHz, with 10 nm of noise and 6
// decimals. It has no comment lines, so that any CSV reader reads it without options.
// frames: readings at random positions for random errors, without noise, with 17 digits.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <string>

#include "schema/base/number/number.h"

namespace {

constexpr double kRate_hz = 4000, kDwell_s = 0.5, kMove_s = 0.25;
constexpr double kPitch_mm = 6, kOvertravel_mm = 1;
constexpr int kTargets = 11;
constexpr double kNoise_um = 0.010, kEncoderNoise_mm = 2e-6;

struct Errors {
  double dy_um = 0, dz_um = 0, ex_urad = 0, ey_urad = 0, ez_urad = 0;
};

// The readings A ... E in µm, to first order. The top probes are at (x, y), the side probes at (x,
// z), in mm.
std::array<double, 5> readings_um(const Errors& e, double d_mm) {
  auto top = [&](double x, double y) {
    return e.dz_um + 1e-3 * (e.ex_urad * y + e.ey_urad * (d_mm - x));
  };
  auto side = [&](double x, double z) {
    return e.dy_um - 1e-3 * (e.ez_urad * (d_mm - x) + e.ex_urad * z);
  };
  return {top(10, 0), top(0, 10), top(0, -10), side(0, 20), side(10, 20)};
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  // A random number with approximately normal distribution and standard deviation 1. It is the same
  // on every system.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform(0, 1);
    return sum;
  }

 private:
  std::mt19937_64 engine_;
};

// The position of the axis at a time: stop, smooth motion, stop ... Beyond the first and the last
// target the axis reverses without a stop, so that each target has a defined approach.
double position_mm(double time_s) {
  // A cycle has the targets upwards, a reversal, the targets downwards, and a reversal.
  constexpr int kStops = 2 * kTargets + 2;
  auto stop_mm = [](int i) {
    const int k = i % kStops;
    if (k == 0) return -kOvertravel_mm;
    if (k <= kTargets) return (k - 1) * kPitch_mm;
    if (k == kTargets + 1) return (kTargets - 1) * kPitch_mm + kOvertravel_mm;
    return (kStops - 1 - k) * kPitch_mm;
  };
  constexpr double kStep_s = kDwell_s + kMove_s;
  constexpr double kCycle_s = 2 * kTargets * kStep_s + 2 * kMove_s;
  double t_s = std::fmod(time_s, kCycle_s);
  int stop = 0;
  for (;; ++stop) {  // for each stop: the motion to the next stop, then the time there
    const bool turn = (stop + 1) % kStops == 0 || (stop + 1) % kStops == kTargets + 1;
    const double length_s = kMove_s + (turn ? 0 : kDwell_s);
    if (t_s < length_s || stop == kStops - 1) break;
    t_s -= length_s;
  }
  const double u = std::fmin(t_s / kMove_s, 1);
  const double part = u * u * u * (10 + u * (-15 + 6 * u));
  return stop_mm(stop) + part * (stop_mm(stop + 1) - stop_mm(stop));
}

Errors errors_at(double d_mm) {
  const double w = 2 * std::numbers::pi * d_mm / 60;
  return {2.0 * std::sin(w) + 0.02 * d_mm, 1.5 * std::cos(2 * w) - 0.01 * d_mm,
          15 * std::sin(w + 1), 20 * std::cos(w) + 0.2 * d_mm, -12 * std::sin(2 * w)};
}

Errors random_errors(Random& random) {
  return {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-1000, 1000),
          random.uniform(-1000, 1000), random.uniform(-1000, 1000)};
}

// Buffers lines for the standard output.
class Output {
 public:
  void text(const char* s) { end_ = std::copy(s, s + std::strlen(s), end_); }
  void fixed_6(double x, char after) {
    const long long micro = std::llround(x * 1e6);
    if (micro < 0) *end_++ = '-';
    end_ = std::to_chars(end_, end_ + 20, std::llabs(micro) / 1'000'000).ptr;
    *end_++ = '.';
    for (long long rest = std::llabs(micro) % 1'000'000, unit = 100'000; unit > 0; unit /= 10)
      *end_++ = static_cast<char>('0' + rest / unit % 10);
    *end_++ = after;
  }
  void full(double x, char after) {
    end_ = mdof::write_double_17(end_, x);
    *end_++ = after;
  }
  void flush() {
    const std::size_t size = static_cast<std::size_t>(end_ - buffer_.data());
    if (std::fwrite(buffer_.data(), 1, size, stdout) != size) {
      std::perror("generate_log");
      std::exit(4);
    }
    end_ = buffer_.data();
  }
  bool nearly_full() const { return end_ - buffer_.data() > 60'000; }

 private:
  std::array<char, 65'536> buffer_;
  char* end_ = buffer_.data();
};

void write_log(long rows, Random& random, Output& out) {
  out.text("time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n");
  for (long row = 0; row < rows; ++row) {
    const double time_s = static_cast<double>(row) / kRate_hz;
    const double d_mm = position_mm(time_s);
    out.fixed_6(time_s, ',');
    out.fixed_6(d_mm + kEncoderNoise_mm * random.normal(), ',');
    const auto values = readings_um(errors_at(d_mm), d_mm);
    for (std::size_t k = 0; k < values.size(); ++k)
      out.fixed_6(values[k] + kNoise_um * random.normal(), k + 1 < values.size() ? ',' : '\n');
    if (out.nearly_full()) out.flush();
  }
  out.flush();
}

void write_frames(long rows, Random& random, Output& out) {
  out.text("encoder_mm,A_um,B_um,C_um,D_um,E_um\n");
  for (long row = 0; row < rows; ++row) {
    const double d_mm = random.uniform(0, 60);
    out.full(d_mm, ',');
    const auto values = readings_um(random_errors(random), d_mm);
    for (std::size_t k = 0; k < values.size(); ++k)
      out.full(values[k], k + 1 < values.size() ? ',' : '\n');
    if (out.nearly_full()) out.flush();
  }
  out.flush();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  if (kind != "log" && kind != "frames") {
    std::fprintf(stderr, "usage: generate_log log|frames [ROWS [SEED]] > FILE.csv\n");
    return 2;
  }
  const long rows = argc > 2 ? std::atol(argv[2]) : kind == "log" ? 1'500'000 : 900'000;
  Random random(argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
  Output out;
  kind == "log" ? write_log(rows, random, out) : write_frames(rows, random, out);
  return 0;
}
