// Unpacks gzip data (RFC 1952). The data may consist of several members; the CRC and the length of
// each member are checked.
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
  // Unpacks bytes from `input` and removes these bytes from `input`. Returns the number of bytes
  // written to `to`; 0: more input is needed. Errors state the position in the data, but not the
  // name of the file.
  Result<std::size_t> unpack(std::string_view& input, char* to, std::size_t capacity);
  // Call this at the end of the input. Error: the input ends before the end of a member.
  Status check_end() const;

 private:
  Status next_member(std::string_view& input);

  std::unique_ptr<z_stream_s> stream_;
  std::uint64_t unpacked_ = 0;
  bool between_members_ = true;
  bool padding_ = false;  // only zeros follow the last member, as on tapes
};

}  // namespace mdof::drivers
