// Reads the quantities of a DCC's results: values, units and uncertainties of the D-SI format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/dcc/certificate.h"
#include "schema/dcc/xml_element.h"

namespace mdof {

// "file:12: dcc:item".
std::string place_of(const std::string& source, const XmlElement& element);

// The words of an attribute such as refType="basic_measuredValue gp_table1".
std::vector<std::string> read_ref_types(const XmlElement& element);
// The text of the first dcc:content in dcc:name; absent: empty.
std::string name_of(const XmlElement& element);

// Reads a dcc:quantity. Empty: its unit has neither length nor voltage.
Result<std::optional<DccQuantity>> read_quantity(const XmlElement& element,
                                                 const std::string& source);

}  // namespace mdof
