// A page of HTML printed to PDF by a program of Debian that is installed: chromium or weasyprint.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// `html` is not changed; a file of the name of `pdf` is replaced. Errors: io, where neither program
// is on PATH (with what to install), where it fails, or where it takes longer than two minutes.
Status print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

// Puts a file of these bytes into the PDF as an attachment, by qpdf. Where qpdf is not installed,
// says so and leaves the PDF as it is. Errors: io, where qpdf fails; the PDF is as it was.
Status attach_to_pdf(const std::filesystem::path& pdf, const std::string& name,
                     const std::string& media_type, const std::string& bytes);

}  // namespace mdof::tools
