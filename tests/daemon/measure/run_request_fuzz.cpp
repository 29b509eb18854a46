// What was asked of a run, as JSON in its recording: read or refused with a reason; what was read
// is written so that it is read alike.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "daemon/measure/request_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto asked = mdof::daemon::read_request_json(text, {});
  if (!asked) {
    if (asked.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = mdof::daemon::request_json(*asked);
  const auto again = mdof::daemon::read_request_json(written, {});
  if (!again || mdof::daemon::request_json(*again) != written) std::abort();
  return 0;
}
