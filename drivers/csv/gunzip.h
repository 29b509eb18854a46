// Unpacks gzip data (RFC 1952), one member after another, checking each CRC and length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "schema/base/result.h"

struct z_stream_s;

namespace mdof::drivers {

class Gunzip {
 public:
  static bool recognises(std::string_view beginning) { return beginning.starts_with("\x1f\x8b"); }

  Gunzip();
  ~Gunzip();
  // Unpacks from `input`, takes what it used off it, gives the number of bytes put out: 0 where it
  // needs more input. Errors say how far it got, not which file.
  Result<std::size_t> unpack(std::string_view& input, char* to, std::size_t capacity);
  // To be asked at the end of the input: it may only end between members.
  Status check_end() const;

 private:
  Status next_member(std::string_view& input);

  std::unique_ptr<z_stream_s> stream_;
  std::uint64_t unpacked_ = 0;
  bool between_members_ = true;
  bool padding_ = false;  // zeros behind the last member, as tapes have them
};

}  // namespace mdof::drivers
