// Facts about a measurement that only a person knows, for reports and certificates: [report] of a
// rig, or --set KEY=VALUE of a command. Empty: not stated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"

namespace mdof {

class TomlTable;

struct ReportFacts {
  std::string number;  // of the report
  std::string customer, customer_address;
  std::string laboratory, laboratory_address;  // who measured
  std::string machine, manufacturer, serial_number, operator_name;
  std::string conditions;  // free text
  std::string place;       // where the measurement took place: laboratory, customer, other
  std::string date;        // of the measurement, YYYY-MM-DD, because a CSV log has no date
  std::string country;     // of the laboratory, two capitals of ISO 3166-1
};

struct ReportKey {
  const char* name;  // "serial_number"
  std::string ReportFacts::*fact;
};
const std::vector<ReportKey>& report_keys();

// Reads [report] of a rig; an invalid value is rejected there.
ReportFacts read_report_facts(TomlTable& root);

bool is_date(std::string_view text);  // YYYY-MM-DD

// Sets one key of --set. Errors (usage): an unknown key, an invalid value.
Status set_fact(ReportFacts& facts, std::string_view key, const std::string& value);

// Combines both. Error (usage): different values for one key.
Result<ReportFacts> joined(const ReportFacts& a, const ReportFacts& b);

}  // namespace mdof
