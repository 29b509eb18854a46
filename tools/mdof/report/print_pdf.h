// Prints an HTML page to PDF with an installed program: chromium or weasyprint.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// Replaces an existing file `pdf`. Errors (io): neither program is on PATH (the message states what
// to install); the program fails, or needs more than two minutes.
Status print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

// Attaches a file with the content `bytes` to the PDF, with the program qpdf. If qpdf is not
// installed, prints a warning and does not change the PDF. Error (io): qpdf fails; the PDF is
// unchanged.
Status attach_to_pdf(const std::filesystem::path& pdf, const std::string& name,
                     const std::string& media_type, const std::string& bytes);

}  // namespace mdof::tools
