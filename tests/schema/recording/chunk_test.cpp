#include "schema/recording/chunk.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <bit>
#include <limits>
#include <random>

#include "schema/units.h"

namespace mdof {
namespace {

using Random = std::mt19937_64;

std::uint64_t below(Random& random, std::uint64_t n) {
  return random() % n;
}

std::vector<std::int64_t> random_times(Random& random, std::size_t n) {
  std::vector<std::int64_t> times;
  std::int64_t t = static_cast<std::int64_t>(random() >> 2) * (below(random, 2) ? 1 : -1);
  const std::uint64_t jitter = std::uint64_t{1} << below(random, 30);
  for (std::size_t i = 0; i < n; ++i)
    times.push_back(t += 1 + static_cast<std::int64_t>(below(random, jitter)));
  return times;
}

// If any_bits is true, the values have random bits, which include NaN payloads, infinities,
// denormals and -0.0.
std::vector<double> random_values(Random& random, std::size_t n) {
  const bool any_bits = below(random, 2);
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i)
    values.push_back(any_bits ? std::bit_cast<double>(random())
                              : 1e-3 * static_cast<double>(below(random, 100000)));
  return values;
}

std::vector<Quality> random_quality(Random& random, std::size_t n) {
  std::vector<Quality> quality;
  for (std::size_t i = 0; i < n; ++i)
    quality.push_back(static_cast<Quality>(below(random, kQualityCount)));
  return quality;
}

SampleBlock random_block(Random& random) {
  SampleBlock block;
  const std::size_t n = below(random, 300), channels = below(random, 8);
  block.device = std::string(below(random, 20), 'd');
  block.lost = below(random, 3) ? 0 : random();
  block.time_ns = random_times(random, n);
  const bool qualities = channels > 0 && below(random, 2);
  for (std::size_t c = 0; c < channels; ++c) {
    block.channels.push_back({"c" + std::to_string(random()), static_cast<Unit>(below(random, 5))});
    block.value.push_back(random_values(random, n));
    if (qualities)
      block.quality.push_back(below(random, 2) ? random_quality(random, n)
                                               : std::vector<Quality>());
  }
  return block;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

void expect_same(const SampleBlock& a, const SampleBlock& b) {
  EXPECT_EQ(a.device, b.device);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.time_ns, b.time_ns);
  EXPECT_EQ(a.quality, b.quality);
  EXPECT_EQ(a.lost, b.lost);
  ASSERT_EQ(a.value.size(), b.value.size());
  for (std::size_t c = 0; c < a.value.size(); ++c) EXPECT_TRUE(same_bits(a.value[c], b.value[c]));
}

// Properties that all users of a block need. They must be true for any input bytes.
bool sound(const SampleBlock& block) {
  for (std::size_t i = 1; i < block.scans(); ++i)
    if (block.time_ns[i] <= block.time_ns[i - 1]) return false;
  if (block.value.size() != block.channels.size()) return false;
  for (std::size_t c = 0; c < block.channels.size(); ++c) {
    if (block.value[c].size() != block.scans()) return false;
    for (std::size_t i = 0; i < block.scans(); ++i)
      if (static_cast<int>(block.quality_at(c, i)) >= kQualityCount) return false;
  }
  return true;
}

// A complete chunk whose content is `raw`. `claimed`: the size in its header.
std::string chunk_of(const std::string& raw, std::size_t claimed) {
  std::string out = "MDC1";
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<char>(claimed >> (8 * k)));
  std::string frame(ZSTD_compressBound(raw.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), raw.data(), raw.size(), 1));
  return out + frame;
}

std::string chunk_of(const std::string& raw) {
  return chunk_of(raw, raw.size());
}

std::string unpacked(const std::string& chunk) {
  std::string raw(ZSTD_getFrameContentSize(chunk.data() + 8, chunk.size() - 8), '\0');
  raw.resize(ZSTD_decompress(raw.data(), raw.size(), chunk.data() + 8, chunk.size() - 8));
  return raw;
}

TEST(Chunk, RoundTripsAnyBlockToTheSameBits) {
  Random random(1);
  SampleBlock back;  // the same block is used again, as in a reader
  for (int i = 0; i < 2000; ++i) {
    const SampleBlock block = random_block(random);
    const auto bytes = encode_chunk(block);
    ASSERT_TRUE(bytes) << bytes.error().message;
    ASSERT_TRUE(decode_chunk(*bytes, back));
    expect_same(block, back);
  }
}

TEST(Chunk, KeepsTimesAtTheEndsOfTheirRange) {
  SampleBlock block;
  block.time_ns = {std::numeric_limits<std::int64_t>::min(), -1, 0,
                   std::numeric_limits<std::int64_t>::max()};
  SampleBlock back;
  ASSERT_TRUE(decode_chunk(*encode_chunk(block), back));
  expect_same(block, back);
}

