#include "schema/recording/chunk.h"

#include <zstd.h>

#include <bit>
#include <cstdint>
#include <memory>

#include "schema/base/bytes.h"

namespace mdof {
namespace {

constexpr std::string_view kMagic = "MDC1";
constexpr std::size_t kHeadBytes = 8;
constexpr int kLevel = 1;

std::uint64_t zigzag(std::uint64_t x) {
  return (x << 1) ^ (0 - (x >> 63));
}
std::uint64_t unzigzag(std::uint64_t x) {
  return (x >> 1) ^ (0 - (x & 1));
}

// ---- writing ----

// Uses unsigned arithmetic, because its overflow is defined. The reader reverses the overflow.
void put_times(std::string& out, const std::vector<std::int64_t>& time_ns) {
  std::uint64_t last = 0, step = 0;
  for (std::size_t i = 0; i < time_ns.size(); ++i) {
    const auto t = static_cast<std::uint64_t>(time_ns[i]);
    put_varint(out, zigzag(t - last - step));
    if (i > 0) step = t - last;
    last = t;
  }
}

void put_planes(std::string& out, const std::vector<double>& values) {
  const std::size_t n = values.size(), start = out.size();
  out.resize(start + 8 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    for (std::size_t k = 0; k < 8; ++k) out[start + k * n + i] = static_cast<char>(bits >> (8 * k));
  }
}

void put_qualities(std::string& out, const SampleBlock& block) {
  out.push_back(block.quality.empty() ? 0 : 1);
  for (const auto& channel : block.quality) {
    out.push_back(channel.empty() ? 0 : 1);
    for (const Quality q : channel) out.push_back(static_cast<char>(q));
  }
}

[[maybe_unused]] bool consistent(const SampleBlock& block) {
  const std::size_t channels = block.channels.size(), n = block.scans();
  if (block.value.size() != channels) return false;
  if (!block.quality.empty() && block.quality.size() != channels) return false;
  for (const auto& v : block.value)
    if (v.size() != n) return false;
  for (const auto& q : block.quality)
    if (!q.empty() && q.size() != n) return false;
  return true;
}

bool increasing(const std::vector<std::int64_t>& time_ns) {
  for (std::size_t i = 1; i < time_ns.size(); ++i)
    if (time_ns[i] <= time_ns[i - 1]) return false;
  return true;
}

std::string pack(const SampleBlock& block) {
  std::string raw;
  raw.reserve(64 + block.scans() * (2 + 8 * block.channels.size()));
  put_string(raw, block.device);
  put_varint(raw, block.channels.size());
  for (const Channel& channel : block.channels) {
    put_string(raw, channel.id);
    raw.push_back(static_cast<char>(channel.unit));
  }
  put_varint(raw, block.lost);
  put_varint(raw, block.scans());
  put_times(raw, block.time_ns);
  for (const auto& values : block.value) put_planes(raw, values);
  put_qualities(raw, block);
  return raw;
}

// ---- reading ----

tl::unexpected<Error> damaged(const char* what) {
  return bad_input(std::string("damaged chunk: ") + what);
}

Status get_channels(ByteReader& in, SampleBlock& block) {
  const std::uint64_t count = in.varint();
  if (count > kMaxChunkChannels) return damaged("too many channels");
  block.channels.resize(count);
  for (Channel& channel : block.channels) {
    channel.id = in.string();
    const std::uint8_t unit = in.number<std::uint8_t>();
    if (unit > static_cast<std::uint8_t>(Unit::metre)) return damaged("unknown unit");
    channel.unit = static_cast<Unit>(unit);
  }
  return {};
}

Status get_times(ByteReader& in, std::vector<std::int64_t>& time_ns) {
  const std::uint64_t count = in.varint();
  // Each scan needs at least one byte.
  if (count > in.left()) return damaged("more scans than bytes");
  time_ns.resize(count);
  std::uint64_t last = 0, step = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t t = last + step + unzigzag(in.varint());
    if (i > 0) step = t - last;
    last = t;
    time_ns[i] = static_cast<std::int64_t>(t);
  }
  if (!in.ok() || !increasing(time_ns))
    return damaged("time stamps are missing or do not increase");
  return {};
}

void get_planes(std::string_view planes, std::vector<double>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 8; ++k)
      bits |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(planes[k * n + i])) << (8 * k);
    values[i] = std::bit_cast<double>(bits);
  }
}

