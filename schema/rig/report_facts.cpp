#include "schema/rig/report_facts.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <system_error>

#include "schema/base/toml/toml_reader.h"

namespace mdof {
namespace {

constexpr std::string_view kCountryCodes =
#include "schema/rig/country_codes.inc"
    ;

bool is_country_code(const std::string& code) {
  return code.size() == 2 && code.find(' ') == std::string::npos &&
         (" " + std::string(kCountryCodes)).find(" " + code + " ") != std::string::npos;
}

// Returns the reason why the value is invalid; empty: it is valid.
std::string fault(std::string_view key, const std::string& value) {
  if (key == "country" && !value.empty() && !is_country_code(value))
    return "\"" + value +
           "\" is not an assigned country code of ISO 3166-1; give two capitals, such as DE or GB";
  if (key == "place" && !value.empty() && value != "laboratory" && value != "customer" &&
      value != "other")
    return "\"" + value +
           "\" is not one of the known places; give \"laboratory\", \"customer\" or \"other\"";
  if ((key == "date" || key == "issued") && !value.empty() && !is_date(value))
    return "\"" + value + "\" is not a date; give YYYY-MM-DD";
  return "";
}

}  // namespace

std::string result_content(const std::string& rig_text) {
  return TomlTable::content(rig_text, {"report"});
}

bool is_date(std::string_view text) {
  int year = 0;
  unsigned month = 0, day = 0;
  const auto read = [&](std::size_t at, std::size_t digits, auto& number) {
    const char* end = text.data() + at + digits;
    const auto read_to = std::from_chars(text.data() + at, end, number);
    return read_to.ec == std::errc() && read_to.ptr == end;
  };
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  if (!read(0, 4, year) || !read(5, 2, month) || !read(8, 2, day)) return false;
  return year > 0 && std::chrono::year_month_day{std::chrono::year(year), std::chrono::month(month),
                                                 std::chrono::day(day)}
                         .ok();
}

const std::vector<ReportKey>& report_keys() {
  using F = ReportFacts;
  static const std::vector<ReportKey> keys = {{"number", &F::number},
                                              {"customer", &F::customer},
                                              {"customer_address", &F::customer_address},
                                              {"laboratory", &F::laboratory},
                                              {"laboratory_address", &F::laboratory_address},
                                              {"machine", &F::machine},
                                              {"manufacturer", &F::manufacturer},
                                              {"serial_number", &F::serial_number},
                                              {"operator", &F::operator_name},
                                              {"conditions", &F::conditions},
                                              {"place", &F::place},
                                              {"date", &F::date},
                                              {"issued", &F::issued},
                                              {"country", &F::country}};
  return keys;
}

ReportFacts read_report_facts(TomlTable& root) {
  ReportFacts facts;
  auto report = root.table("report");
  if (!report) return facts;
  for (const ReportKey& key : report_keys()) {
    std::string& value = facts.*key.fact;
    value = report->string(key.name, "");
    if (const std::string why = fault(key.name, value); !why.empty()) report->reject(key.name, why);
  }
  return facts;
}

Status set_fact(ReportFacts& facts, std::string_view key, const std::string& value) {
  const auto& keys = report_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const ReportKey& k) { return key == k.name; });
  if (found == keys.end()) {
    std::string names;
    for (const ReportKey& k : keys) names += (names.empty() ? "" : ", ") + std::string(k.name);
    return fail(ErrorCode::usage,
                "the key \"" + std::string(key) + "\" is unknown; give one of " + names);
  }
  if (const std::string why = fault(key, value); !why.empty())
    return fail(ErrorCode::usage, std::string(key) + ": " + why);
  facts.*(found->fact) = value;
  return {};
}

Result<ReportFacts> joined(const ReportFacts& a, const ReportFacts& b) {
  ReportFacts facts = a;
  for (const ReportKey& key : report_keys()) {
    std::string& value = facts.*key.fact;
    const std::string& other = b.*key.fact;
    if (value.empty()) {
      value = other;
    } else if (!other.empty() && other != value) {
      return fail(ErrorCode::usage,
                  "[report] " + std::string(key.name) + ": one rig has \"" + value +
                      "\" and another rig has \"" + other + "\"",
                  Remedy::state_in_report, key.name);
    }
  }
  return facts;
}

}  // namespace mdof
