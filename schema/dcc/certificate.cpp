#include "schema/dcc/certificate.h"

#include <algorithm>

#include "schema/base/trimmed.h"
#include "schema/dcc/quantity.h"
#include "schema/dcc/xml_element.h"

namespace mdof {
namespace {

constexpr const char* kComplete = "; ask the laboratory to complete the DCC";

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return std::string(trimmed(text));
}

// Returns the text of an element that every DCC must have.
Result<std::string> text_at(const XmlElement& from, const char* path, const std::string& source) {
  const XmlElement* element = from.at(path);
  std::string text = element ? one_line(element->text) : "";
  if (!text.empty()) return text;
  return bad_input(place_of(source, element ? *element : from) + ": " + path +
                   (element ? " is empty" : " is missing") + kComplete);
}

Result<std::string> day_at(const XmlElement& from, const char* path, const std::string& source) {
  MDOF_TRY(std::string day, text_at(from, path, source));
  const bool plain = day.size() >= 10 && day[4] == '-' && day[7] == '-' &&
                     day.find_first_not_of("0123456789-") >= 10;
  if (!plain)
    return bad_input(place_of(source, *from.at(path)) + ": \"" + day.substr(0, 40) +
                     "\" is not a date (YYYY-MM-DD); ask the laboratory to correct the DCC");
  return day.substr(0, 10);  // xs:date may have a time zone after the day
}

void read_items(const XmlElement& items, DccCertificate& certificate) {
  const auto append = [](std::string& to, const std::string& text) {
    if (!text.empty()) to += (to.empty() ? "" : "; ") + text;
  };
  for (const XmlElement& item : items.children) {
    if (item.name != "dcc:item") continue;
    append(certificate.item, name_of(item));
    const XmlElement* all = item.child("dcc:identifications");
    if (!all) continue;
    for (const XmlElement& one : all->children) {
      const XmlElement *issuer = one.child("dcc:issuer"), *value = one.child("dcc:value");
      if (issuer && value && one_line(issuer->text) == "manufacturer")
        append(certificate.serial_number, one_line(value->text));
    }
  }
}

Status read_due(const XmlElement& statements, DccCertificate& certificate) {
  for (const XmlElement& statement : statements.children) {
    const auto types = read_ref_types(statement);
    if (std::find(types.begin(), types.end(), "basic_recalibration") == types.end()) continue;
    MDOF_TRY(certificate.due, day_at(statement, "dcc:date", certificate.source));
  }
  return {};
}

Status read_head(const XmlElement& data, DccCertificate& certificate) {
  const std::string& source = certificate.source;
  MDOF_TRY(certificate.number, text_at(data, "dcc:coreData/dcc:uniqueIdentifier", source));
  MDOF_TRY(certificate.calibrated, day_at(data, "dcc:coreData/dcc:endPerformanceDate", source));
  MDOF_TRY(certificate.laboratory,
           text_at(data, "dcc:calibrationLaboratory/dcc:contact/dcc:name/dcc:content", source));
  const XmlElement* items = data.child("dcc:items");
  if (!items) return bad_input(place_of(source, data) + ": dcc:items is missing" + kComplete);
  read_items(*items, certificate);
  const XmlElement* statements = data.child("dcc:statements");
  return statements ? read_due(*statements, certificate) : Status();
}

// Reads the quantities of dcc:data or of a dcc:list. Each dcc:list inside this element becomes a
// separate list of the result.
Status read_data(const XmlElement& data, const std::string& source,
                 std::vector<DccQuantity>& quantities, DccResult& result) {
  for (const XmlElement& child : data.children) {
    if (child.name == "dcc:quantity") {
      MDOF_TRY(auto quantity, read_quantity(child, source));
      if (quantity) quantities.push_back(std::move(*quantity));
    }
    if (child.name != "dcc:list") continue;
    std::vector<DccQuantity> of_list;
    MDOF_CHECK(read_data(child, source, of_list, result));
    if (!of_list.empty()) result.lists.push_back(std::move(of_list));
  }
  return {};
}

Status read_results(const XmlElement& measured, DccCertificate& certificate) {
  const XmlElement* results = measured.child("dcc:results");
  if (!results) return {};
  for (const XmlElement& element : results->children) {
    const XmlElement* data = element.child("dcc:data");
    if (element.name != "dcc:result" || !data) continue;
    DccResult result;
    result.name = name_of(element);
    result.ref_types = read_ref_types(element);
    result.line = element.line;
    MDOF_CHECK(read_data(*data, certificate.source, result.quantities, result));
    certificate.results.push_back(std::move(result));
  }
  return {};
}

}  // namespace

Result<DccCertificate> read_dcc(std::string_view text, const std::string& source) {
  MDOF_TRY(const XmlElement root, parse_xml(text, source));
  if (root.name != "dcc:digitalCalibrationCertificate")
    return bad_input(place_of(source, root) +
                     ": is not a DCC (dcc:digitalCalibrationCertificate of https://ptb.de/dcc); "
                     "give the XML file that the laboratory issued");
  const std::string_view version = root.attribute("schemaVersion");
  if (!version.starts_with("3."))
    return bad_input(place_of(source, root) + ": schemaVersion is \"" + std::string(version) +
                     "\", but mdof reads 3.x; ask the laboratory for a DCC of version 3");
  DccCertificate certificate;
  certificate.source = source;
  const XmlElement* data = root.child("dcc:administrativeData");
  const XmlElement* results = root.child("dcc:measurementResults");
  if (!data || !results)
    return bad_input(place_of(source, root) + ": " +
                     (data ? "dcc:measurementResults" : "dcc:administrativeData") + " is missing" +
                     kComplete);
  MDOF_CHECK(read_head(*data, certificate));
  for (const XmlElement& measured : results->children)
    MDOF_CHECK(read_results(measured, certificate));
  for (const XmlElement& child : root.children)
    certificate.is_signed = certificate.is_signed || child.name.ends_with(":Signature");
  return certificate;
}

}  // namespace mdof
