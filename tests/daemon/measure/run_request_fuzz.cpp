// The JSON of a run's request, as it is in a recording. For any input, the request is read or
// rejected with a reason. If an accepted request is written and read again, it is unchanged.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "daemon/measure/replay/request_json.h"

namespace {

// JSON's -0 is read as the integer 0. Therefore a zero may lose its sign; nothing else may change.
std::string without_signed_zeros(std::string text) {
  for (std::size_t at = 0; (at = text.find("-0", at)) != std::string::npos; ++at)
    if (at + 2 == text.size() || std::strchr(",]}", text[at + 2])) text.erase(at, 1);
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto asked = mdof::daemon::read_request_json(text, {});
  if (!asked) {
    if (asked.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = mdof::daemon::request_json(*asked);
  const auto again = mdof::daemon::read_request_json(written, {});
  if (!again ||
      without_signed_zeros(mdof::daemon::request_json(*again)) != without_signed_zeros(written))
    std::abort();
  return 0;
}
