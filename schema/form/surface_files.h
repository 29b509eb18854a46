// Height maps as instruments write them.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof {

// ISO 25178-71 .sdf as text (aISO-1.0, aISO-2.0, and aBCR-1.0 before it): heights are m after
// Zscale, BAD is missing, the first point is at (0, 0) and y grows with the profile's number.
bool is_sdf(std::string_view bytes);  // of the text form, or of the binary one, which is refused
Result<SurfaceMap> parse_sdf(std::string_view text, const std::string& source);

// Zygo MetroPro .dat, formats 1 to 3: the connected phase, as heights. x grows with the column, y
// with the row of the camera; the camera's first pixel is (0, 0).
bool is_zygo_dat(std::string_view bytes);
Result<SurfaceMap> parse_zygo_dat(std::string_view bytes, const std::string& source);

}  // namespace mdof
