// Converts numbers to bytes and back, for recordings, statistics and checkpoints. Little-endian. A
// varint is LEB128: each byte contains seven bits, the least significant bits first.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace mdof {

static_assert(
    std::endian::native == std::endian::little,
    "numbers are written in the byte order of the processor, which must be little-endian");

// Appends an integer or a double as it is stored in memory.
template <class T>
void put_number(std::string& to, const T& x) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &x, sizeof(T));
  to.append(bytes.data(), bytes.size());
}

inline void put_varint(std::string& to, std::uint64_t x) {
  for (; x >= 0x80; x >>= 7) to.push_back(static_cast<char>(x | 0x80));
  to.push_back(static_cast<char>(x));
}

// Appends the length as a varint, then the text.
inline void put_string(std::string& to, std::string_view text) {
  put_varint(to, text.size());
  to.append(text);
}

// Reads values from the beginning of the bytes. After the end, every value is zero or empty, and
// ok() is false. Therefore the caller can read many values and check ok() once.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) {
      fail();
      return {};
    }
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  template <class T>
  T number() {
    static_assert(std::is_trivially_copyable_v<T>);
    T x{};
    const std::string_view bytes = take(sizeof(T));
    if (!bytes.empty()) std::memcpy(&x, bytes.data(), sizeof(T));
    return x;
  }
  std::uint64_t varint() {
    std::uint64_t x = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      x |= std::uint64_t{byte & 0x7Fu} << shift;
      if (byte < 0x80) return x;
    }
    fail();
    return 0;
  }
  std::string_view string() { return take(varint()); }
  // Reads a varint: the number of the items that follow. Fails if the remaining bytes are too few
  // for so many items of at least `bytes_each` bytes; this limits later allocations.
  std::size_t count(std::size_t bytes_each) {
    const std::uint64_t n = varint();
    if (n <= rest_.size() / bytes_each) return n;
    fail();
    return 0;
  }

 private:
  void fail() {
    ok_ = false;
    rest_ = {};
  }
  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace mdof
