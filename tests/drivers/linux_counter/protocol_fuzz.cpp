#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "drivers/linux_counter/protocol.h"
#include "drivers/sysfs/attribute.h"

// The input is the ceiling, followed by the text of a count.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof::drivers;
  std::uint64_t ceiling = 0;
  if (size < sizeof ceiling) return 0;
  std::memcpy(&ceiling, data, sizeof ceiling);
  const std::string text(reinterpret_cast<const char*>(data) + sizeof ceiling,
                         size - sizeof ceiling);
  CountFiles files;
  files.ceiling = text;
  (void)check_count(files, "fuzz", "", ceiling);
  const auto raw = parse_sysfs_integer(text);
  if (!raw || ceiling == 0) return 0;
  CountUnwrap unwrap(ceiling);
  const auto first = unwrap(static_cast<std::uint64_t>(*raw));
  if (first && unwrap(static_cast<std::uint64_t>(*raw)) != first) std::abort();
  return 0;
}
