// A calibration certificate in the form of a DCC, PTB's Digital Calibration Certificate 3.x (XML):
// who calibrated what and when, and the results that consist of lengths and voltages. The refType
// gives the meaning of a quantity, as in PTB's Good Practice DCCs: basic_measuredValue,
// basic_referenceValue, basic_measurementError.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/dcc/si_unit.h"

namespace mdof {

// A si:real or si:realListXMLList; from a si:hybrid the first one with such a unit.
struct DccQuantity {
  std::string name;
  std::vector<std::string> ref_types;
  std::string unit_text;
  SiUnit unit;
  std::vector<double> value;  // SI: m^unit.metre V^unit.volt
  std::vector<double> u;      // standard uncertainties, SI, one for each value; empty: not stated
  std::vector<double> coverage_factor;  // k of U = k u; 1 if u itself is stated
  long line = 0;

  bool has_type(std::string_view ref_type) const {
    return std::find(ref_types.begin(), ref_types.end(), ref_type) != ref_types.end();
  }
};

struct DccResult {
  std::string name;
  std::vector<std::string> ref_types;
  std::vector<std::vector<DccQuantity>> lists;  // quantities of each dcc:list
  std::vector<DccQuantity> quantities;          // outside lists
  long line = 0;
};

struct DccCertificate {
  std::string source;  // file name, for messages
  std::string number, laboratory, calibrated;
  std::string due;            // empty: no statement basic_recalibration
  std::string item;           // names of the item, joined by "; "
  std::string serial_number;  // from the manufacturer; empty: not stated
  bool is_signed = false;     // the signature is not verified
  std::vector<DccResult> results;
};

// Errors name file, line and element: not XML; no DCC or not 3.x; a missing part that the DCC must
// have; a list whose numbers of uncertainties or units and of values differ; text instead of a
// number.
Result<DccCertificate> read_dcc(std::string_view text, const std::string& source);

}  // namespace mdof
