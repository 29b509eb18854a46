// A calibration of the mounting as text and as JSON.
#pragma once

#include <cstddef>
#include <string>

#include "schema/calibration/mounting.h"
#include "schema/calibration/record.h"
#include "schema/rig/rig.h"

namespace mdof::tools {

std::string mounting_text(const MountingCalibration& found, const Rig& rig, std::size_t width);
// `file` is empty if no record was written.
std::string mounting_json(const MountingCalibration& found, const CalibrationRecord& record,
                          const std::string& file, bool rig_declares);

}  // namespace mdof::tools
