// Requests to devices, and replies that the vendor's open source accepts. Vectors are needed,
// because a simulated device and its driver have the same author and could have the same error.
#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers {

struct VendorVector {
  const char* what;
  const char* request;  // hexadecimal
  const char* reply;    // hexadecimal; ".." is any byte
  const char* source;   // repository, file and function
};

inline std::ostream& operator<<(std::ostream& out, const VendorVector& vector) {
  return out << vector.what << " (" << vector.source << ")";
}

// Compares `reply` with the pattern. Returns the first difference, or "".
inline std::string mismatch(std::string_view reply, std::string_view pattern) {
  std::string places;
  for (const char c : pattern)
    if (c != ' ') places += c;
  if (reply.size() != places.size() / 2)
    return "it has " + std::to_string(reply.size()) + " bytes, not " +
           std::to_string(places.size() / 2);
  for (std::size_t i = 0; i < reply.size(); ++i) {
    const std::string byte = places.substr(2 * i, 2);
    if (byte != ".." && modbus::bytes(byte)[0] != reply[i])
      return "byte " + std::to_string(i) + " is " +
             std::to_string(static_cast<unsigned char>(reply[i])) + ", not 0x" + byte;
  }
  return "";
}

}  // namespace mdof::drivers
