// Common functions of the readers of controller files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/trimmed.h"

namespace mdof::controllers {

// Splits at LF; a last line without LF also counts.
std::vector<std::string_view> lines_of(std::string_view text);
// [-+]digits[.digits]; the whole word must match.
std::optional<double> decimal_from(std::string_view word);
// "X.comp:7: what"
tl::unexpected<Error> wrong_at(const std::string& file, std::size_t line, const std::string& what);
const ControllerFile* find_file(const std::vector<ControllerFile>& files, std::string_view name);

}  // namespace mdof::controllers
