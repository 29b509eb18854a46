// A program by its name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace mdof::tools {

// The first of this name on PATH that may be run.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace mdof::tools
