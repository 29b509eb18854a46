// Finds a program by its name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace mdof::tools {

// The first executable file with this name in the folders of PATH; nullopt: there is none.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace mdof::tools
