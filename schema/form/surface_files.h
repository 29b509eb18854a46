// Reads height maps in the file formats of instruments.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/form/height_map.h"

namespace mdof {

// ISO 25178-71 .sdf as text (aISO-1.0, aISO-2.0, and the older aBCR-1.0). A height in the file
// times Zscale is the height in m. BAD is a missing height. The first point is at (0, 0), and y
// increases with the number of the profile.
//
// is_sdf() is true for the text format, and for the binary format, which parse_sdf() rejects.
bool is_sdf(std::string_view bytes);
Result<SurfaceMap> parse_sdf(std::string_view text, const std::string& source);

// Zygo MetroPro .dat, formats 1 to 3: the connected phase is converted to heights. x increases with
// the column of the camera. The first row of the file is the top of the image, so y decreases with
// the row. The lowest row of the camera is at y = 0. If the file does not state the height of the
// camera, a file that begins with the top row has its lowest row at y = 0; in other files, the top
// row of the camera is at y = 0, so y is negative.
bool is_zygo_dat(std::string_view bytes);
Result<SurfaceMap> parse_zygo_dat(std::string_view bytes, const std::string& source);

}  // namespace mdof
