// A page of HTML printed to PDF by a program of Debian that is installed: chromium or weasyprint.
#pragma once

#include <filesystem>

#include "schema/base/result.h"

namespace mdof::tools {

// `html` is not changed; a file of the name of `pdf` is replaced. Errors: io, where neither program
// is on PATH (with what to install), where it fails, or where it takes longer than two minutes.
Status print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

}  // namespace mdof::tools
