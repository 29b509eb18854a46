// Writes the parts of a DCC.
#pragma once

#include <string>
#include <string_view>

#include "daemon/output/documents/xml.h"
#include "daemon/output/report/report.h"

namespace mdof::documents {

// Writes <element><dcc:content lang="en">text</dcc:content></element>.
void write_text(Xml& xml, std::string_view element, std::string_view text,
                Xml::Attributes attributes = {});

// Writes a declaration with a name. `element`: "dcc:statement" or "dcc:metaData".
void write_declaration(Xml& xml, std::string_view element, const std::string& name,
                       const std::string& text);

// Writes the element dcc:measurementResults.
void write_measurements(Xml& xml, const report::Report& report);

}  // namespace mdof::documents
