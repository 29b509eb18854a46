// One chunk of a recording: the SampleBlock of one device as compressed bytes with a checksum.
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
// A varint is LEB128: each byte contains seven bits, the least significant bits first. Before
// compression, regular time stamps need one byte for each scan. The planes with the exponents of
// the doubles become very small by compression. Pure functions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/sample.h"

namespace mdof {

// Limits that bound memory and time for any input. They are much larger than any device needs.
inline constexpr std::size_t kMaxChunkBytes = 16u << 20;  // before compression
inline constexpr std::size_t kMaxChunkChannels = 1024;

// Errors (bad_input): the time stamps do not increase, or a limit above is exceeded.
Result<std::string> encode_chunk(const SampleBlock& block);

// Restores the block bit for bit, including NaN payloads. Replaces the contents of `block` and
// reuses its memory. Accepts any bytes. Invalid bytes cause the error bad_input with the reason;
// the contents of `block` are then unspecified but valid.
Status decode_chunk(std::string_view bytes, SampleBlock& block);

}  // namespace mdof
