// A calibration certificate as a DCC, PTB's Digital Calibration Certificate 3.x (XML): who
// calibrated what and when, and those of its results that are made of lengths and voltages.
// What a quantity means is its refType, as in PTB's Good Practice DCCs: basic_measuredValue,
// basic_referenceValue, basic_measurementError.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/dcc/si_unit.h"

namespace mdof {

// A si:real or si:realListXMLList; of a si:hybrid the first with such a unit.
struct DccQuantity {
  std::string name;
  std::vector<std::string> ref_types;
  std::string unit_text;
  SiUnit unit;
  std::vector<double> value;  // SI: m^unit.metre V^unit.volt
  std::vector<double> u;      // standard uncertainties, SI, as many; empty: none is stated
  std::vector<double> coverage_factor;  // k of U = k u; 1 where u itself is stated
  long line = 0;

  bool has_type(std::string_view ref_type) const {
    return std::find(ref_types.begin(), ref_types.end(), ref_type) != ref_types.end();
  }
};

struct DccResult {
  std::string name;
  std::vector<std::string> ref_types;
  std::vector<std::vector<DccQuantity>> lists;  // quantities of one dcc:list each
  std::vector<DccQuantity> quantities;          // of no list
  long line = 0;
};

struct DccCertificate {
  std::string source;  // the file, for messages
  std::string number, laboratory, calibrated;
  std::string due;            // empty: no statement basic_recalibration
  std::string item;           // its names, several joined by "; "
  std::string serial_number;  // by its manufacturer; empty: not stated
  bool is_signed = false;     // the signature is not verified
  std::vector<DccResult> results;
};

// Errors name file, line and element: not XML, no DCC or not 3.x, a part that the DCC must have, a
// list with another number of uncertainties or units than of values, text in place of a number.
Result<DccCertificate> read_dcc(std::string_view text, const std::string& source);

}  // namespace mdof
