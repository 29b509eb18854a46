// The bytes of StudyStatistics, little-endian:
//   "MDOFSTAT" u32 version; u64 outputs, bins, trials; outputs x {f64 low, width};
//   then for each bin and output: u64 n, unsolved; f64 min, max; u8 lost powers (bit k); 2 x i128
//   power sums; the core as {varint empty bins, varint count}, ended by a count of 0; varint tails,
//   each {i32 key, varint count}.
#include <cmath>

#include "algo/sensitivity/statistics/statistics_parts.h"
#include "schema/base/bytes.h"

namespace mdof::algo {
namespace {

constexpr std::string_view kMagic = "MDOFSTAT";
constexpr std::uint32_t kVersion = 1;

void put_histogram(std::string& to, const OutputHistogram& h) {
  std::uint64_t empty = 0;
  for (std::size_t i = 0; i < kCoreBins; ++i) {
    if (h.core(i) == 0) {
      ++empty;
      continue;
    }
    put_varint(to, empty);
    put_varint(to, h.core(i));
    empty = 0;
  }
  put_varint(to, 0);
  put_varint(to, 0);
  put_varint(to, h.tails().size());
  for (const auto& [key, n] : h.tails()) {
    put_number(to, key);
    put_varint(to, n);
  }
}

void put_accumulator(std::string& to, const Accumulator& a) {
  put_number(to, a.n);
  put_number(to, a.unsolved);
  put_number(to, a.min);
  put_number(to, a.max);
  std::uint8_t lost = 0;
  for (unsigned k = 0; k < 2; ++k) lost = static_cast<std::uint8_t>(lost | (a.powers.lost[k] << k));
  put_number(to, lost);
  for (const Int128& sum : a.powers.sum) put_number(to, sum);
  put_histogram(to, a.histogram);
}

// Reads a histogram; returns false if its counts cannot be those of n trials.
bool read_histogram(ByteReader& in, std::uint64_t n, OutputHistogram& h) {
  std::uint64_t left = n, bin = 0;
  const auto take = [&](std::uint64_t count) {
    if (count > left) return false;
    left -= count;
    return true;
  };
  for (;;) {
    const std::uint64_t empty = in.varint(), count = in.varint();
    if (count == 0) {
      if (empty != 0) return false;
      break;
    }
    if (empty >= kCoreBins - bin || !take(count)) return false;
    bin += empty;
    h.add_core(bin, count);
    ++bin;
  }
  std::int32_t last = -OutputHistogram::kLastTail - 1;
  for (std::uint64_t tails = in.varint(); tails > 0; --tails) {
    const auto key = in.number<std::int32_t>();
    const std::uint64_t count = in.varint();
    if (key <= last || key == 0 || key > OutputHistogram::kLastTail || count == 0 || !take(count)) {
      return false;
    }
    h.add_tail(key, count);
    last = key;
  }
  return in.ok() && left == 0;
}

bool read_accumulator(ByteReader& in, Accumulator& a) {
  a.n = in.number<std::uint64_t>();
  a.unsolved = in.number<std::uint64_t>();
  a.min = in.number<double>();
  a.max = in.number<double>();
  const auto lost = in.number<std::uint8_t>();
  for (std::size_t k = 0; k < 2; ++k) {
    a.powers.lost[k] = (lost >> k & 1) != 0;
    a.powers.sum[k] = in.number<Int128>();
  }
  const bool extremes =
      a.n == 0 || (std::isfinite(a.min) && std::isfinite(a.max) && a.min <= a.max);
  return in.ok() && lost < 4 && extremes && read_histogram(in, a.n, a.histogram);
}

bool read_scale(ByteReader& in, StudyScale& scale) {
  for (OutputScale& s : scale) {
    s.low = in.number<double>();
    s.width = in.number<double>();
    if (!std::isfinite(s.low) || !(s.width > 0) || !std::isfinite(s.high())) return false;
  }
  return in.ok();
}

}  // namespace

std::string StudyStatistics::serialise() const {
  std::string bytes(kMagic);
  put_number(bytes, kVersion);
  put_number(bytes, std::uint64_t{parts_->outputs.size()});
  put_number(bytes, std::uint64_t{parts_->binned.bins});
  put_number(bytes, parts_->trials);
  for (const OutputScale& s : parts_->scale) {
    put_number(bytes, s.low);
    put_number(bytes, s.width);
  }
  for (const Accumulator& a : parts_->sums) put_accumulator(bytes, a);
  return bytes;
}

Result<StudyStatistics> StudyStatistics::parse(std::string_view bytes, const Experiment& shape,
                                               InstructionSet set) {
  const std::string what = "statistics of a study: ";
  if (!bytes.starts_with(kMagic)) return bad_input(what + "the data do not begin with MDOFSTAT");
  ByteReader in(bytes.substr(kMagic.size()));
  if (const auto version = in.number<std::uint32_t>(); version != kVersion) {
    return bad_input(what + "the data have version " + std::to_string(version) +
                     ", but this program reads version " + std::to_string(kVersion) +
                     "; continue the study with the program that wrote these data");
  }
  const auto outputs = in.number<std::uint64_t>(), bins = in.number<std::uint64_t>();
  StudyStatistics s(shape, StudyScale(shape.outputs().size()), set);
  if (outputs != s.parts_->outputs.size() || bins != s.parts_->binned.bins) {
    return bad_input(what + "the data contain " + std::to_string(outputs) + " outputs in " +
                     std::to_string(bins) + " bins, but the study has " +
                     std::to_string(s.parts_->outputs.size()) + " outputs in " +
                     std::to_string(s.parts_->binned.bins) + " bins");
  }
  s.parts_->trials = in.number<std::uint64_t>();
  bool good = read_scale(in, s.parts_->scale);
  std::vector<std::uint64_t> seen(outputs);
  std::size_t output = 0;
  for (Accumulator& a : s.parts_->sums) {
    good = good && read_accumulator(in, a);
    seen[output] += a.n + a.unsolved;
    output = output + 1 < outputs ? output + 1 : 0;
  }
  for (const std::uint64_t n : seen) good = good && n == s.parts_->trials;
  if (!good || !in.at_end()) {
    return bad_input(what +
                     "the data are damaged: counts, lengths or ranges contradict each other");
  }
  return s;
}

}  // namespace mdof::algo
