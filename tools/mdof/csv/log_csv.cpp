#include "tools/mdof/csv/log_csv.h"

#include <cmath>
#include <cstdio>

#include "schema/base/number/number.h"
#include "schema/units.h"

namespace mdof::tools {
namespace {

// The unit of a channel in a probe log: the position of the axis is in mm, other lengths are in µm.
Unit unit_in_log(const Channel& channel) {
  const bool length = channel.unit == Unit::um || channel.unit == Unit::metre;
  if (channel.id == kEncoderChannel && length) return Unit::mm;
  return channel.unit == Unit::metre ? Unit::um : channel.unit;
}

double in_unit_of_log(const Channel& channel, double raw) {
  const Unit to = unit_in_log(channel);
  if (to == channel.unit) return raw;
  const double raw_m = channel.unit == Unit::metre ? raw : from_um(raw);
  return to == Unit::mm ? to_mm(raw_m) : to_um(raw_m);
}

void append_seconds(std::string& out, std::int64_t time_ns) {
  char text[32];
  const std::uint64_t ns =
      time_ns < 0 ? 0 - static_cast<std::uint64_t>(time_ns) : static_cast<std::uint64_t>(time_ns);
  const auto per_s = static_cast<std::uint64_t>(kNsPerS);
  const int size = std::snprintf(text, sizeof text, "%s%llu.%09llu", time_ns < 0 ? "-" : "",
                                 static_cast<unsigned long long>(ns / per_s),
                                 static_cast<unsigned long long>(ns % per_s));
  out.append(text, static_cast<std::size_t>(size));
}

}  // namespace

std::string log_csv_head(const std::vector<std::string>& comments,
                         const std::vector<Channel>& channels) {
  std::string out;
  for (const auto& comment : comments) out += "# " + comment + "\n";
  out += "time_s";
  for (const Channel& channel : channels) {
    const std::string unit = suffix(unit_in_log(channel));
    out += "," + channel.id + (unit.empty() ? "" : "_" + unit);
  }
  return out + "\n";
}

void append_log_csv(std::string& out, const SampleBlock& block) {
  for (std::size_t scan = 0; scan < block.scans(); ++scan) {
    append_seconds(out, block.time_ns[scan]);
    for (std::size_t c = 0; c < block.channels.size(); ++c) {
      out += ',';
      const double x = block.value[c][scan];
      if (!std::isfinite(x) || block.quality_at(c, scan) == Quality::missing) continue;
      char digits[kDouble17Size];
      out.append(digits, write_double_17(digits, in_unit_of_log(block.channels[c], x)));
    }
    out += '\n';
  }
}

std::uint64_t marked_values(const SampleBlock& block) {
  std::uint64_t marked = 0;
  for (const auto& channel : block.quality)
    for (const Quality quality : channel) marked += !usable(quality) && quality != Quality::missing;
  return marked;
}

}  // namespace mdof::tools
