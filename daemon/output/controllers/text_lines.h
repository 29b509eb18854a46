// Functions that several readers of controller files use.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/trimmed.h"

namespace mdof::controllers {

// The lines of a text, divided at LF. A last line without LF is included.
std::vector<std::string_view> lines_of(std::string_view text);
// Reads a number of the form [-+]digits[.digits]. nullopt: the word has another form.
std::optional<double> decimal_from(std::string_view word);
// The error "X.comp:7: " followed by `what`.
tl::unexpected<Error> wrong_at(const std::string& file, std::size_t line, const std::string& what);
const ControllerFile* find_file(const std::vector<ControllerFile>& files, std::string_view name);

}  // namespace mdof::controllers
