// A calibration certificate that was read from PTB's Digital Calibration Certificate 3.x (DCC,
// XML). It contains the laboratory, the calibrated item, the date, and the results that are lengths
// or voltages. The attribute refType states the meaning of a quantity, as in PTB's Good Practice
// DCCs: basic_measuredValue, basic_referenceValue, basic_measurementError.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/dcc/si_unit.h"

namespace mdof {

// The contents of a si:real or si:realListXMLList. For a si:hybrid: the contents of the first
// element in it whose unit has a length or a voltage.
struct DccQuantity {
  std::string name;
  std::vector<std::string> ref_types;
  std::string unit_text;
  SiUnit unit;
  std::vector<double> value;            // SI: m^unit.metre V^unit.volt
  std::vector<double> u;                // standard uncertainty of each value, SI; empty: not stated
  std::vector<double> coverage_factor;  // k of U = k u; 1 if the DCC states u
  long line = 0;

  bool has_type(std::string_view ref_type) const {
    return std::find(ref_types.begin(), ref_types.end(), ref_type) != ref_types.end();
  }
};

struct DccResult {
  std::string name;
  std::vector<std::string> ref_types;
  std::vector<std::vector<DccQuantity>> lists;  // quantities of each dcc:list
  std::vector<DccQuantity> quantities;          // quantities outside of lists
  long line = 0;
};

struct DccCertificate {
  std::string source;  // file name, for messages
  std::string number, laboratory, calibrated;
  std::string due;            // empty: the DCC has no statement basic_recalibration
  std::string item;           // names of the item, joined by "; "
  std::string serial_number;  // given by the manufacturer; empty: not stated
  bool is_signed = false;     // true: has a signature; mdof does not verify it
  std::vector<DccResult> results;
};

// Errors (which state file, line and element):
// - the text is not XML
// - the XML is not a DCC, or not a DCC 3.x
// - a required element is missing
// - a list has a number of uncertainties or units that differs from its number of values
// - an element contains text instead of a number
Result<DccCertificate> read_dcc(std::string_view text, const std::string& source);

}  // namespace mdof
