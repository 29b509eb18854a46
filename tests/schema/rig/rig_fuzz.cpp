// Rigs as TOML. For any input, the text is read or rejected with a reason. If a text was read,
// reading it again gives the same rig.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "schema/rig/rig.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto rig = mdof::parse_rig(text, "fuzz.toml");
  if (!rig) {
    if (rig.error().message.empty()) std::abort();
    return 0;
  }
  const auto again = mdof::parse_rig(rig->text, "fuzz.toml");
  if (!again || again->probes.size() != rig->probes.size()) std::abort();
  (void)mdof::overdue_calibrations(*rig, "2026-11-22");
  return 0;
}
