// Where plots are written, and what their files are called.
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

// Into a folder that is made where it is missing: all files or none. Gives their paths. Error: io.
Result<std::vector<std::string>> write_charts(const std::vector<NamedChart>& charts,
                                              const std::filesystem::path& folder);

// Error: io, with the remedy.
Status make_plot_folder(const std::filesystem::path& folder);

// Keys are words already; whatever else one contains becomes its bytes in hexadecimal, so that
// different keys stay different files.
std::string file_name(std::string_view key);

}  // namespace mdof::charts