TEST(Chunk, PacksRegularTimeStampsIntoFewBytes) {
  SampleBlock block;
  for (std::int64_t i = 0; i < 8000; ++i) block.time_ns.push_back(kNsPerS + 250'000 * i);
  EXPECT_LT(encode_chunk(block)->size(), 100u);
}

TEST(Chunk, RejectsTimesThatDoNotIncrease) {
  SampleBlock block;
  block.device = "probes";
  block.time_ns = {1, 2, 2};
  const auto bytes = encode_chunk(block);
  ASSERT_FALSE(bytes);
  EXPECT_NE(bytes.error().message.find("probes"), std::string::npos);
}

TEST(Chunk, RejectsABlockOverTheLimit) {
  SampleBlock block;
  block.channels.resize(1);
  block.value.resize(1);
  for (std::size_t i = 0; i < kMaxChunkBytes / 8; ++i)
    block.time_ns.push_back(static_cast<std::int64_t>(i));
  block.value[0].resize(block.scans());
  EXPECT_FALSE(encode_chunk(block));
}

TEST(Chunk, DetectsEveryFlippedBit) {
  Random random(2);
  SampleBlock block = random_block(random), back;
  while (block.scans() < 50 || block.channels.empty()) block = random_block(random);
  const std::string bytes = *encode_chunk(block);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    if (decode_chunk(flipped, back)) {
      // A changed bit that zstd does not use has no effect. In this case the samples must be
      // equal.
      expect_same(block, back);
    }
  }
}

TEST(Chunk, DetectsEveryTruncation) {
  Random random(3);
  SampleBlock back;
  const std::string bytes = *encode_chunk(random_block(random));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(decode_chunk(std::string_view(bytes).substr(0, size), back)) << size;
}

// Changed bytes inside a valid zstd frame, so that the checksum is correct.
TEST(Chunk, MutatedPayloadsAreRejectedOrValid) {
  Random random(4);
  SampleBlock back;
  int refused = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string raw = unpacked(*encode_chunk(random_block(random)));
    for (std::uint64_t k = 1 + below(random, 4); k > 0 && !raw.empty(); --k) {
      const std::size_t at =
          below(random, below(random, 2) ? raw.size() : std::min<std::size_t>(raw.size(), 32));
      raw[at] = static_cast<char>(random());
    }
    if (below(random, 4) == 0) raw.resize(below(random, raw.size() + 16));
    if (decode_chunk(chunk_of(raw), back)) {
      ASSERT_TRUE(sound(back));
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 3000);  // the test is useless if most changes have no effect
}

TEST(Chunk, MutatedFramesAreRejectedOrValid) {
  Random random(5);
  SampleBlock back;
  for (int i = 0; i < 10000; ++i) {
    std::string bytes = *encode_chunk(random_block(random));
    for (std::uint64_t k = 1 + below(random, 4); k > 0; --k)
      bytes[below(random, bytes.size())] = static_cast<char>(random());
    if (decode_chunk(bytes, back)) {
      ASSERT_TRUE(sound(back));
    }
  }
}

TEST(Chunk, RejectsAZipBombBeforeUnpacking) {
  const std::string zeros(kMaxChunkBytes * 8, '\0');
  SampleBlock back;
  EXPECT_FALSE(decode_chunk(chunk_of(zeros), back));        // the size in the header is correct
  EXPECT_FALSE(decode_chunk(chunk_of(zeros, 1000), back));  // the size in the header is too small
}

TEST(Chunk, RejectsHugeCounts) {
  SampleBlock back;
  const std::string huge = "\xff\xff\xff\xff\xff\xff\xff\xff\x7f";
  const std::string none(1, '\0');
  EXPECT_FALSE(decode_chunk(chunk_of(huge), back));                       // size of the device name
  EXPECT_FALSE(decode_chunk(chunk_of(none + huge), back));                // number of channels
  EXPECT_FALSE(decode_chunk(chunk_of(none + none + none + huge), back));  // number of scans
  // A varint that does not end.
  EXPECT_FALSE(decode_chunk(chunk_of(std::string(20, '\xff')), back));
}

TEST(Chunk, RejectsBytesAfterTheEnd) {
  SampleBlock back;
  const std::string raw = unpacked(*encode_chunk({}));
  EXPECT_TRUE(decode_chunk(chunk_of(raw), back));
  EXPECT_FALSE(decode_chunk(chunk_of(raw + '\0'), back));
}

}  // namespace
}  // namespace mdof
