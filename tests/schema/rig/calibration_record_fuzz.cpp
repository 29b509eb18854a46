// Calibration records. The input is the body of a record, and the fuzzer adds the correct hash.
// The record follows the text of a rig. It is read, or rejected with a reason. If it is read, it
// is written and read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "schema/base/sha256.h"
#include "schema/rig/calibrated.h"
#include "tests/algo/rigs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mdof;
  static const std::string rig = "calibration = \"record.toml\"\n" + test::rig_x_toml();
  const std::string body(reinterpret_cast<const char*>(data), size);
  const std::string part =
      std::string(kRecordHead) + "\nsha256 = \"" + sha256_hex(body) + "\"\n" + body;
  const auto calibrated = parse_rig(rig + part, "fuzz.toml");
  if (!calibrated) {
    if (calibrated.error().message.empty()) std::abort();
    return 0;
  }
  (void)calibration_notices(*calibrated);
  const std::string text = record_text(calibrated->records.front());
  const auto parts = record_parts(text);
  if (parts.size() != 1 || !is_unchanged(parts.front())) std::abort();
  if (!parse_rig(rig + std::string(parts.front()), "again.toml")) std::abort();
  return 0;
}
