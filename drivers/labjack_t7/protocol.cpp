#include "drivers/labjack_t7/protocol.h"

#include <algorithm>
#include <bit>

namespace mdof::drivers::labjack_t7 {
namespace {

// LabJack's error codes that concern streams and their configuration (ljm_constants.json).
struct CodeText {
  int code;
  const char* text;
};
constexpr CodeText kErrors[] = {
    {2605, "a stream is already active: end the other program that reads a stream of the T7"},
    {2606, "the stream's configuration is invalid"},
    {2607, "the scan list is invalid"},
    {2608, "the scan rate is invalid: lower rate_hz"},
    {2618, "the number of samples in a packet is invalid"},
    {2620, "no stream is running"},
    {2625, "an input of the scan list cannot be streamed"},
    {status::recovering, "the stream's buffer was full and is being emptied"},
    {status::recovered, "the stream continues after dropped scans"},
    {status::scan_overlap,
     "a scan began before the previous scan had ended: lower rate_hz, resolution_index or "
     "settling_us"},
    {status::recovery_overflow,
     "more scans were dropped than the device can count: check the network and the load of this "
     "computer, or lower rate_hz"},
    {status::burst_complete,
     "the device ended the stream after a burst, but no burst was requested"},
    {status::buffer_full,
     "the stream's buffer is full: check the network and the load of this computer, or lower "
     "rate_hz"},
};

}  // namespace

Words words_of(std::uint32_t value) {
  return {static_cast<std::uint16_t>(value >> 16), static_cast<std::uint16_t>(value)};
}

Words words_of_float(float value) {
  return words_of(std::bit_cast<std::uint32_t>(value));
}

std::uint32_t u32_of(std::uint16_t high, std::uint16_t low) {
  return static_cast<std::uint32_t>(high) << 16 | low;
}

float float_of(std::uint16_t high, std::uint16_t low) {
  return std::bit_cast<float>(u32_of(high, low));
}

std::string error_text(int code) {
  const auto* const known = std::find_if(std::begin(kErrors), std::end(kErrors),
                                         [&](const CodeText& row) { return row.code == code; });
  const std::string number = "LabJack error " + std::to_string(code);
  return known == std::end(kErrors) ? number : number + ", " + known->text;
}

std::optional<std::size_t> range_index(double range_v) {
  const auto* const at = std::find(kRanges_v.begin(), kRanges_v.end(), range_v);
  if (at == kRanges_v.end()) return std::nullopt;
  return static_cast<std::size_t>(at - kRanges_v.begin());
}

std::uint32_t flash_address(int block) {
  return 0x3C4000 + static_cast<std::uint32_t>(block * kFlashNumbers) * 4;
}

}  // namespace mdof::drivers::labjack_t7
