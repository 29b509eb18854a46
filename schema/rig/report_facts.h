// Facts about a measurement that the user states, for reports and certificates. They are in
// [report] of a rig, or in the option --set KEY=VALUE of a command. Empty: not stated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

class TomlTable;

struct ReportFacts {
  std::string number;  // number of the report
  std::string customer, customer_address;
  std::string laboratory, laboratory_address;  // laboratory that measured
  std::string machine, manufacturer, serial_number, operator_name;
  std::string conditions;  // free text about the conditions of the measurement
  std::string place;       // place of the measurement: laboratory, customer, other
  std::string date;        // date of the measurement, YYYY-MM-DD; a CSV log contains no date
  std::string issued;      // date on which the report is issued, YYYY-MM-DD
  std::string country;     // country of the laboratory, two capital letters of ISO 3166-1
};

struct ReportKey {
  const char* name;  // "serial_number"
  std::string ReportFacts::*fact;
};
const std::vector<ReportKey>& report_keys();

// Reads [report] of a rig. The error for an invalid value names its key.
ReportFacts read_report_facts(TomlTable& root);

// The content of a rig (TomlTable::content) without the facts, which do not change any result.
std::string result_content(const std::string& rig_text);

bool is_date(std::string_view text);  // YYYY-MM-DD

// Sets one fact from --set. Errors (usage): an unknown key, an invalid value.
Status set_fact(ReportFacts& facts, std::string_view key, const std::string& value);

// Combines the facts of `a` and `b`. Error (usage): the two values of a key differ.
Result<ReportFacts> joined(const ReportFacts& a, const ReportFacts& b);

}  // namespace mdof