Status get_values(ByteReader& in, SampleBlock& block) {
  block.value.resize(block.channels.size());
  for (auto& values : block.value) {
    const std::string_view planes = in.take(8 * block.scans());
    if (!in.ok()) return damaged("values are missing");
    values.resize(block.scans());
    get_planes(planes, values);
  }
  return {};
}

Status get_quality(ByteReader& in, std::size_t scans, std::vector<Quality>& quality) {
  quality.clear();
  const std::uint8_t present = in.number<std::uint8_t>();
  if (present > 1) return damaged("wrong quality mark");
  for (const char c : in.take(present * scans)) {
    const auto q = static_cast<std::uint8_t>(c);
    if (q >= kQualityCount) return damaged("unknown quality");
    quality.push_back(static_cast<Quality>(q));
  }
  return {};
}

Status get_qualities(ByteReader& in, SampleBlock& block) {
  block.quality.clear();
  const std::uint8_t present = in.number<std::uint8_t>();
  if (present > 1) return damaged("wrong quality mark");
  block.quality.resize(present * block.channels.size());
  for (auto& quality : block.quality) MDOF_CHECK(get_quality(in, block.scans(), quality));
  return {};
}

Status unpack(std::string_view raw, SampleBlock& block) {
  ByteReader in(raw);
  block.device = in.string();
  MDOF_CHECK(get_channels(in, block));
  block.lost = in.varint();
  MDOF_CHECK(get_times(in, block.time_ns));
  MDOF_CHECK(get_values(in, block));
  MDOF_CHECK(get_qualities(in, block));
  if (!in.at_end()) return damaged("length");
  return {};
}

std::size_t declared_size(std::string_view bytes) {
  std::size_t size = 0;
  for (std::size_t k = 0; k < 4; ++k)
    size |= static_cast<std::size_t>(static_cast<std::uint8_t>(bytes[4 + k])) << (8 * k);
  return size;
}

struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

Result<std::string> encode_chunk(const SampleBlock& block) {
  assert(consistent(block));
  if (!increasing(block.time_ns))
    return bad_input("device \"" + block.device + "\": time stamps do not increase");
  const std::string raw = pack(block);
  if (raw.size() > kMaxChunkBytes || block.channels.size() > kMaxChunkChannels)
    return bad_input("device \"" + block.device + "\": a block of " + std::to_string(raw.size()) +
                     " bytes and " + std::to_string(block.channels.size()) +
                     " channels is too large for a chunk; split the block");
  std::string out(kMagic);
  for (std::size_t k = 0; k < 4; ++k) out.push_back(static_cast<char>(raw.size() >> (8 * k)));
  out.resize(kHeadBytes + ZSTD_compressBound(raw.size()));
  const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  const std::size_t packed = ZSTD_compress2(context.get(), out.data() + kHeadBytes,
                                            out.size() - kHeadBytes, raw.data(), raw.size());
  assert(!ZSTD_isError(packed));  // zstd itself has calculated the room that it needs
  out.resize(kHeadBytes + packed);
  return out;
}

Status decode_chunk(std::string_view bytes, SampleBlock& block) {
  if (bytes.size() < kHeadBytes || bytes.substr(0, 4) != kMagic) return damaged("no chunk mark");
  const std::size_t size = declared_size(bytes);
  if (size > kMaxChunkBytes) return damaged("the size exceeds the limit");
  const std::string_view frame = bytes.substr(kHeadBytes);
  // The size is checked before memory is allocated: the zstd frame must state the same size.
  if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != size) return damaged("wrong size");
  std::string raw(size, '\0');
  const std::size_t got = ZSTD_decompress(raw.data(), size, frame.data(), frame.size());
  if (ZSTD_isError(got)) return damaged(ZSTD_getErrorName(got));
  if (got != size) return damaged("wrong size");
  return unpack(raw, block);
}

}  // namespace mdof
