// Writing of plots, and their file names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof::charts {

struct NamedChart {
  std::string file;  // "run-3-straightness.svg"
  std::string svg;
};

// Writes all files or none into the folder, which is created if missing. Returns the paths. Error:
// io.
Result<std::vector<std::string>> write_charts(const std::vector<NamedChart>& charts,
                                              const std::filesystem::path& folder);

// Error: io, with the remedy.
Status make_plot_folder(const std::filesystem::path& folder);

// Keys are words already; every other character becomes its bytes in hexadecimal, so that different
// keys give different file names.
std::string file_name(std::string_view key);

}  // namespace mdof::charts
