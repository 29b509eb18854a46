// One chunk of a recording: the SampleBlock of one device as compressed bytes with checksum.
//
//   4 bytes  "MDC1"
//   4 bytes  size of the unpacked bytes, little-endian, at most kMaxChunkBytes
//   the rest a zstd frame (level 1, with content checksum) of the unpacked bytes:
//     string   device                          (string: varint length, bytes)
//     varint   number of channels; each: string id, one byte Unit
//     varint   scans lost before the block
//     varint   number of scans n
//     n zigzag varints: first time stamp, first difference, then differences of differences
//     for each channel: 8 planes of n bytes, plane k holding byte k of each double (little-endian)
//     one byte 0 (all good), or 1 and for each channel: one byte 0 (all good), or 1 and n bytes
//
// A varint is LEB128: seven bits a byte, least significant first. Regular time stamps cost one byte
// a scan before compression, and a plane of exponents compresses to almost nothing. Pure functions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof {

// Limits on the cost of any input, far above the needs of any device.
inline constexpr std::size_t kMaxChunkBytes = 16u << 20;  // unpacked
inline constexpr std::size_t kMaxChunkChannels = 1024;

// Errors (bad_input): time stamps that do not increase, a limit above is exceeded.
Result<std::string> encode_chunk(const SampleBlock& block);

// Restores the block bit for bit, including NaN payloads; replaces `block` and reuses its capacity.
// Safe for any bytes: invalid bytes give bad_input with the reason, and `block` is then unspecified
// but valid.
Status decode_chunk(std::string_view bytes, SampleBlock& block);

}  // namespace mdof
