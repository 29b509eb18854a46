#include "schema/dcc/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "schema/base/number/number.h"
#include "schema/base/trimmed.h"

namespace mdof {
namespace {

// Names of the elements of an uncertainty in the D-SI format 2.2 and in older formats: the
// uncertainty, its value, and its coverage factor (nullptr: a standard uncertainty).
struct UncertaintyForm {
  const char *element, *value, *coverage_factor;
};
constexpr std::array<UncertaintyForm, 10> kForms = {{
    {"si:measurementUncertaintyUnivariate/si:expandedMU", "si:valueExpandedMU",
     "si:coverageFactor"},
    {"si:measurementUncertaintyUnivariate/si:standardMU", "si:valueStandardMU", nullptr},
    {"si:measurementUncertaintyUnivariate/si:coverageIntervalMU", "si:valueStandardMU", nullptr},
    {"si:expandedUnc", "si:uncertainty", "si:coverageFactor"},
    {"si:coverageInterval", "si:standardUnc", nullptr},
    {"si:measurementUncertaintyUnivariateXMLList/si:expandedMUXMLList", "si:valueExpandedMUXMLList",
     "si:coverageFactorXMLList"},
    {"si:measurementUncertaintyUnivariateXMLList/si:standardMUXMLList", "si:valueStandardMUXMLList",
     nullptr},
    {"si:measurementUncertaintyUnivariateXMLList/si:coverageIntervalMUXMLList",
     "si:valueStandardMUXMLList", nullptr},
    {"si:expandedUncXMLList", "si:uncertaintyXMLList", "si:coverageFactorXMLList"},
    {"si:coverageIntervalXMLList", "si:standardUncXMLList", nullptr},
}};

std::vector<std::string> words(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::vector<std::string> all;
  for (const std::string_view word : words_of(text)) all.emplace_back(word);
  return all;
}

std::string as_text(std::size_t n) {
  return std::to_string(n);
}

class QuantityReader {
 public:
  explicit QuantityReader(const std::string& source) : source_(source) {}

  Result<std::optional<DccQuantity>> read(const XmlElement& element) const {
    return read_one(element);
  }

 private:
  Result<std::vector<double>> numbers(const XmlElement& element) const {
    std::vector<double> all;
    for (const std::string& word : words(element.text)) {
      double x = 0;
      const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
      const char* end = word.data() + word.size();
      if (parse_double(begin, end, x) != end || !std::isfinite(x))
        return bad_input(place_of(source_, element) + ": \"" + word.substr(0, 40) +
                         "\" is not a finite number; ask the laboratory to correct the DCC");
      all.push_back(x);
    }
    return all;
  }

  // Reads n numbers. If the element has one number, it applies to all values.
  Result<std::vector<double>> as_many(const XmlElement& parent, const char* child,
                                      std::size_t n) const {
    const XmlElement* element = parent.child(child);
    if (!element)
      return bad_input(place_of(source_, parent) + ": " + child +
                       " is missing; ask the laboratory to complete the DCC");
    MDOF_TRY(auto all, numbers(*element));
    if (all.size() == 1) all.resize(n, all.front());
    if (all.size() != n)
      return bad_input(place_of(source_, *element) + ": has " + as_text(all.size()) +
                       " numbers for " + as_text(n) +
                       " values, but must have one number for all values or one for each value");
    return all;
  }

  Status read_uncertainty(const XmlElement& from, DccQuantity& quantity) const {
    for (const UncertaintyForm& form : kForms) {
      const XmlElement* element = from.at(form.element);
      if (!element) continue;
      const std::size_t n = quantity.value.size();
      MDOF_TRY(quantity.u, as_many(*element, form.value, n));
      quantity.coverage_factor.assign(n, 1);
      if (form.coverage_factor) {
        MDOF_TRY(quantity.coverage_factor, as_many(*element, form.coverage_factor, n));
      }
      for (std::size_t i = 0; i < n; ++i) {
        if (quantity.u[i] < 0 || !(quantity.coverage_factor[i] >= 1))
          return bad_input(place_of(source_, *element) +
                           ": an uncertainty is negative or a coverage factor is below 1; ask the "
                           "laboratory to correct the DCC");
        quantity.u[i] *= quantity.unit.factor / quantity.coverage_factor[i];
      }
      return {};
    }
    return {};
  }

  // Returns the unit of a list of units; empty if the units differ.
  std::optional<SiUnit> unit_of(const XmlElement& element, std::string& text) const {
    const auto units = words(element.text);
    if (units.empty() || std::any_of(units.begin(), units.end(),
                                     [&](const std::string& one) { return one != units[0]; }))
      return std::nullopt;
    text = units[0];
    return si_unit(text);
  }

  // Reads si:real or si:realListXMLList, inside or outside of si:hybrid.
  Result<std::optional<DccQuantity>> read_one(const XmlElement& parent) const {
    for (const XmlElement& form : parent.children) {
      if (form.name == "si:hybrid") {
        MDOF_TRY(auto found, read_one(form));
        if (found) return found;
      }
      const bool list = form.name == "si:realListXMLList";
      if (!list && form.name != "si:real") continue;
      MDOF_TRY(auto found, read_real(form, list));
      if (found) return found;
    }
    return std::optional<DccQuantity>();
  }

  Result<std::optional<DccQuantity>> read_real(const XmlElement& form, bool list) const {
    const XmlElement* unit = form.child(list ? "si:unitXMLList" : "si:unit");
    const XmlElement* value = form.child(list ? "si:valueXMLList" : "si:value");
    if (!unit || !value)
      return bad_input(place_of(source_, form) +
                       ": has no value or no unit; ask the laboratory to complete the DCC");
    DccQuantity quantity;
    quantity.line = form.line;
    const auto known = unit_of(*unit, quantity.unit_text);
    if (!known) return std::optional<DccQuantity>();
    quantity.unit = *known;
    MDOF_TRY(quantity.value, numbers(*value));
    if (quantity.value.empty() || (!list && quantity.value.size() > 1))
      return bad_input(place_of(source_, *value) + ": has " + as_text(quantity.value.size()) +
                       " numbers; ask the laboratory to correct the DCC");
    MDOF_CHECK(read_uncertainty(form, quantity));
    for (double& x : quantity.value) x *= quantity.unit.factor;
    return std::optional(std::move(quantity));
  }

  const std::string& source_;
};

}  // namespace

std::string place_of(const std::string& source, const XmlElement& element) {
  return source + ":" + std::to_string(element.line) + ": " + element.name;
}

std::vector<std::string> read_ref_types(const XmlElement& element) {
  return words(std::string(element.attribute("refType")));
}

std::string name_of(const XmlElement& element) {
  const XmlElement* content = element.at("dcc:name/dcc:content");
  if (!content) return "";
  std::string text;
  for (const std::string& word : words(content->text)) text += (text.empty() ? "" : " ") + word;
  return text;
}

Result<std::optional<DccQuantity>> read_quantity(const XmlElement& element,
                                                 const std::string& source) {
  MDOF_TRY(auto quantity, QuantityReader(source).read(element));
  if (!quantity) return quantity;
  quantity->name = name_of(element);
  quantity->ref_types = read_ref_types(element);
  return quantity;
}

}  // namespace mdof
