// Reads the quantities in the results of a DCC: values, units and uncertainties in the D-SI format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/dcc/certificate.h"
#include "schema/dcc/xml_element.h"

namespace mdof {

// Returns for example "file:12: dcc:item".
std::string place_of(const std::string& source, const XmlElement& element);

// Returns the words of the attribute refType, for example of refType="basic_measuredValue
// gp_table1".
std::vector<std::string> read_ref_types(const XmlElement& element);
// Returns the text of the first dcc:content in dcc:name. Empty: dcc:name has no
// dcc:content.
std::string name_of(const XmlElement& element);

// Reads a dcc:quantity. Returns nothing if its unit has neither length nor voltage.
Result<std::optional<DccQuantity>> read_quantity(const XmlElement& element,
                                                 const std::string& source);

}  // namespace mdof
