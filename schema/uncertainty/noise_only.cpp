#include "schema/uncertainty/noise_only.h"

namespace mdof {

std::string error_covers_text(NoiseOnly noise_only, bool some_without_u) {
  const char* const text[] = {
      "the u of the errors. mdof assumes that errors of different axes and errors from files are "
      "independent. Exceptions are the scale, linearity and tilt factor of a probe that measured "
      "several axes: they act on these axes together",
      "the u of the errors; the u of at least one error contains only noise and repeatability",
      "the u of the errors, which contains noise and repeatability only"};
  return std::string(text[static_cast<std::size_t>(noise_only)]) +
         (some_without_u ? "; errors without a u are not included" : "");
}

}  // namespace mdof
