// Prints an HTML page to PDF with an installed program: chromium or weasyprint.
#pragma once

#include <filesystem>
#include <string>

#include "schema/base/result.h"

namespace mdof::tools {

// Does not change `html`; replaces an existing file `pdf`. Errors (io): neither program is on PATH
// (the message says what to install), the program fails, or it takes longer than two minutes.
Status print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

// Attaches a file with these bytes to the PDF, with qpdf. If qpdf is not installed, the function
// warns and leaves the PDF unchanged. Error (io): qpdf fails; the PDF is unchanged.
Status attach_to_pdf(const std::filesystem::path& pdf, const std::string& name,
                     const std::string& media_type, const std::string& bytes);

}  // namespace mdof::tools
