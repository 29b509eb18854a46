#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "drivers/qsb/protocol.h"

// If a line can be parsed, encoding the result gives the same line, except for the case of its
// hexadecimal digits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  (void)is_qsb_banner(line);
  const auto reply = parse_qsb_line(line);
  if (!reply) return 0;
  const std::string again = qsb_line(*reply);
  if (again.size() != line.size() + 2) std::abort();
  if (parse_qsb_line(std::string_view(again).substr(0, line.size())) != reply) std::abort();
  return 0;
}
