// Where plots are written, and what their files are called.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::charts {

// Error: io, with the remedy.
Status make_plot_folder(const std::filesystem::path& folder);

// Keys are words already; whatever else one contains becomes its bytes in hexadecimal, so that
// different keys stay different files.
std::string file_name(std::string_view key);

}  // namespace mdof::charts
